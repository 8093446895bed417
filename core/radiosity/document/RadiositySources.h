// Where the light of a radiosity comes from, source by source, and what makes two sources the same.
#pragma once

#include "core/radiosity/document/LiveRadiosity.h"

#include <cstddef>
#include <vector>

namespace patina {

// Sources that are solved alone; of more lights the last ones are solved together.
inline constexpr std::size_t kMaxAloneSources = 16;

// The lights of the inputs as sources, and the sky; what they scale by is not in them any more.
struct LightSources {
    TraceInputs inputs; // at a power of 1
    std::vector<RadiositySource> sources;
};

[[nodiscard]] LightSources lightSourcesOf(const TraceInputs& inputs);

[[nodiscard]] bool sameSource(const RadiositySource& a, const RadiositySource& b);
// Whether the sides that reflect are the same, given the same meshes.
[[nodiscard]] bool sameSides(const TraceInputs& a, const TraceInputs& b);
// What glows, and how: of each mesh.
[[nodiscard]] bool sameGlow(const TraceInputs& a, const TraceInputs& b);

} // namespace patina
