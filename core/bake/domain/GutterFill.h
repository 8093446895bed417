// Filling the texels between UV charts, so that bilinear lookup and mip maps see no seam.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace patina {

// `values`: side × side texels of fallback.size() floats each; `known`: 1 where a texel is real.
// The four nearest rings take the mean of their known neighbours (textures repeat: neighbours wrap
// around); what is further away is filled from coarser and coarser averages (push-pull, Gortler et
// al. 1996). Known values stay. Without any known texel all become `fallback`.
void fillGutters(std::span<float> values, std::vector<std::uint8_t> known, int side,
                 std::span<const float> fallback);

} // namespace patina
