// Light maps: against closed forms, and against the paths that they stand for.
#include "core/bake/lightmap/LightMapBake.h"

#include "core/bake/lightmap/LightMap.h"
#include "core/bake/lightmap/LightMapFilter.h"
#include "core/job/Parallel.h"
#include "core/light/Ibl.h"
#include "core/math/Shading.h"
#include "tests/core/trace/TraceBall.h"

#include <algorithm>
#include <cmath>
#include <gmock/gmock.h>
#include <random>

namespace patina::test {
namespace {

// A square about the Y axis at height y with texture coordinates, its front up or down.
MeshPtr square(float side, float y, bool up) {
    Mesh mesh;
    const float h = 0.5f * side;
    for (const glm::vec2 corner :
         {glm::vec2(-h, h), glm::vec2(h, h), glm::vec2(h, -h), glm::vec2(-h, -h)}) {
        mesh.positions.emplace_back(corner.x, y, corner.y);
        mesh.normals.emplace_back(0.0f, up ? 1.0f : -1.0f, 0.0f);
        mesh.tangents.emplace_back(1.0f, 0.0f, 0.0f, 1.0f);
        mesh.uvs.emplace_back(0.5f + corner.x / side, 0.5f + corner.y / side);
    }
    mesh.indices = up ? std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3}
                      : std::vector<std::uint32_t>{0, 2, 1, 0, 3, 2};
    return std::make_shared<const Mesh>(std::move(mesh));
}

LightMapInputs withImageLight(TraceInputs scene) {
    LightMapInputs inputs{std::move(scene), {}, {}};
    const auto maps =
        computeIbl(*inputs.scene.environments[0].image, IblSettings::quick(), JobContext());
    EXPECT_TRUE(maps.ok());
    inputs.imageLight.maps = std::make_shared<const IblMaps>(*maps);
    return inputs;
}

// A floor of side 0.1 under a square black ceiling of side 2, 1 above it, in a uniform sky.
LightMapInputs underCeiling(float roughness, float metallic) {
    TraceInputs scene;
    scene.model.fresnel = Fresnel::Dielectric;
    scene.model.ior = 1.0f; // the black ceiling has no gloss
    scene.materials.resize(2);
    scene.materials[0].id = 7;
    scene.materials[0].baseColor = glm::vec3(1.0f);
    scene.materials[0].metallic = metallic;
    scene.materials[0].perceptualRoughness = roughness;
    scene.materials[1].id = 8;
    scene.materials[1].baseColor = glm::vec3(0.0f);
    scene.materials[1].metallic = 0.0f;
    scene.meshes = {{1, square(0.1f, 0.0f, true), glm::mat4(1.0f), 0},
                    {2, square(2.0f, 1.0f, false), glm::mat4(1.0f), 1}};
    scene.environments = {{uniformSky(1.0f), 0.0f, glm::vec3(1.0f)}};
    return withImageLight(std::move(scene));
}

// Howell, A Catalog of Radiation Heat Transfer Configuration Factors, B-3: from an element to a
// parallel rectangle above, four times that of a corner with sides and height 1.
const float kHidden = 4.0f / glm::pi<float>() / std::sqrt(2.0f) * std::atan(1.0f / std::sqrt(2.0f));

const float* texel(const TexelBake& bake, int x, int y) {
    return bake.values.data() + static_cast<std::size_t>(y * bake.side + x) * kLightMapStride;
}

float hiddenAt(const float* values, const glm::vec3& mirrored) {
    const LightMapBasis basis = lightMapBasis(glm::normalize(mirrored));
    float sum = 0.0f;
    for (std::size_t j = 0; j < kLightMapTerms; ++j)
        sum += basis[j] * values[4 * (1 + j) + 3];
    return sum;
}

LightMapSettings quick(int size, int samples) {
    LightMapSettings settings;
    settings.size = size;
    settings.samples = samples;
    return settings;
}

} // namespace

