// The cells of a wall as one picture on paper, or as parts of one file; what all of them have in
// common, in words.
#pragma once

#include "core/document/Document.h"
#include "core/io/ImageIO.h"
#include "core/sheet/WallSheet.h"

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace patina::sheet {

// A cell's picture, or why there is none.
struct DrawnCell {
    Image picture; // 8-bit sRGB of 3 or 4 channels for pictureOf(), linear floats for partsOf()
    std::string problem;
    std::string part; // set by partsOf()
    double seconds = 0.0;
    std::uint32_t samples = 0;                          // of a traced one, that each pixel has
    std::optional<double> noise;                        // of it, as Film::noise()
    std::map<std::string, std::string> attributes = {}; // of its part
};

// The sheet with its pictures, which are taken from `drawn`: large sheets have no room for the same
// pixels twice. `cells` and `drawn` are in the same order.
[[nodiscard]] Image pictureOf(const WallSheet& sheet, const Wall& wall,
                              const std::vector<WallCell>& cells, std::vector<DrawnCell>& drawn);
// Each cell as a part of its own, named by its captions ("Studio, Gold"); pictures are taken.
[[nodiscard]] std::vector<ImagePart> partsOf(const std::vector<WallCell>& cells,
                                             std::vector<DrawnCell>& drawn);
// Usage error where the parts would be more than one file may hold.
[[nodiscard]] Result<void> checkPartsFit(std::size_t cells, int width, int height);

// Below the title: what is compared ("Environment × Material"), and what all cells have in common:
// environment, lighting mode, tone curve, exposure.
[[nodiscard]] std::string commonText(const Wall& wall, const Document& document);

} // namespace patina::sheet
