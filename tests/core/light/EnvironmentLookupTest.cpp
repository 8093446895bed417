// The light of an environment looked up in directions, against closed forms and an exact sum.
#include "core/light/EnvironmentLookup.h"
#include "core/light/CubeSampling.h"
#include "core/math/Shading.h"
#include "tests/core/light/EnvironmentSum.h"
#include "tests/core/light/IrradianceSum.h"
#include "tests/core/light/LatLongPicture.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

using namespace patina;
using namespace patina::test;

namespace {

EnvironmentLookup makeLight(const ImagePtr& image, int levels = IblSettings().levels) {
    IblSettings settings = IblSettings::quick();
    settings.cubeSize = 32;
    settings.levels = levels;
    EnvironmentLookup light;
    light.analysis = analyseEnvironment(image, {});
    light.maps = std::make_shared<const IblMaps>(
        computeIbl(*light.analysis->environment, settings, {}).value());
    return light;
}

// Everything that can be looked up in a direction, with its name.
std::vector<std::pair<std::string, std::optional<glm::vec3>>>
lookUpAll(const EnvironmentLookup& light, const glm::vec3& d) {
    std::vector<std::pair<std::string, std::optional<glm::vec3>>> all{
        {"radiance", light.radiance(d)},
        {"irradianceSh9", light.irradianceSh9(d)},
        {"irradiance", light.irradiance(d)}};
    for (int n = 1; n <= kMaxShOrder; ++n)
        all.emplace_back("bandSum " + std::to_string(n), light.bandSum(n, d));
    for (int step = 0; step < kRoughnessSteps; ++step)
        all.emplace_back("prefiltered " + std::to_string(step),
                         light.prefiltered(roughnessStep(step), d));
    return all;
}

bool isIrradiance(const std::string& name) {
    return name.starts_with("irradiance");
}

} // namespace

TEST(EnvironmentLookup, AConstantEnvironmentIsConstantEverywhere) {
    const glm::vec3 radiance(0.5f, 0.25f, 0.125f);
    for (const glm::ivec2 size : {glm::ivec2(1, 1), {2, 1}, {64, 32}}) {
        EnvironmentLookup light =
            makeLight(latLong(size.x, size.y, [&](const glm::vec3&) { return radiance; }));
        light.orientation = 33.0f;
        for (const glm::vec3 d : {glm::vec3(0, 1, 0), {0, 0, -1}, {0.48f, -0.6f, 0.64f}})
            for (const auto& [name, value] : lookUpAll(light, d))
                EXPECT_LT(glm::distance(value.value(),
                                        (isIrradiance(name) ? std::numbers::pi_v<float> : 1.0f) *
                                            radiance),
                          3e-4f)
                    << name;
        EXPECT_LT(irradianceError(*light.maps), 1e-3);
    }
}

TEST(EnvironmentLookup, RotatesAndBrightensWithTheEnvironment) {
    const auto radiance = [](const glm::vec3& d) {
        return glm::vec3(1.0f) + glm::vec3(0.9f * d.x, 0.5f * d.y, 0.8f * d.z);
    };
    const EnvironmentLookup light = makeLight(latLong(128, 64, radiance));
    EnvironmentLookup turned = light;
    turned.orientation = 90.0f; // what stood at +X stands at -Z, seen from above
    turned.scale = 4.0f;
    const auto before = lookUpAll(light, {1, 0, 0}), after = lookUpAll(turned, {0, 0, -1});
    for (std::size_t i = 0; i < before.size(); ++i) {
        const auto& [name, value] = before[i];
        EXPECT_LT(glm::distance(4.0f * value.value(), after[i].second.value()), 2e-2f) << name;
        if (name != "bandSum 1") {
            EXPECT_GT(value->x, value->z + 0.2f) << name;
        }
    }
    // A linear function: two bands hold it, and irradiance is pi + 2pi/3 of its slope.
    const glm::vec3 d = glm::normalize(glm::vec3(0.3f, -0.5f, 0.8f));
    EXPECT_LT(glm::distance(light.bandSum(2, d).value(), radiance(d)), 1e-3f);
    const glm::vec3 irradiance =
        std::numbers::pi_v<float> *
        (glm::vec3(1.0f) + 2.0f / 3.0f * glm::vec3(0.9f * d.x, 0.5f * d.y, 0.8f * d.z));
    EXPECT_LT(glm::distance(light.irradianceSh9(d).value(), irradiance), 2e-3f);
    EXPECT_LT(glm::distance(light.irradiance(d).value(), irradiance), 3e-2f);
}

TEST(EnvironmentLookup, IrradianceIsThatOfThePicture) {
    const std::vector<glm::vec3> normals = reference::irradianceNormals(200);
    for (const auto& [name, image] : reference::irradianceEnvironments()) {
        EnvironmentLookup light;
        light.maps = std::make_shared<const IblMaps>(computeIbl(*image, {}, {}).value());
        std::vector<glm::vec3> seen;
        for (const glm::vec3& n : normals)
            seen.push_back(light.irradiance(n).value());
        const reference::LookupError error =
            reference::irradianceErrors(seen, reference::irradianceSums(*image, normals));
        EXPECT_LE(error.rms, 0.003) << name;
        EXPECT_LE(error.most, 0.01) << name;
    }
}

