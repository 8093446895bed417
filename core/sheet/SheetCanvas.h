// What sheets of pictures are drawn with: paper, pictures on it, lines of text that fit.
#pragma once

#include "core/image/TextRaster.h"

#include <glm/vec3.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace patina::sheet {

// Display values.
inline constexpr glm::vec3 kPaper{0.085f}, kWhite{0.94f}, kGrey{0.62f}, kAmber{0.95f, 0.70f, 0.30f};
inline constexpr int kMostSheetSide = 16384; // pixels

[[nodiscard]] Image makePaper(int width, int height); // 8-bit sRGB

// What lies outside the image is left out.
void fillRectangle(Image& image, int x, int y, int width, int height, const glm::vec3& color);
// An 8-bit picture of 3 channels as it is, one of 4 (straight alpha) over the paper. It must lie
// inside.
void paste(Image& sheet, int x, int y, const Image& picture);

// The longest beginning that fits, with an ellipsis when it is not all.
[[nodiscard]] std::string fitting(const TextRaster& text, std::string_view line, int size,
                                  int width);
// The same on several lines, which break after spaces and the signs that names of files have
// instead; numbers stay whole.
[[nodiscard]] std::vector<std::string> wrapped(const TextRaster& text, std::string_view line,
                                               int size, int width, std::size_t mostLines);

} // namespace patina::sheet
