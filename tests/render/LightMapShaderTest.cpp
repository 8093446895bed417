// The GLSL that goes along with an exported light map does what the map's definition says.
#include "core/bake/lightmap/LightMap.h"
#include "core/export/LightMapExport.h"
#include "core/math/SphericalHarmonics.h"
#include "render/gl/Buffer.h"
#include "render/gl/Program.h"
#include "render/gl/Texture.h"
#include "tests/render/GlTest.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <epoxy/gl.h>
#include <glm/geometric.hpp>
#include <random>

namespace patina::render {
namespace {

constexpr int kSide = 8;
constexpr std::size_t kPlaces = 1024;

struct Place {
    glm::vec4 uv;       // two of them
    glm::vec4 mirrored; // unit
};

class LightMapShader : public gl::GlTest {};

// Number `index` at `uv`, bilinear between texel centres. Near the border the neighbours differ
// (tiles end there, a map repeats), so that places keep off it.
float looked(const TexelBake& texels, const glm::vec4& uv, int index) {
    const float x = uv.x * kSide - 0.5f, y = uv.y * kSide - 0.5f;
    const int left = static_cast<int>(std::floor(x)), top = static_cast<int>(std::floor(y));
    const auto at = [&](int column, int row) {
        return texels
            .values[static_cast<std::size_t>((row * kSide + column) * kLightMapStride + index)];
    };
    const float s = x - static_cast<float>(left), t = y - static_cast<float>(top);
    return (1 - t) * ((1 - s) * at(left, top) + s * at(left + 1, top)) +
           t * ((1 - s) * at(left, top + 1) + s * at(left + 1, top + 1));
}

gl::Texture textureOf(gl::Context& context, const Image& image) {
    gl::Texture texture(context, "exported",
                        {.kind = gl::TextureKind::Flat,
                         .format = gl::PixelFormat::Rgba32f,
                         .width = image.width(),
                         .height = image.height()});
    texture.upload(0, image.channels(), gl::SampleType::F32, image.f32().data());
    texture.setSampling(gl::Filter::Linear, gl::Wrap::Repeat);
    return texture;
}

TEST_F(LightMapShader, AddsWhatTheMapSays) {
    std::mt19937 random(11);
    const auto number = [&] { return static_cast<float>(random()) / 4294967296.0f; };
    TexelBake texels;
    texels.side = kSide;
    texels.stride = kLightMapStride;
    texels.values.resize(static_cast<std::size_t>(kSide * kSide * kLightMapStride));
    for (float& value : texels.values)
        value = 0.5f * number() - 0.2f;
    std::vector<Place> places(kPlaces);
    for (Place& place : places) {
        const auto inside = [&] { return (0.5f + number() * (kSide - 1)) / kSide; };
        place.uv = {inside(), inside(), 0, 0};
        const glm::vec3 d = glm::normalize(glm::vec3(number(), number(), number()) - 0.5f);
        place.mirrored = {d, 0};
    }

    const gl::StageSource stage{
        gl::Stage::Compute,
        "#version 450 core\nlayout(local_size_x = 64) in;\n"
        "layout(std430, binding = 0) readonly buffer In { vec4 b_in[]; };\n"
        "layout(std430, binding = 1) writeonly buffer Out { vec4 b_out[]; };\n" +
            lightMapShader("test.glb") +
            "void main() {\nuint i = 2 * gl_GlobalInvocationID.x;\n"
            "b_out[i] = vec4(lightMapDiffuse(b_in[i].xy, vec3(0.1, 0.2, 0.3)), 1.0);\n"
            "b_out[i + 1] = vec4(lightMapReflected(b_in[i].xy, b_in[i + 1].xyz, "
            "vec3(0.3, 0.2, 0.1)), 1.0);\n}\n"};
    const auto program = gl::Program::create(context(), "light map", std::span(&stage, 1));
    ASSERT_TRUE(program.ok()) << program.error().text() << program.error().detail;
    const gl::Texture irradiance =
        textureOf(context(), lightMapPartImage(texels, LightMapPart::Irradiance, 0));
    const gl::Texture reflections =
        textureOf(context(), lightMapPartImage(texels, LightMapPart::Reflections, 0));
    const gl::Buffer in = gl::Buffer::of<Place>(context(), "in", places);
    const gl::Buffer out(context(), "out", kPlaces * 2 * sizeof(glm::vec4));
    in.bindStorage(0);
    out.bindStorage(1);
    irradiance.bind(0);
    reflections.bind(1);
    program->use();
    program->set("lightMapIrradiance", 0);
    program->set("lightMapReflections", 1);
    glDispatchCompute(kPlaces / 64, 1, 1);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    const auto bytes = out.read();
    std::vector<glm::vec4> found(2 * kPlaces);
    std::memcpy(found.data(), bytes.data(), bytes.size());

    const glm::vec3 given(0.1f, 0.2f, 0.3f), prefiltered(0.3f, 0.2f, 0.1f);
    for (std::size_t i = 0; i < kPlaces; ++i) {
        float y[9];
        evaluateSh(3, glm::vec3(places[i].mirrored), y);
        float hidden = 0.0f;
        for (int term = 0; term < 9; ++term)
            hidden += y[term] * looked(texels, places[i].uv, 4 + 4 * term + 3);
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(found[2 * i][c], std::max(given[c] + looked(texels, places[i].uv, c), 0.0f),
                        2e-3f);
            float radiance = 0.0f;
            for (int term = 0; term < 9; ++term)
                radiance += y[term] * looked(texels, places[i].uv, 4 + 4 * term + c);
            EXPECT_NEAR(
                found[2 * i + 1][c],
                std::max((1 - std::clamp(hidden, -1.0f, 1.0f)) * prefiltered[c] + radiance, 0.0f),
                5e-3f);
        }
    }
}

} // namespace
} // namespace patina::render