TEST(LightMapTest, ABallInUniformLightHasNothingToCorrect) {
    Material material;
    material.id = 3;
    material.perceptualRoughness = 0.5f;
    const auto bake =
        bakeLightMap(withImageLight(ballUnderSky(material)), quick(16, 256), JobContext());
    ASSERT_TRUE(bake.ok());
    ASSERT_EQ(bake->texels.size(), 1u);
    const TexelBake& texels = bake->texels[0];
    ASSERT_EQ(texels.stride, kLightMapStride);
    EXPECT_EQ(texels.material, 3u);
    for (int y = 2; y < 14; ++y)
        for (int x = 0; x < 16; ++x) {
            const float* values = texel(texels, x, y);
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(values[c], 0.0f, 0.04f * glm::pi<float>()) << x << ", " << y;
            EXPECT_NEAR(values[3], 1.0f, 0.01f);
            for (std::size_t j = 0; j < kLightMapTerms; ++j)
                for (std::size_t c = 0; c < 3; ++c) // light of surfaces
                    EXPECT_EQ(values[4 * (1 + j) + c], 0.0f);
            // Texture coordinates of ball().
            const float theta = glm::pi<float>() * (static_cast<float>(y) + 0.5f) / 16.0f;
            const float phi = 2.0f * glm::pi<float>() * (static_cast<float>(x) + 0.5f) / 16.0f;
            const glm::vec3 n(std::sin(theta) * std::sin(phi), std::cos(theta),
                              std::sin(theta) * std::cos(phi));
            EXPECT_NEAR(hiddenAt(values, n), 0.0f, 0.1f) << x << ", " << y;
            EXPECT_NEAR(hiddenAt(values, n + glm::vec3(0.3f)), 0.0f, 0.1f) << x << ", " << y;
        }
}

TEST(LightMapTest, ACeilingHidesWhatItsFormFactorSays) {
    const auto bake = bakeLightMap(underCeiling(1.0f, 0.0f), quick(3, 4096), JobContext());
    ASSERT_TRUE(bake.ok());
    const float* values = texel(bake->texels[0], 1, 1);
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(values[c], -glm::pi<float>() * kHidden, 0.01f * glm::pi<float>());
    EXPECT_NEAR(values[3], 1.0f - kHidden, 0.01f);
    // Light comes from all sides alike: on the mean from above, weaker by the cosine.
    const float* open = values + 4 * (1 + kLightMapTerms);
    EXPECT_NEAR(open[0], 0.0f, 0.01f);
    EXPECT_NEAR(open[2], 0.0f, 0.01f);
    EXPECT_GT(open[1], 0.1f);
    EXPECT_LT(open[1], values[3]);
}

TEST(LightMapTest, AMirrorSeesTheCeilingAboveAndTheSkyBesideIt) {
    LightMapInputs inputs = underCeiling(0.1f, 1.0f);
    inputs.scene.model = {};
    const auto bake = bakeLightMap(inputs, quick(3, 4096), JobContext());
    ASSERT_TRUE(bake.ok());
    const float* values = texel(bake->texels[0], 1, 1);
    // The ceiling ends at 45 degrees and more; nine harmonics make the edge soft and overshoot.
    EXPECT_GT(hiddenAt(values, {0.0f, 1.0f, 0.0f}), 0.9f);
    EXPECT_NEAR(hiddenAt(values, {1.0f, 0.4f, 0.0f}), 0.0f, 0.2f);
    EXPECT_NEAR(hiddenAt(values, {0.0f, 0.4f, -1.0f}), 0.0f, 0.2f);
}

TEST(LightMapTest, LightOfSurfacesIsAdded) {
    LightMapInputs inputs = underCeiling(0.1f, 1.0f);
    inputs.scene.model = {};
    inputs.scene.materials[1].emissive = {2.0f, 1.0f, 0.5f};
    const auto bake = bakeLightMap(inputs, quick(3, 1024), JobContext());
    ASSERT_TRUE(bake.ok());
    const float* values = texel(bake->texels[0], 1, 1);
    const LightMapBasis up = lightMapBasis({0.0f, 1.0f, 0.0f});
    for (std::size_t c = 0; c < 3; ++c) {
        float radiance = 0.0f;
        for (std::size_t j = 0; j < kLightMapTerms; ++j)
            radiance += up[j] * values[4 * (1 + j) + c];
        const float glow = inputs.scene.materials[1].emissive[static_cast<int>(c)];
        EXPECT_NEAR(radiance, glow, 0.4f * glow);
        EXPECT_NEAR(values[c], glm::pi<float>() * kHidden * (glow - 1.0f),
                    0.03f * glm::pi<float>());
    }
}

