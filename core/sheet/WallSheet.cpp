#include "core/sheet/WallSheet.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace patina::sheet {
namespace {

// Of cells of 320 × 240: pixels.
constexpr float kTitle = 24.0f, kSubtitle = 13.0f, kAxis = 13.0f, kCellCaption = 16.0f;
constexpr float kSheetMargin = 24.0f, kCellGap = 8.0f, kBareGap = 4.0f;
constexpr float kCellLine = 1.3f;                       // of a text's size
constexpr float kRowHeadMin = 60.0f, kRowHead = 150.0f; // width of the captions of rows
constexpr std::size_t kColumnLines = 2, kRowLines = 4, kTitleLines = 2, kProblemLines = 6;

} // namespace

int WallSheet::scaled(float pixels) const {
    return static_cast<int>(std::lround(pixels * m_scale));
}

Result<WallSheet> WallSheet::create(const Wall& wall, int cellWidth, int cellHeight,
                                    const std::optional<WallSheetText>& text) {
    WallSheet sheet;
    sheet.m_cell = {cellWidth, cellHeight};
    // Below this no text is readable, however small the cells are.
    constexpr float kSmallest = 0.8f;
    sheet.m_scale = std::max(kSmallest, std::min(static_cast<float>(cellWidth) / 320.0f,
                                                 static_cast<float>(cellHeight) / 240.0f));
    if (text) {
        Result<TextRaster> raster = TextRaster::create();
        if (!raster)
            return raster.error();
        sheet.m_text = std::move(*raster);
        sheet.m_gap = sheet.scaled(kCellGap);
        sheet.layOut(wall, *text);
    } else {
        sheet.m_gap = sheet.scaled(kBareGap);
        const auto width = static_cast<int>(wall.width), height = static_cast<int>(wall.height);
        sheet.m_size = {width * (cellWidth + sheet.m_gap) - sheet.m_gap,
                        height * (cellHeight + sheet.m_gap) - sheet.m_gap};
    }
    if (std::max(sheet.m_size.x, sheet.m_size.y) > kMostSheetSide)
        return Error{ErrorKind::Usage,
                     fmt::format("the sheet would have {} × {} pixels, and at most {} a side are "
                                 "possible; choose a smaller --size for its cells",
                                 sheet.m_size.x, sheet.m_size.y, kMostSheetSide),
                     {},
                     {}};
    return sheet;
}

void WallSheet::layOut(const Wall& wall, const WallSheetText& words) {
    const auto columns = static_cast<int>(wall.width), rows = static_cast<int>(wall.height);
    const int margin = scaled(kSheetMargin), caption = scaled(kCellCaption);
    const auto line = [&](float size) { return scaled(size * kCellLine); };
    const auto wrap = [&](const std::string& text, int width, std::size_t most) {
        return wrapped(*m_text, text, caption, width, most);
    };

    // Captions first: they decide what stands where.
    for (const WallEntry& entry : wall.columns.entries)
        m_columns.push_back(wrap(entry.caption, m_cell.x, kColumnLines));
    int rowHead = 0;
    if (wall.isTable()) {
        for (const WallEntry& entry : wall.rows.entries) {
            m_rows.push_back(wrap(entry.caption, scaled(kRowHead), kRowLines));
            for (const std::string& part : m_rows.back())
                rowHead = std::max(rowHead, m_text->width(part, caption));
        }
        rowHead = std::max({rowHead, scaled(kRowHeadMin),
                            m_text->width(wall.rows.title, scaled(kAxis))}) +
                  2 * m_gap;
    }
    for (const Lines& lines : m_columns)
        m_captionLines = std::max(m_captionLines, lines.size());
    const int captions = static_cast<int>(m_captionLines) * line(kCellCaption);

    const int cellsWidth = columns * (m_cell.x + m_gap) - m_gap;
    m_size.x = 2 * margin + rowHead + cellsWidth;
    const int textWidth = m_size.x - 2 * margin;
    m_title = wrapped(*m_text, words.title, scaled(kTitle), textWidth, kTitleLines);
    m_subtitle = wrapped(*m_text, words.subtitle, scaled(kSubtitle), textWidth, kTitleLines);

    int y = margin + static_cast<int>(m_title.size()) * line(kTitle) +
            static_cast<int>(m_subtitle.size()) * line(kSubtitle) + 2 * m_gap;
    if (wall.isTable()) {
        m_headings.x = y + scaled(kAxis);
        y += line(kAxis);
        m_headings.y = y + caption;
        y += captions + m_gap;
    } else {
        m_captionBelow = captions + 2 * m_gap;
    }
    m_first = {margin + rowHead, y};
    m_size.y = y + rows * (m_cell.y + m_gap + m_captionBelow) - m_gap + margin -
               (wall.isTable() ? 0 : 2 * m_gap);
}

