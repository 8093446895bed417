// A light map on the GPU (core/bake/lightmap/LightMap.h).
#pragma once

#include "core/bake/domain/BakeArtifact.h"
#include "render/gl/Texture.h"

namespace patina::render {

// A slice of half floats for each vector that the surface shader reads; what is beyond their range
// becomes the largest.
[[nodiscard]] gl::Texture makeLightMap(gl::Context& context, const TexelBake& texels);

} // namespace patina::render
