#include "core/mix/LightMix.h"
#include "core/light/Light.h"

#include "core/edit/Edit.h"
#include "core/light/Ibl.h"
#include "core/light/Lights.h"
#include "core/math/ShRotation.h"
#include "core/math/SphericalHarmonics.h"
#include "core/mix/EnvironmentBlend.h"
#include "core/scene/DocumentIO.h"
#include "tests/support/SecondEnvironment.h"

#include <cmath>
#include <glm/trigonometric.hpp>
#include <gtest/gtest.h>

namespace patina {
namespace {

using Role = EnvironmentPart::Role;

// A gradient with a lamp: nothing about it is symmetric.
ImagePtr picture(int width, float base, int lampX, int lampY) {
    Image image(width, width / 2, 3, PixelType::F32, ColorEncoding::Linear);
    for (int y = 0; y < width / 2; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < 3; ++c)
                image.f32()[static_cast<std::size_t>(3 * (y * width + x) + c)] =
                    base * static_cast<float>(1 + c) * (1.0f + static_cast<float>(y)) +
                    (x == lampX && y == lampY ? 40.0f : 0.0f);
    return std::make_shared<const Image>(std::move(image));
}

class LightMix : public testing::Test {
  protected:
    LightMix() {
        Environment& other =
            test::addSecond(document, "/tmp/second.hdr", picture(64, 0.03f, 40, 20));
        other.rotationDeg = 75.0f; // 45° and 8 of 64 pixels further
        other.exposureEv = -1.0f;
        other.tint = {0.2f, 0.4f, 0.8f};
        Environment& e = document.environment();
        e.image = e.fileImage = picture(64, 0.01f, 10, 9);
        e.rotationDeg = 30.0f;
        e.exposureEv = 1.0f;
        e.tint = {1.0f, 0.5f, 0.25f};
        document.lights.resize(2);
    }
    Environment& other() { return *document.secondEnvironment(); }
    Document document;
};

TEST_F(LightMix, TheFadeSharesTheLightOut) {
    Environment& e = document.environment();
    ASSERT_EQ(environmentParts(document).size(), 1u); // fade 0
    EXPECT_EQ(environmentParts(document)[0],
              (EnvironmentPart{Role::First, e.image, 30.0f, {2.0f, 1.0f, 0.5f}}));
    document.mix.fade = 0.25f;
    ASSERT_EQ(environmentParts(document).size(), 2u);
    EXPECT_EQ(environmentParts(document)[0],
              (EnvironmentPart{Role::First, e.image, 30.0f, {1.5f, 0.75f, 0.375f}}));
    const EnvironmentPart second = environmentParts(document)[1];
    EXPECT_EQ(second.role, Role::Second);
    EXPECT_EQ(second.image, other().image);
    EXPECT_EQ(second.orientation, Orientation(75.0f));
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(second.scale[c], 0.25f * 0.5f * other().tint[c], 1e-7f);
    document.mix.fade = 1.0f;
    ASSERT_EQ(environmentParts(document).size(), 1u);
    EXPECT_EQ(environmentParts(document)[0].role, Role::Second);
    other().image = nullptr; // nothing to fade to
    ASSERT_EQ(environmentParts(document).size(), 1u);
    EXPECT_EQ(environmentParts(document)[0],
              (EnvironmentPart{Role::First, e.image, 30.0f, {2.0f, 1.0f, 0.5f}}));
}

TEST_F(LightMix, SoloAndMuteAreOfOneDeskForLightsAndEnvironments) {
    Environment& e = document.environment();
    document.mix.fade = 0.5f;
    document.lights[1].solo = true;
    EXPECT_TRUE(anySolo(document));
    EXPECT_FALSE(isActive(document, document.lights[0]));
    EXPECT_TRUE(isActive(document, document.lights[1]));
    EXPECT_TRUE(environmentParts(document).empty());
    EXPECT_EQ(shownEnvironment(document).scale, glm::vec3(0.0f));
    EXPECT_EQ(shownEnvironment(document).image, e.image); // no picture is prepared for nothing

    document.lights[1].solo = false;
    other().solo = true;
    EXPECT_FALSE(isActive(document, document.lights[0]));
    ASSERT_EQ(environmentParts(document).size(), 1u);
    EXPECT_EQ(environmentParts(document)[0].role, Role::Second);
    e.solo = true;
    EXPECT_EQ(environmentParts(document).size(), 2u);
    e.enabled = false; // muted and solo: silent
    EXPECT_EQ(environmentParts(document).size(), 1u);
    other().enabled = false;
    EXPECT_TRUE(environmentParts(document).empty());

    // What is solo is there in full, wherever the cross-fade stands.
    e.enabled = other().enabled = true;
    for (const bool second : {false, true})
        for (const float fade : {0.0f, 0.3f, 1.0f}) {
            document.mix.fade = fade;
            e.solo = !second;
            other().solo = second;
            ASSERT_EQ(environmentParts(document).size(), 1u) << fade;
            const EnvironmentPart part = environmentParts(document)[0];
            EXPECT_EQ(part.role, second ? Role::Second : Role::First);
            EXPECT_EQ(part.scale, second ? 0.5f * other().tint : 2.0f * e.tint) << fade;
            EXPECT_EQ(shownEnvironment(document), part);
        }
    document.mix.fade = 0.25f;
    e.solo = other().solo = true; // both: as without
    EXPECT_EQ(environmentParts(document).size(), 2u);
    e.solo = other().solo = false;
    document.lights[0].solo = true;
    EXPECT_TRUE(environmentParts(document).empty());
    document.lights[0].solo = false;

    // A second environment that was taken out of the mix takes its solo along.
    other().solo = true;
    EXPECT_TRUE(anySolo(document));
    document.mix.second = 0;
    EXPECT_FALSE(anySolo(document));
    EXPECT_TRUE(isActive(document, document.lights[0]));
}

TEST_F(LightMix, GainAndTintMultiplyTheLightOnTopOfItsOwnColour) {
    Light light;
    light.intensity = 3.0f;
    light.color = {1.0f, 0.5f, 0.25f};
    light.tint = {0.5f, 1.0f, 0.5f};
    light.gainEv = -2.0f;
    EXPECT_EQ(lightIntensity(light), 0.75f);
    EXPECT_EQ(lightPower(light), glm::vec3(0.375f, 0.375f, 0.09375f));
    EXPECT_EQ(illuminanceAt(light, {}), 0.75f);
    light.usesTemperature = true; // the filter is in front of the glowing body too
    EXPECT_EQ(lightPower(light), lightColor(light) * light.tint * 0.75f);
    // Another type goes on shining at the gain it has.
    Bounds scene;
    scene.add({-1, -1, -1});
    scene.add({1, 1, 1});
    const Light point = convertedLight(light, LightType::Point, scene);
    EXPECT_EQ(point.gainEv, -2.0f);
    EXPECT_NEAR(illuminanceAt(point, scene.center()), 0.75f, 1e-5f);
}

// The picture of both has the sum of their light: each turned and scaled, by coefficients.
TEST_F(LightMix, TheBlendedPictureIsTheSumOfTheParts) {
    for (const Orientation& turn :
         {Orientation(75.0f), Orientation(77.7f), {75.0f, 30.0f, -20.0f}}) {
        for (const int secondWidth : {64, 32}) {
            SCOPED_TRACE(turn.rotationDeg);
            SCOPED_TRACE(turn.tiltDeg);
            SCOPED_TRACE(secondWidth);
            other().image = picture(secondWidth, 0.03f, 20, 11);
            other().rotationDeg = turn.rotationDeg;
            other().tiltDeg = document.environment().rollDeg = turn.tiltDeg;
            other().rollDeg = turn.rollDeg;
            document.mix.fade = 0.4f;
            resolveBlend(document);
            const EnvironmentPart shown = shownEnvironment(document);
            ASSERT_EQ(shown.role, Role::Both);
            ASSERT_EQ(shown.image, document.mix.blended);
            EXPECT_EQ(shown.image->width(), 64);
            const auto coefficients = [](const EnvironmentPart& part) {
                std::vector<glm::vec3> c = projectLatLong(*part.image, 4);
                std::vector<glm::vec3> turned(c.size());
                part.orientation.harmonics(4).apply(std::span<const glm::vec3>(c),
                                                    std::span<glm::vec3>(turned));
                for (glm::vec3& value : turned)
                    value *= part.scale;
                return turned;
            };
            const std::vector<glm::vec3> sum = coefficients(shown);
            const std::vector<EnvironmentPart> parts = environmentParts(document);
            const auto first = coefficients(parts[0]), second = coefficients(parts[1]);
            // Whole pixels of one size are exact; others smear by less than a pixel.
            const bool exact = turn == Orientation(75.0f) && secondWidth == 64;
            for (std::size_t i = 0; i < sum.size(); ++i)
                for (int c = 0; c < 3; ++c)
                    EXPECT_NEAR(sum[i][c], first[i][c] + second[i][c],
                                (exact ? 1e-5f : 5e-3f) * std::abs(sum[0][c]))
                        << i << ' ' << c;
        }
    }
    document.mix.fade = 0.0f;
    resolveBlend(document);
    EXPECT_EQ(document.mix.blended, nullptr);
    EXPECT_EQ(shownEnvironment(document).role, Role::First);
}

// For files that know of no mix: a single environment that lights the scene alike.
TEST_F(LightMix, BecomesASingleEnvironment) {
    Environment& e = document.environment();
    const auto single = [&](float fade) {
        document.mix.fade = fade;
        const std::optional<Environment> mixed = mixedEnvironment(document);
        EXPECT_TRUE(mixed.has_value());
        const Environment alone = mixed.value_or(Environment());
        EXPECT_EQ(alone.tint, glm::vec3(1.0f));
        return alone;
    };
    const auto texel = [](const Environment& from, int x, int y, int c) {
        return from.image->f32()[static_cast<std::size_t>(3 * (y * 64 + x) + c)] *
               std::exp2(from.exposureEv);
    };
    const auto scaled = [&](const ImagePtr& image, int x, int y, int c, float scale) {
        return scale * image->f32()[static_cast<std::size_t>(3 * (y * 64 + x) + c)];
    };
    const glm::vec3 first(2.0f, 1.0f, 0.5f), second(0.1f, 0.2f, 0.4f); // tint · 2^EV
    const Environment a = single(0.0f), b = single(1.0f), both = single(0.25f);
    EXPECT_EQ(a.rotationDeg, 30.0f);
    EXPECT_EQ(b.rotationDeg, 75.0f);
    EXPECT_EQ(b.source, "/tmp/second.hdr");
    EXPECT_EQ(both.rotationDeg, 30.0f);
    for (const auto& [x, y] : {std::pair(10, 9), std::pair(40, 20), std::pair(0, 0)})
        for (int c = 0; c < 3; ++c) {
            EXPECT_FLOAT_EQ(texel(a, x, y, c), scaled(e.image, x, y, c, first[c]));
            EXPECT_FLOAT_EQ(texel(b, x, y, c), scaled(other().image, x, y, c, second[c]));
        }
    // The second stands 45° and 8 of 64 pixels further: of the two lamps each is where it was seen.
    const auto sum = [&](int c) {
        double total = 0.0;
        for (int y = 0; y < 32; ++y)
            for (int x = 0; x < 64; ++x)
                total += static_cast<double>(texel(both, x, y, c));
        return total;
    };
    for (int c = 0; c < 3; ++c) {
        double expected = 0.0;
        for (int y = 0; y < 32; ++y)
            for (int x = 0; x < 64; ++x)
                expected += static_cast<double>(scaled(e.image, x, y, c, 0.75f * first[c]) +
                                                scaled(other().image, x, y, c, 0.25f * second[c]));
        EXPECT_NEAR(sum(c), expected, 1e-4 * expected) << c;
        EXPECT_GT(texel(both, 10, 9, c), 40.0f * 0.75f * first[c]);
    }

    // What is plain already stays the picture that it is; without an environment there is none.
    e.tint = glm::vec3(1.0f);
    const Environment plain = single(0.0f);
    EXPECT_EQ(plain.image, e.image);
    EXPECT_EQ(plain.exposureEv, 1.0f);
    e.enabled = false;
    EXPECT_EQ(mixedEnvironment(document), std::nullopt);
    document.mix.fade = 0.5f;
    EXPECT_EQ(mixedEnvironment(document)->source, "/tmp/second.hdr") << "the other one is still on";
    e.enabled = true;
    JobControl control;
    control.cancel();
    EXPECT_EQ(mixedEnvironment(document, control.context()), std::nullopt);
}

TEST_F(LightMix, ProjectsKeepTheMix) {
    Environment& e = document.environment();
    document.mix.fade = 0.375f;
    e.solo = true;
    e.enabled = false;
    other().enabled = false;
    other().solo = true;
    Document& d = document;
    d.lights.clear();
    Light light;
    light.gainEv = 1.25f;
    light.tint = {0.5f, 0.75f, 1.0f};
    addLight(d, light);
    const Result<Document> read =
        documentFromJson(documentToJson(d, "/tmp/a.patina"), "/tmp/a.patina");
    ASSERT_TRUE(read.ok()) << read.error().text();
    Environment expected = other();
    expected.image = expected.fileImage = nullptr; // read from its file with the project
    ASSERT_NE(read->secondEnvironment(), nullptr);
    EXPECT_EQ(*read->secondEnvironment(), expected);
    EXPECT_EQ(read->mix.fade, 0.375f);
    EXPECT_TRUE(read->environment().solo);
    EXPECT_FALSE(read->environment().enabled);
    EXPECT_EQ(read->environment().tint, e.tint);
    EXPECT_EQ(read->lights[0].gainEv, 1.25f);
    EXPECT_EQ(read->lights[0].tint, light.tint);
}

} // namespace
} // namespace patina
