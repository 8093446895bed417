#include "core/export/LightMapExport.h"

#include "core/bake/lightmap/LightMap.h"
#include "core/base/Check.h"

#include <cstddef>
#include <fmt/format.h>
#include <memory>
#include <utility>

namespace patina {
namespace {

constexpr int kTiles = 3; // a row
static_assert(kTiles * kTiles == static_cast<int>(kLightMapTerms));

// `channels` numbers of each texel from its `first` on.
Image numbersOf(const TexelBake& texels, std::size_t first, int channels) {
    CHECK_EQ(texels.stride, kLightMapStride);
    Image image(texels.side, texels.side, channels, PixelType::F32, ColorEncoding::Data);
    const auto count = static_cast<std::size_t>(channels);
    for (std::size_t i = 0; i < image.f32().size(); ++i)
        image.f32()[i] = texels.values[i / count * kLightMapStride + first + i % count];
    return image;
}

Image shrunk(const TexelBake& texels, std::size_t first, int channels, int maxSide) {
    Image image = numbersOf(texels, first, channels);
    return maxSide > 0 && maxSide < texels.side ? shrinkImage(image, maxSide) : image;
}

} // namespace

int lightMapPartSide(LightMapPart part, int side) {
    return part == LightMapPart::Reflections ? kTiles * side : side;
}

Image lightMapPartImage(const TexelBake& texels, LightMapPart part, int maxSide) {
    Image result;
    if (part == LightMapPart::Reflections) {
        for (int term = 0; term < kTiles * kTiles; ++term) {
            const auto first = static_cast<std::size_t>(4 * (1 + term));
            // Apart: what averages colours would weight them by the last channel, an alpha.
            const Image radiance = shrunk(texels, first, 3, maxSide);
            const Image hidden = shrunk(texels, first + 3, 1, maxSide);
            const int side = radiance.width();
            if (result.empty())
                result =
                    Image(kTiles * side, kTiles * side, 4, PixelType::F32, ColorEncoding::Linear);
            for (int y = 0; y < side; ++y)
                for (int x = 0; x < side; ++x) {
                    const int column = term % kTiles * side + x, row = term / kTiles * side + y;
                    const auto pixel = static_cast<std::size_t>(row * kTiles * side + column);
                    for (int c = 0; c < 3; ++c)
                        result.f32()[4 * pixel + static_cast<std::size_t>(c)] =
                            radiance.sample(x, y, c);
                    result.f32()[4 * pixel + 3] = hidden.sample(x, y, 0);
                }
        }
        return result;
    }
    result = shrunk(texels, part == LightMapPart::Irradiance ? 0 : kLightMapStride - 3, 3, maxSide);
    result.setEncoding(ColorEncoding::Linear);
    return result;
}

ImagePtr ambientVisibilityOf(const TexelBake& texels) {
    return std::make_shared<const Image>(numbersOf(texels, 3, 1));
}

std::string lightMapShader(const std::string& scene) {
    return fmt::format(R"(// The light map of {0}: what image-based light lacks there.
//
// lightMapIrradiance and lightMapReflections are the files of a surface's material, which the scene
// names; linear, without mipmaps, row 0 at v = 0 as in glTF. They belong to the environment, the
// lights and the materials that they were baked with; straight light of lights is not in them.
// Where they are used an occlusion texture must not be: they know what is hidden.
uniform sampler2D lightMapIrradiance;
uniform sampler2D lightMapReflections;

// To be shown of diffuse light: base colour / pi * this.
// `irradiance`: of the environment at the shading normal, integral of L max(0, n.d).
vec3 lightMapDiffuse(vec2 uv, vec3 irradiance) {{
    return max(irradiance + texture(lightMapIrradiance, uv).rgb, vec3(0.0));
}}

// To be shown of reflections: specular albedo (F0 * scale + bias) * this.
// `mirrored`: unit, world, +Y up: the view direction reflected at the shading normal;
// `prefiltered`: the environment's radiance there, prefiltered for the surface's roughness.
vec3 lightMapReflected(vec2 uv, vec3 mirrored, vec3 prefiltered) {{
    vec3 d = mirrored;
    // Real spherical harmonics with Condon-Shortley phase, index l(l+1)+m.
    float y[9] = float[9](0.282094791773878, -0.488602511902920 * d.y, 0.488602511902920 * d.z,
                          -0.488602511902920 * d.x, 1.09254843059208 * d.x * d.y,
                          -1.09254843059208 * d.y * d.z,
                          0.315391565252520 * (3.0 * d.z * d.z - 1.0),
                          -1.09254843059208 * d.x * d.z,
                          0.546274215296040 * (d.x * d.x - d.y * d.y));
    vec2 edge = vec2(1.5) / vec2(textureSize(lightMapReflections, 0)); // half a texel of a tile
    vec2 inside = clamp(fract(uv), edge, 1.0 - edge);
    vec4 sum = vec4(0.0);
    for (int i = 0; i < 9; ++i)
        sum += y[i] * textureLod(lightMapReflections, (vec2(i % 3, i / 3) + inside) / 3.0, 0.0);
    float left = 1.0 - clamp(sum.a, -1.0, 1.0);
    return max(left * prefiltered + sum.rgb, vec3(0.0));
}}
)",
                       scene);
}

} // namespace patina
