// An environment as the viewport's textures hold it. Half floats take a driver milliseconds to copy
// where floats take it hundreds to convert, so they are made here: on any thread but the one that
// draws.
#pragma once

#include "core/light/Ibl.h"

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace patina {

// RGBA, alpha 1, rows from the top; beyond 65504 is 65504.
struct HalfPicture {
    int width = 0, height = 0;
    std::vector<std::uint16_t> texels; // 4 · width · height
};

// The picture itself, then its mipmaps down to 1 × 1: each side half of the one before, rounded
// down, each texel the mean of what it covers.
using HalfMipmaps = std::vector<HalfPicture>;
using HalfMipmapsPtr = std::shared_ptr<const HalfMipmaps>;

struct EnvironmentTexels {
    ImagePtr image;            // the environment it was made of
    HalfMipmapsPtr background; // of `image`, lat-long
    HalfPicture prefiltered;   // a CubeAtlas of this side and levels
    int side = 0, levels = 0;
    int irradianceSide = 0, irradianceTop = 0; // of the CubeAtlas
    std::size_t clamped = 0;                   // prefiltered texels that exceeded 65504
    std::array<glm::vec3, 9> irradianceSh{};   // as in IblMaps
    std::array<glm::vec3, 64> radianceSh{};
};
using EnvironmentTexelsPtr = std::shared_ptr<const EnvironmentTexels>;

// `image`: as computeIbl() takes it. Cancelled when the job is.
Result<HalfMipmapsPtr> makeBackground(const Image& image, const JobContext& job);

// `maps` are of `image`, and so is `background`: several versions of the light share it.
[[nodiscard]] EnvironmentTexels makeEnvironmentTexels(ImagePtr image, const IblMaps& maps,
                                                      HalfMipmapsPtr background);

} // namespace patina
