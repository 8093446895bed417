// A wall of pictures on paper: title, captions of columns and rows, the cells.
#pragma once

#include "core/cells/Wall.h"
#include "core/sheet/SheetCanvas.h"

#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <vector>

namespace patina::sheet {

struct WallSheetText {
    std::string title;
    std::string subtitle; // what all cells have in common
};

// A line of text on a sheet.
struct SheetText {
    int x = 0, baseline = 0, size = 0; // pixels
    glm::vec3 color{1.0f};             // display values
    std::string text;
};

// Where everything lies, in pixels; text grows with the cells.
class WallSheet {
  public:
    // `text`: nothing: no captions. Errors: Usage when it would have more than kMostSheetSide
    // pixels a side, InputMissing without a font.
    static Result<WallSheet> create(const Wall& wall, int cellWidth, int cellHeight,
                                    const std::optional<WallSheetText>& text);

    [[nodiscard]] glm::ivec2 size() const { return m_size; }
    [[nodiscard]] glm::ivec2 cellSize() const { return m_cell; }
    [[nodiscard]] glm::ivec2 place(const WallCell& cell) const; // its top left pixel

    // Title and captions; none without text.
    [[nodiscard]] std::vector<SheetText> texts(const Wall& wall) const;
    // The sheet with them, before there are pictures.
    [[nodiscard]] Image draw(const Wall& wall) const;
    // In place of a picture: that there is none, and why.
    void drawProblem(Image& sheet, const WallCell& cell, const std::string& reason) const;

  private:
    using Lines = std::vector<std::string>;
    WallSheet() = default;
    void layOut(const Wall& wall, const WallSheetText& text);
    [[nodiscard]] int scaled(float pixels) const; // of cells of 320 × 240

    std::optional<TextRaster> m_text;
    float m_scale = 1.0f;
    glm::ivec2 m_cell{0}, m_first{0}, m_size{0}; // of a cell; top left of the first; of the sheet
    int m_gap = 0, m_captionBelow = 0;           // between cells; below each cell of a grid
    std::size_t m_captionLines = 1;              // of the longest caption of a column
    Lines m_title, m_subtitle;
    std::vector<Lines> m_columns, m_rows; // captions; of a grid those of the cells
    glm::ivec2 m_headings{0};             // baselines of the axes' titles and of the first captions
};

} // namespace patina::sheet
