// What views show, read back from the GPU at random pixels and held against the shared functions
// and tables evaluated on the CPU.
#include "core/job/JobContext.h"
#include "core/light/CubeAtlas.h"
#include "core/light/CubeSampling.h"
#include "core/light/DfgTable.h"
#include "core/light/Light.h"
#include "core/material/Material.h"
#include "core/math/Shading.h"
#include "tests/render/RenderTest.h"

#include <cmath>
#include <random>

using namespace patina;
using namespace patina::render;

namespace {

using namespace patina::shading;

constexpr int kSize = 128;
constexpr int kPixels = 1000;
constexpr float kTolerance = 1e-3f;

// Bilinear lookup at texel coordinates, centres at halves.
glm::vec3 lookUp(const CubeAtlas& atlas, const glm::vec2& texel) {
    const glm::vec2 at = texel - 0.5f;
    const glm::ivec2 first(glm::floor(at));
    const glm::vec2 share = at - glm::vec2(first);
    const auto read = [&](int x, int y) {
        x = std::clamp(x, 0, atlas.width - 1);
        y = std::clamp(y, 0, atlas.height - 1);
        return atlas.texels[static_cast<std::size_t>(y) * static_cast<std::size_t>(atlas.width) +
                            static_cast<std::size_t>(x)];
    };
    return glm::mix(glm::mix(read(first.x, first.y), read(first.x + 1, first.y), share.x),
                    glm::mix(read(first.x, first.y + 1), read(first.x + 1, first.y + 1), share.x),
                    share.y);
}

glm::vec3 prefilteredOnCpu(const CubeAtlas& atlas, const glm::vec3& d, float roughness) {
    const float side = static_cast<float>(atlas.side);
    const glm::vec3 at = cubeFacePosition(d);
    const float level = prefilteredLevel(roughness, atlas.levels, side);
    const int fine = static_cast<int>(level);
    const glm::vec3 near = lookUp(atlas, cubeAtlasTexel(at, fine, side));
    if (fine + 1 == atlas.levels)
        return near;
    return glm::mix(near, lookUp(atlas, cubeAtlasTexel(at, fine + 1, side)),
                    level - static_cast<float>(fine));
}

void expectNear(const glm::vec3& told, const glm::vec3& expected, const char* what) {
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(told[c], expected[c], kTolerance * std::max(std::abs(expected[c]), 0.01f))
            << what << ' ' << c;
}

class ViewsReadBack : public RenderTest {};

TEST_F(ViewsReadBack, EqualsTheSharedFunctionsAtRandomPixels) {
    Document document = makeScene(makeSphere());
    Material& material = document.materials[0];
    const auto waves = [](int x, int y, int c) {
        return 0.5f + 0.45f * std::sin(0.13f * static_cast<float>(x * (c + 1)) +
                                       0.09f * static_cast<float>(y * (3 - c)));
    };
    material.baseColor = glm::vec3(1.0f);
    material.baseColorMap.image = makeImage(128, 128, 3, PixelType::U8, ColorEncoding::Srgb, waves);
    material.metallic = material.perceptualRoughness = 1.0f;
    material.metallicMap.image = makeImage(64, 64, 1, PixelType::U8, ColorEncoding::Data, waves);
    material.perceptualRoughnessMap.image =
        makeImage(96, 96, 1, PixelType::U8, ColorEncoding::Data,
                  [&](int x, int y, int) { return waves(y, x, 1); });
    document.environment().image = makeEnvironment(64, [](const glm::vec3& d) {
        return glm::vec3(0.6f + 0.5f * d.x, 0.7f + 0.6f * d.y * d.y, 0.8f + 0.7f * d.z) +
               (d.y > 0.9f ? glm::vec3(8.0f) : glm::vec3(0.0f));
    });
    Light sun;
    sun.id = document.takeId();
    sun.type = LightType::Directional;
    sun.azimuthDeg = 30.0f;
    sun.elevationDeg = 40.0f;
    document.lights.push_back(sun);

    const auto maps = computeIbl(*document.environment().image, {}, JobContext());
    ASSERT_TRUE(maps.ok());
    setBackground(document.environment().image, *maps);
    const CubeAtlas atlas = makeCubeAtlas(maps->prefiltered);
    const Image dfg =
        computeDfgTable(128, Distribution::GGX, Visibility::SmithCorrelated, DfgTexels::ToTheEnds);

    FrameSettings settings;
    settings.samples = 1;
    settings.view.light = sun.id;
    draw(document, kSize, settings);

    std::mt19937 random(7); // the same pixels every time
    int looked = 0, lit = 0;
    while (looked < kPixels) {
        const auto x = static_cast<int>(random() % kSize), y = static_cast<int>(random() % kSize);
        const auto p = renderer().inspect(x, y);
        ASSERT_TRUE(p.ok()) << p.error().text();
        if (!p->onSurface())
            continue;
        ++looked;
        const glm::vec3 n(p->value(kViewShadingNormal));
        const float NoV = p->value(kViewNoV).x, r = p->value(kViewPerceptualRoughness).x;
        const float alpha = alphaFromPerceptualRoughness(r);

        const glm::vec2 uv = dfgTableUv(NoV, r);
        const glm::vec4 entry = sampleBilinear(dfg, uv.x, uv.y);
        EXPECT_NEAR(p->value(kViewDfgScale).x, entry.x, kTolerance);
        EXPECT_NEAR(p->value(kViewDfgBias).x, entry.y, kTolerance);
        EXPECT_NEAR(p->value(kRecordDfgMean).x, entry.z, kTolerance);

        expectNear(glm::vec3(p->value(kViewIrradiance)), sampleIrradiance(*maps, n), "irradiance");
        expectNear(glm::vec3(p->value(kViewPrefiltered)),
                   prefilteredOnCpu(atlas, glm::vec3(p->value(kRecordLobeDirection)), r),
                   "prefiltered");

        const float NoL = p->value(kViewNoL).x, VoH = p->value(kViewVoH).x,
                    NoH = p->value(kViewNoH).x;
        if (NoL <= 0.0f)
            continue;
        ++lit;
        EXPECT_NEAR(p->value(kViewD).x / D_GGX(NoH, alpha), 1.0f, kTolerance);
        EXPECT_NEAR(p->value(kViewG).x / (V_SmithGGXCorrelated(NoV, NoL, alpha) * 4.0f * NoL * NoV),
                    1.0f, kTolerance);
        expectNear(glm::vec3(p->value(kViewF)), F_Schlick(glm::vec3(p->value(kViewF0)), 1.0f, VoH),
                   "F");
    }
    EXPECT_GT(lit, kPixels / 4);
}

} // namespace