glm::ivec2 WallSheet::place(const WallCell& cell) const {
    return m_first + glm::ivec2(static_cast<int>(cell.column) * (m_cell.x + m_gap),
                                static_cast<int>(cell.row) * (m_cell.y + m_gap + m_captionBelow));
}

Image WallSheet::draw(const Wall& wall) const {
    Image sheet = makePaper(m_size.x, m_size.y);
    for (const SheetText& line : texts(wall))
        m_text->draw(sheet, line.x, line.baseline, line.size, line.color, line.text);
    return sheet;
}

std::vector<SheetText> WallSheet::texts(const Wall& wall) const {
    std::vector<SheetText> result;
    if (!m_text)
        return result;
    const int margin = scaled(kSheetMargin), caption = scaled(kCellCaption);
    const auto write = [&](int x, int baseline, float size, const glm::vec3& color,
                           const Lines& lines) {
        for (const std::string& text : lines) {
            result.push_back({x, baseline, scaled(size), color, text});
            baseline += scaled(size * kCellLine);
        }
        return baseline;
    };
    const int below = write(margin, margin + scaled(kTitle), kTitle, kWhite, m_title);
    write(margin, below - scaled(kTitle * kCellLine) + scaled(kSubtitle * kCellLine) + m_gap,
          kSubtitle, kGrey, m_subtitle);
    const std::vector<WallCell> cells = cellsOf(wall);
    if (!wall.isTable()) {
        for (std::size_t i = 0; i < cells.size(); ++i) {
            const glm::ivec2 corner = place(cells[i]);
            write(corner.x, corner.y + m_cell.y + caption + m_gap / 2, kCellCaption, kWhite,
                  m_columns[i]);
        }
        return result;
    }
    write(m_first.x, m_headings.x, kAxis, kGrey, {wall.columns.title});
    write(margin, m_headings.y, kAxis, kGrey, {wall.rows.title});
    for (const WallCell& cell : cells) {
        const glm::ivec2 corner = place(cell);
        if (cell.row == 0) { // the last line stands on the picture
            const Lines& lines = m_columns[cell.column];
            const auto above = static_cast<int>(m_captionLines - lines.size());
            write(corner.x, m_headings.y + above * scaled(kCellCaption * kCellLine), kCellCaption,
                  kWhite, lines);
        }
        if (cell.column == 0) {
            const Lines& lines = m_rows[cell.row];
            const int height =
                static_cast<int>(lines.size() - 1) * scaled(kCellCaption * kCellLine);
            // A small letter's middle lies a third of the size above the baseline.
            write(margin, corner.y + (m_cell.y - height) / 2 + caption / 3, kCellCaption, kWhite,
                  lines);
        }
    }
    return result;
}

void WallSheet::drawProblem(Image& sheet, const WallCell& cell, const std::string& reason) const {
    constexpr glm::vec3 kEmpty{0.13f};
    const glm::ivec2 corner = place(cell);
    fillRectangle(sheet, corner.x, corner.y, m_cell.x, m_cell.y, kEmpty);
    if (!m_text)
        return;
    const int inset = 2 * m_gap, size = scaled(kSubtitle), line = scaled(kSubtitle * kCellLine);
    const auto fits = static_cast<std::size_t>(std::max((m_cell.y - 2 * inset) / line, 1));
    const Lines lines =
        wrapped(*m_text, reason, size, m_cell.x - 2 * inset, std::min(kProblemLines, fits));
    int baseline = corner.y + inset + size;
    for (const std::string& text : lines) {
        m_text->draw(sheet, corner.x + inset, baseline, size, kAmber, text);
        baseline += line;
    }
}

} // namespace patina::sheet
