#include "render/scene/LightMapTexture.h"

#include "core/bake/lightmap/LightMap.h"
#include "core/base/Check.h"

#include <algorithm>

namespace patina::render {

gl::Texture makeLightMap(gl::Context& context, const TexelBake& texels) {
    CHECK_EQ(texels.stride, kLightMapStride);
    constexpr float kBrightest = 65504.0f; // of half floats
    const auto count =
        static_cast<std::size_t>(texels.side) * static_cast<std::size_t>(texels.side);
    std::vector<float> slices(count * 4 * kLightMapSlices);
    for (std::size_t slice = 0; slice < kLightMapSlices; ++slice)
        for (std::size_t t = 0; t < count; ++t)
            for (std::size_t c = 0; c < 4; ++c)
                slices[4 * (slice * count + t) + c] = std::clamp(
                    texels.values[t * kLightMapStride + 4 * slice + c], -kBrightest, kBrightest);
    gl::Texture texture(context, "light map",
                        {.kind = gl::TextureKind::Volume,
                         .format = gl::PixelFormat::Rgba16f,
                         .width = texels.side,
                         .height = texels.side,
                         .depth = kLightMapSlices});
    texture.upload(0, 4, gl::SampleType::F32, slices.data());
    texture.setSampling(gl::Filter::Linear, gl::Wrap::Repeat);
    return texture;
}

} // namespace patina::render
