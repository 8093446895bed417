// What a bake holds for each vertex or texel, as the channels of an image and back.
#pragma once

#include "core/bake/domain/BakeArtifact.h"
#include "core/bake/domain/BakeStorage.h"
#include "core/image/Image.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace patina {

// The numbers of VertexBake and TexelBake, which mean the same in both.
struct BakeElements {
    int stride = 1;
    std::vector<float> values, bounced, sky, error;
};
struct BakeElementsView {
    int stride = 1;
    std::span<const float> values, bounced, sky, error;
};

// Whole multiples of these are stored; empty unless the storage is Quantised.
struct BakeSteps {
    std::vector<float> values, bounced; // one for each band
};

struct BakeImage {
    Image image;
    BakeSteps steps;
};

// Ambient occlusion: one channel "ao". Transfer of `order` bands: "sh.l0m0" …, and for what the
// elements hold "bounced.l0m0.R" … (without the colour when all three are equal everywhere), "sky",
// "error". Light maps: "irradiance.R" …, "visibility", "radiance.l0m0.R" …, "hidden.l0m0" …,
// "open.X" …. Elements fill rows of `width` from the top left; what is left over of the last row is
// 0. `order`: 0 but for transfer.
[[nodiscard]] BakeImage imageFromElements(const BakeElementsView& elements, BakeKind kind,
                                          int order, std::size_t width,
                                          const BakeFileOptions& options);

// Nothing when channels are missing, or unknown ones are there, or the image is too small for
// `count` elements. The channels may stand in any order.
[[nodiscard]] std::optional<BakeElements> elementsFromImage(const Image& image, BakeKind kind,
                                                            int order, std::size_t count,
                                                            const BakeSteps& steps);
[[nodiscard]] bool hasBounced(const Image& image);

// Whether all numbers are what a bake can be: finite, shares within 0…1, coefficients of a size
// that light can have.
[[nodiscard]] bool plausible(const BakeElements& elements, BakeKind kind);

} // namespace patina