TEST(EnvironmentLookup, DraftsHoldTheSameRoughness) {
    const ImagePtr image =
        latLong(64, 32, [](const glm::vec3& d) { return glm::vec3(d.x > 0.5f ? 4.0f : 0.1f); });
    const EnvironmentLookup draft = makeLight(image, 5);
    const glm::vec3 d = glm::normalize(glm::vec3(0.7f, 0.4f, 0.2f));
    // Both mirrors, and both wholly rough; in between a mix of two levels, whichever they are.
    EXPECT_EQ(draft.prefiltered(0.0f, d).value(), sampleCube(draft.maps->prefiltered.front(), d));
    EXPECT_LT(glm::distance(draft.prefiltered(1.0f, d).value(),
                            sampleCube(draft.maps->prefiltered.back(), d)),
              1e-5f);
    const float level = shading::prefilteredLevel(0.5f, 5, 32.0f);
    const auto fine = static_cast<std::size_t>(level);
    EXPECT_LT(glm::distance(draft.prefiltered(0.5f, d).value(),
                            glm::mix(sampleCube(draft.maps->prefiltered[fine], d),
                                     sampleCube(draft.maps->prefiltered[fine + 1], d),
                                     level - static_cast<float>(fine))),
              1e-5f);
    // What a draft lacks are levels, not light: both are close to the exact sum.
    const float exact =
        reference::EnvironmentSum(draft.maps->prefiltered.front()).at(d, std::vector{0.5f})[0].x;
    const EnvironmentLookup full = makeLight(image);
    EXPECT_NEAR(full.prefiltered(0.5f, d)->x / exact, 1.0f, 0.01f);
    EXPECT_NEAR(draft.prefiltered(0.5f, d)->x / exact, 1.0f, 0.03f);
}

TEST(EnvironmentLookup, WhatIsNoLightIsReplacedAndCounted) {
    auto image =
        std::make_shared<Image>(*latLong(16, 8, [](const glm::vec3&) { return glm::vec3(1.0f); }));
    image->f32()[5] = std::numeric_limits<float>::quiet_NaN();
    image->f32()[60] = -3.0f;
    image->f32()[90] = std::numeric_limits<float>::infinity();
    const EnvironmentAnalysisPtr analysis = analyseEnvironment(image, {});
    EXPECT_EQ(analysis->invalidSamples, 3u);
    EXPECT_TRUE(std::isfinite(analysis->bands.sums[7].rmse));
    for (const float value : analysis->environment->f32())
        EXPECT_TRUE(value >= 0.0f && std::isfinite(value));
    EXPECT_FALSE(std::isfinite(image->f32()[5])) << "the document's image stays as it is";
}

TEST(EnvironmentLookup, NothingIsFoundInWhatIsNotThere) {
    for (const auto& [name, value] : lookUpAll({}, {0, 1, 0}))
        EXPECT_FALSE(value) << name;
    JobControl control;
    control.cancel();
    EXPECT_EQ(analyseEnvironment(latLong(64, 32, [](const glm::vec3&) { return glm::vec3(1); }),
                                 control.context()),
              nullptr);
}

// A cap of light: bands miss its edge, and ring below zero beside it.
TEST(EnvironmentLookup, StatesHowFarBandsAreFromTheEnvironment) {
    const auto cap = [](const glm::vec3& d) { return glm::vec3(d.x > 0.8f ? 5.0f : 0.0f); };
    EnvironmentLookup light;
    light.analysis = analyseEnvironment(latLong(128, 64, cap), {});
    const ShBands& bands = light.analysis->bands;
    EnvironmentLookup turned = light;
    turned.orientation = 90.0f;
    turned.setScale({1.0f, 4.0f, 2.0f});
    EXPECT_EQ(turned.tint, glm::vec3(0.25f, 1.0f, 0.5f));
    EXPECT_DOUBLE_EQ(turned.rms(), 4.0 * light.rms());
    for (int n = 1; n <= kMaxShOrder; ++n) {
        const ShBandSum& sum = bands.sums[static_cast<std::size_t>(n - 1)];
        const BandSumError error = light.bandSumError(n), rotated = turned.bandSumError(n);
        EXPECT_DOUBLE_EQ(error.rmse, sum.rmse);
        EXPECT_DOUBLE_EQ(error.share, sum.rmse / bands.rms);
        EXPECT_EQ(error.belowZero, n > 1) << "the first band is the mean";
        EXPECT_DOUBLE_EQ(rotated.rmse, 4.0 * error.rmse);
        EXPECT_DOUBLE_EQ(rotated.share, error.share);
        EXPECT_DOUBLE_EQ(rotated.lowest, 4.0 * error.lowest);
        EXPECT_NEAR(light.bandSum(n, error.lowestDirection)->x, error.lowest, 1e-4);
        EXPECT_NEAR(turned.bandSum(n, rotated.lowestDirection)->y, rotated.lowest, 4e-4);
    }
    light.setScale(glm::vec3(0.0f));
    EXPECT_EQ(light.tint, glm::vec3(1.0f));
    EXPECT_EQ(light.rms(), 0.0);
}