TEST(LightMapTest, LightStraightFromLightsIsLeftToTheViewport) {
    LightMapInputs inputs = underCeiling(1.0f, 0.0f);
    const auto dark = bakeLightMap(inputs, quick(3, 64), JobContext());
    Light lamp;
    lamp.type = LightType::Point;
    lamp.position = {0.0f, 0.5f, 0.0f};
    lamp.intensity = 5.0f;
    inputs.scene.lights = {lamp};
    const auto lit = bakeLightMap(inputs, quick(3, 64), JobContext());
    ASSERT_TRUE(dark.ok() && lit.ok());
    EXPECT_EQ(texel(dark->texels[0], 1, 1)[0], texel(lit->texels[0], 1, 1)[0]);
    EXPECT_NE(dark->light, lit->light);
    EXPECT_EQ(dark->inputs, lit->inputs);
    // The white floor's light comes back from a ceiling that is not black.
    inputs.scene.materials[1].baseColor = glm::vec3(0.8f);
    const auto bounced = bakeLightMap(inputs, quick(3, 64), JobContext());
    inputs.scene.lights.clear();
    const auto bouncedDark = bakeLightMap(inputs, quick(3, 64), JobContext());
    ASSERT_TRUE(bounced.ok() && bouncedDark.ok());
    EXPECT_GT(texel(bounced->texels[0], 1, 1)[0], texel(bouncedDark->texels[0], 1, 1)[0] + 0.1f);
}

TEST(LightMapTest, TheSameForAnyNumberOfThreads) {
    const LightMapInputs inputs = underCeiling(0.4f, 0.5f);
    std::vector<TexelBake> first;
    for (const int threads : {1, 2, 7}) {
        const ThreadLimit limit(threads);
        const auto bake = bakeLightMap(inputs, quick(12, 16), JobContext());
        ASSERT_TRUE(bake.ok());
        if (first.empty())
            first = bake->texels;
        EXPECT_EQ(bake->texels, first) << threads;
    }
}

TEST(LightMapTest, AStopKeepsWhatThereIsAndACancelNothing) {
    const LightMapInputs inputs = underCeiling(0.4f, 0.5f);
    JobControl stopped;
    stopped.stop();
    const auto none = bakeLightMap(inputs, quick(4, 32), stopped.context());
    ASSERT_TRUE(none.ok());
    EXPECT_EQ(none->samplesDone, 0);
    EXPECT_TRUE(none->stopped);
    for (const float value : std::span(texel(none->texels[0], 1, 1), 3))
        EXPECT_EQ(value, 0.0f); // image-based light as it is
    JobControl cancelled;
    cancelled.cancel();
    const auto nothing = bakeLightMap(inputs, quick(4, 32), cancelled.context());
    ASSERT_FALSE(nothing.ok());
    EXPECT_EQ(nothing.error().kind, ErrorKind::Cancelled);
}

TEST(LightMapTest, WhatCannotBeBakedIsRefused) {
    LightMapInputs inputs = underCeiling(0.4f, 0.5f);
    EXPECT_EQ(bakeLightMap(inputs, quick(4096, 8), {}).error().kind, ErrorKind::Usage);
    EXPECT_EQ(bakeLightMap(inputs, quick(0, 8), {}).error().kind, ErrorKind::Usage);
    EXPECT_EQ(bakeLightMap(inputs, quick(8, 0), {}).error().kind, ErrorKind::Usage);
    LightMapInputs plain = inputs;
    Mesh bare = *plain.scene.meshes[0].mesh;
    bare.uvs.clear();
    plain.scene.meshes[0].mesh = std::make_shared<const Mesh>(bare);
    EXPECT_EQ(bakeLightMap(plain, quick(8, 8), {}).error().kind, ErrorKind::InputBroken);
    plain.scene.meshes.clear();
    EXPECT_EQ(bakeLightMap(plain, quick(8, 8), {}).error().kind, ErrorKind::InputBroken);
}

