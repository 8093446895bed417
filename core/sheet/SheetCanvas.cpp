#include "core/sheet/SheetCanvas.h"

#include "core/base/Check.h"

#include <algorithm>
#include <cstddef>

namespace patina::sheet {

Image makePaper(int width, int height) {
    Image paper(width, height, 3, PixelType::U8, ColorEncoding::Srgb);
    fillRectangle(paper, 0, 0, width, height, kPaper);
    return paper;
}

void fillRectangle(Image& image, int x, int y, int width, int height, const glm::vec3& color) {
    const auto pixels = image.u8();
    for (int row = std::max(y, 0); row < std::min(y + height, image.height()); ++row)
        for (int column = std::max(x, 0); column < std::min(x + width, image.width()); ++column)
            for (int c = 0; c < 3; ++c)
                pixels[(static_cast<std::size_t>(row) * static_cast<std::size_t>(image.width()) +
                        static_cast<std::size_t>(column)) *
                           3 +
                       static_cast<std::size_t>(c)] =
                    static_cast<std::uint8_t>(color[c] * 255.0f + 0.5f);
}

void paste(Image& sheet, int x, int y, const Image& picture) {
    const int channels = picture.channels();
    CHECK(channels == 3 || channels == 4);
    CHECK(x >= 0 && y >= 0 && x + picture.width() <= sheet.width() &&
          y + picture.height() <= sheet.height());
    const auto offset = [](const Image& image, int column, int row) {
        return (static_cast<std::ptrdiff_t>(row) * image.width() + column) * image.channels();
    };
    for (int row = 0; row < picture.height(); ++row) {
        const auto from = picture.u8().begin() + offset(picture, 0, row);
        const auto to = sheet.u8().begin() + offset(sheet, x, y + row);
        if (channels == 3) {
            std::copy_n(from, std::ptrdiff_t{3} * picture.width(), to);
            continue;
        }
        for (int column = 0; column < picture.width(); ++column) {
            const float alpha = picture.sample(column, row, 3);
            for (int c = 0; c < 3; ++c) {
                const float color =
                    alpha * picture.sample(column, row, c) + (1.0f - alpha) * kPaper[c];
                to[std::ptrdiff_t{3} * column + c] =
                    static_cast<std::uint8_t>(color * 255.0f + 0.5f);
            }
        }
    }
}

std::string fitting(const TextRaster& text, std::string_view line, int size, int width) {
    if (text.width(line, size) <= width)
        return std::string(line);
    std::string shorter(line);
    while (!shorter.empty() && text.width(shorter + "…", size) > width) {
        while (!shorter.empty() && (static_cast<unsigned char>(shorter.back()) & 0xc0u) == 0x80u)
            shorter.pop_back();
        if (!shorter.empty())
            shorter.pop_back();
    }
    return shorter + "…";
}

namespace {

// Where the line may break after `from`; numbers stay whole.
std::size_t nextBreak(std::string_view line, std::size_t from) {
    for (;; ++from) {
        from = line.find_first_of(" _-/.", from);
        if (from >= line.size() - 1)
            return line.size();
        const bool digit = line[from + 1] >= '0' && line[from + 1] <= '9';
        if (!digit || (line[from] != '.' && line[from] != '-'))
            return from + 1;
    }
}

} // namespace

std::vector<std::string> wrapped(const TextRaster& text, std::string_view line, int size, int width,
                                 std::size_t mostLines) {
    const auto trimmed = [](std::string_view part) {
        while (part.ends_with(' '))
            part.remove_suffix(1);
        return part;
    };
    std::vector<std::string> lines;
    while (!line.empty() && lines.size() + 1 < mostLines &&
           text.width(trimmed(line), size) > width) {
        std::size_t end = 0; // of the last piece that fits
        for (std::size_t next = 0; next < line.size();) {
            next = nextBreak(line, next);
            if (text.width(trimmed(line.substr(0, next)), size) > width)
                break;
            end = next;
        }
        if (end == 0)
            break; // no piece is so short
        lines.emplace_back(trimmed(line.substr(0, end)));
        line.remove_prefix(end);
    }
    if (!line.empty())
        lines.push_back(fitting(text, trimmed(line), size, width));
    return lines;
}

} // namespace patina::sheet