TEST(LightMapFitTest, FindsWhatHarmonicsAreSumsOf) {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> uniform(-1.0f, 1.0f);
    std::array<float, kLightMapTerms> truth{};
    for (float& value : truth)
        value = uniform(random);
    for (const glm::vec3 normal : {glm::vec3(0.0f, 1.0f, 0.0f), glm::vec3(0.6f, -0.64f, 0.48f)}) {
        std::array<glm::vec4, kLightMapTerms> moments{};
        constexpr int kCount = 200000;
        int used = 0;
        while (used < kCount) {
            const glm::vec3 d(uniform(random), uniform(random), uniform(random));
            const float length = glm::length(d);
            if (length > 1.0f || length < 1e-3f || glm::dot(d, normal) <= 0.0f)
                continue;
            ++used;
            const LightMapBasis y = lightMapBasis(d / length);
            float f = 0.0f;
            for (std::size_t j = 0; j < kLightMapTerms; ++j)
                f += truth[j] * y[j];
            for (std::size_t j = 0; j < kLightMapTerms; ++j)
                moments[j] += glm::vec4(f * y[j] / kCount);
        }
        const auto found = fitHemisphere(normal, moments, 0.0);
        // Over the hemisphere, where views are: the harmonics themselves are told apart badly.
        for (int i = 0; i < 64; ++i) {
            glm::vec3 d(uniform(random), uniform(random), uniform(random));
            if (glm::dot(d, normal) < 0.0f)
                d = -d;
            const LightMapBasis y = lightMapBasis(glm::normalize(d));
            float expected = 0.0f, sum = 0.0f;
            for (std::size_t j = 0; j < kLightMapTerms; ++j) {
                expected += truth[j] * y[j];
                sum += found[j].x * y[j];
            }
            EXPECT_NEAR(sum, expected, 0.05f);
        }
    }
}

TEST(LightMapFilterTest, TakesNoiseAndKeepsEdges) {
    constexpr int kSide = 32;
    std::mt19937 random(5);
    std::normal_distribution<float> noise(0.0f, 0.1f);
    LightMapTexture texture{kSide, std::vector<LightMapTexture::Texel>(kSide * kSide)};
    const auto truth = [](int x) { return x < kSide / 2 ? 1.0f : 3.0f; };
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) {
            LightMapTexture::Texel& texel = texture.at(x, y);
            texel.position = {x, 0.0f, y};
            texel.normal = {0.0f, 1.0f, 0.0f};
            texel.variance = glm::vec3(0.01f);
            texel.values[0] = glm::vec4(glm::vec3(truth(x) + noise(random)), 1.0f);
        }
    const LightMapTexture before = texture;
    texture.at(5, 5).values[0] = glm::vec4(glm::vec3(40.0f), 1.0f); // one path's
    // Another surface, beside it in the texture alone.
    for (int x = 0; x < kSide; ++x) {
        texture.at(x, 0).normal = {0.0f, -1.0f, 0.0f};
        texture.at(x, 0).values[0] = glm::vec4(glm::vec3(-7.0f), 1.0f);
    }
    filterLightMap(texture, JobContext());
    double errorBefore = 0.0, errorAfter = 0.0;
    for (int y = 4; y < kSide - 3; ++y)
        for (int x = 4; x < kSide - 3; ++x) {
            errorBefore += std::pow(before.at(x, y).values[0].x - truth(x), 2.0f);
            errorAfter += std::pow(texture.at(x, y).values[0].x - truth(x), 2.0f);
        }
    EXPECT_LT(errorAfter, 0.1 * errorBefore);
    for (int x = 0; x < kSide; ++x)
        EXPECT_NEAR(texture.at(x, 0).values[0].x, -7.0f, 1e-4f);
}

} // namespace patina::test
