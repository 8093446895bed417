// What lights do, against what can be worked out by hand.
#include "core/light/Lights.h"
#include "core/light/Light.h"
#include "core/mix/LightMix.h"

#include "core/edit/Parameters.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/trigonometric.hpp>
#include <gtest/gtest.h>

namespace patina {
namespace {

Light lightOf(LightType type) {
    Light light;
    light.type = type;
    return light;
}

// A scene of radius sqrt(3) whose centre is (1, 2, 3).
Bounds scene() {
    Bounds bounds;
    bounds.add(glm::vec3(0, 1, 2));
    bounds.add(glm::vec3(2, 3, 4));
    return bounds;
}

constexpr LightType kTypes[] = {LightType::Point, LightType::Directional, LightType::Spot,
                                LightType::Sphere, LightType::Rectangle};

void expectNear(const glm::vec3& a, const glm::vec3& b, float tolerance = 1e-5f) {
    EXPECT_LT(glm::distance(a, b), tolerance)
        << a.x << ' ' << a.y << ' ' << a.z << " != " << b.x << ' ' << b.y << ' ' << b.z;
}

TEST(Lights, SoloSilencesTheOthersAsOnAMixingDesk) {
    Document document;
    document.lights.resize(3);
    for (const Light& light : document.lights)
        EXPECT_TRUE(isActive(document, light));
    document.lights[1].solo = true;
    EXPECT_FALSE(isActive(document, document.lights[0]));
    EXPECT_TRUE(isActive(document, document.lights[1]));
    document.lights[1].enabled = false; // muted and solo: silent, and so are the others
    for (const Light& light : document.lights)
        EXPECT_FALSE(isActive(document, light));
}

TEST(Lights, IntensityHasTheUnitOfItsType) {
    EXPECT_EQ(intensityUnit(LightType::Point), "cd");
    EXPECT_EQ(intensityUnit(LightType::Spot), "cd");
    EXPECT_EQ(intensityUnit(LightType::Directional), "lx");
    EXPECT_EQ(intensityUnit(LightType::Sphere), "nit");
    EXPECT_EQ(intensityUnit(LightType::Rectangle), "nit");
    Document document;
    document.lights.push_back(lightOf(LightType::Sphere));
    document.lights[0].id = 4;
    EXPECT_EQ(findParameter("light.intensity")->unitFor(document, 4), "nit");
    EXPECT_EQ(findParameter("light.radius")->unitFor(document, 4), "m");
}

TEST(Lights, DirectionsGoThereAndBack) {
    for (const glm::vec3 d : {glm::vec3(1, 2, 3), {-1, 0.5f, -2}, {0, -3, 0.1f}, {0, 0, -1}}) {
        Light light;
        setDirectionToLight(light, 3.0f * d);
        expectNear(light.directionToLight(), glm::normalize(d));
    }
    Light light;
    light.azimuthDeg = 77.0f;
    setDirectionToLight(light, {0, 5, 0});
    EXPECT_EQ(light.azimuthDeg, 77.0f);
    EXPECT_NEAR(light.elevationDeg, 90.0f, 1e-3f);
    setDirectionToLight(light, glm::vec3(0));
    EXPECT_NEAR(light.elevationDeg, 90.0f, 1e-3f);
}

TEST(Lights, RectangleAxesMakeARightHandedFrameThatRollsAboutTheLight) {
    Light light = lightOf(LightType::Rectangle);
    light.azimuthDeg = light.elevationDeg = light.rollDeg = 0.0f; // emits along -Z
    RectangleAxes axes = rectangleAxes(light);
    expectNear(axes.x, {1, 0, 0});
    expectNear(axes.y, {0, 1, 0});
    light.rollDeg = 90.0f; // about +Z: x goes to y
    axes = rectangleAxes(light);
    expectNear(axes.x, {0, 1, 0});
    expectNear(axes.y, {-1, 0, 0});
    for (const float elevation : {-90.0f, -20.0f, 65.0f, 90.0f}) {
        light.azimuthDeg = 130.0f;
        light.elevationDeg = elevation;
        light.rollDeg = 33.0f;
        axes = rectangleAxes(light);
        expectNear(glm::cross(axes.x, axes.y), light.directionToLight());
        EXPECT_NEAR(glm::length(axes.x), 1.0f, 1e-6f);
    }
}

TEST(Lights, IlluminanceFollowsTheUnits) {
    Light light = lightOf(LightType::Directional);
    light.intensity = 7.0f;
    EXPECT_FLOAT_EQ(illuminanceAt(light, {9, 9, 9}), 7.0f);

    light = lightOf(LightType::Point);
    light.position = {0, 0, 2};
    light.intensity = 8.0f;
    EXPECT_FLOAT_EQ(illuminanceAt(light, {0, 0, 0}), 2.0f); // I / d²
    light.range = 4.0f;                                     // 1 - (2 / 4)^4 = 15 / 16
    EXPECT_FLOAT_EQ(illuminanceAt(light, {0, 0, 0}), 2.0f * 15.0f / 16.0f);
    light.range = 2.0f;
    EXPECT_EQ(illuminanceAt(light, {0, 0, 0}), 0.0f);

    light = lightOf(LightType::Spot); // emits along -Z
    light.position = {0, 0, 2};
    light.azimuthDeg = light.elevationDeg = 0.0f;
    light.intensity = 8.0f;
    light.innerConeDeg = 20.0f;
    light.outerConeDeg = 40.0f;
    EXPECT_FLOAT_EQ(illuminanceAt(light, {0, 0, 0}), 2.0f);
    const float d30 = 2.0f / std::cos(glm::radians(30.0f));
    // ((cos 30° - cos 40°) / (cos 20° - cos 40°))²
    EXPECT_NEAR(illuminanceAt(light, {2.0f * std::tan(glm::radians(30.0f)), 0, 0}),
                8.0f / (d30 * d30) * 0.331508f, 1e-4f);
    EXPECT_EQ(illuminanceAt(light, {2.0f, 0, 0}), 0.0f); // 45°
    EXPECT_EQ(illuminanceAt(light, {0, 0, 4}), 0.0f);    // behind

    light = lightOf(LightType::Sphere);
    light.position = {0, 0, 2};
    light.radius = 0.5f;
    light.intensity = 10.0f;
    EXPECT_NEAR(illuminanceAt(light, {0, 0, 0}), glm::pi<float>() * 10.0f / 16.0f, 1e-5f);
    EXPECT_NEAR(illuminanceAt(light, {0, 0, 1.9f}), glm::pi<float>() * 10.0f, 1e-4f); // inside

    // Howell B-3: an element below the corner of a 1 × 1 square at distance 2 sees 0.0598641 of it;
    // below the centre of a 2 × 2 square four times that.
    light = lightOf(LightType::Rectangle);
    light.azimuthDeg = light.elevationDeg = 0.0f;
    light.position = {0, 0, 2};
    light.width = light.height = 2.0f;
    light.intensity = 1.0f;
    EXPECT_NEAR(illuminanceAt(light, {0, 0, 0}), glm::pi<float>() * 4.0f * 0.0598641176f, 1e-5f);
    EXPECT_EQ(illuminanceAt(light, {0, 0, 4}), 0.0f); // behind
}

TEST(Lights, SwitchingTheTypeKeepsTheLightAtTheCentre) {
    for (const LightType from : kTypes)
        for (const LightType to : kTypes) {
            Light light = lightOf(from);
            light.position = scene().center() + glm::vec3(3, 2, -1);
            light.azimuthDeg = glm::degrees(std::atan2(3.0f, -1.0f)); // towards the centre
            light.elevationDeg = glm::degrees(std::asin(2.0f / std::sqrt(14.0f)));
            light.intensity = 5.0f;
            light.color = {1.0f, 0.5f, 0.2f};
            const Light other = convertedLight(light, to, scene());
            SCOPED_TRACE(std::to_string(static_cast<int>(from)) + " to " +
                         std::to_string(static_cast<int>(to)));
            EXPECT_EQ(other.type, to);
            EXPECT_EQ(other.color, light.color);
            const float before = illuminanceAt(light, scene().center());
            EXPECT_GT(before, 0.0f);
            EXPECT_NEAR(illuminanceAt(other, scene().center()), before, 1e-4f * before);
            // From the same side.
            const glm::vec3 side = hasPosition(to)
                                       ? glm::normalize(other.position - scene().center())
                                       : other.directionToLight();
            expectNear(side, glm::normalize(glm::vec3(3, 2, -1)), 1e-4f);
            if (hasPosition(from) && hasPosition(to)) {
                EXPECT_EQ(other.position, light.position);
            }
        }
}

TEST(Lights, SwitchingTheTypeOfALightThatMissesTheCentreStaysInRange) {
    Light light = lightOf(LightType::Point);
    light.position = scene().center(); // no direction, and an endless illuminance
    for (const LightType to : kTypes) {
        const Light other = convertedLight(light, to, scene());
        EXPECT_TRUE(std::isfinite(other.intensity));
        EXPECT_TRUE(std::isfinite(other.azimuthDeg + other.elevationDeg));
    }
    light = lightOf(LightType::Spot); // looks away
    light.position = {1, 9, 3};
    light.elevationDeg = -90.0f;
    EXPECT_EQ(illuminanceAt(light, scene().center()), 0.0f);
    const Light sun = convertedLight(light, LightType::Directional, scene());
    EXPECT_NEAR(sun.intensity, defaultLight(LightType::Directional, scene()).intensity, 1e-5f);
    EXPECT_NEAR(sun.elevationDeg, 90.0f, 1e-3f); // where it stands, not where it looks
}

TEST(Lights, NewLightsOfAnyTypeAreAlikeAtTheCentre) {
    for (const LightType type : kTypes) {
        const Light light = defaultLight(type, scene());
        EXPECT_NEAR(illuminanceAt(light, scene().center()), 3.0f, 0.15f);
        EXPECT_GT(light.position.y, 3.0f);
        EXPECT_TRUE(std::isfinite(defaultLight(type, Bounds{}).intensity)); // an empty scene
    }
}

TEST(Lights, TurningKeepsDistanceAndAim) {
    Light light = lightOf(LightType::Spot);
    light.position = scene().center() + glm::vec3(0, 0, 4);
    light.azimuthDeg = 10.0f; // a little off the centre
    light.elevationDeg = 5.0f;
    const Light turned = turnedLight(light, scene().center(), 90.0f, 30.0f);
    const float c = std::cos(glm::radians(30.0f));
    expectNear(turned.position, scene().center() + 4.0f * glm::vec3(c, 0.5f, 0), 1e-4f);
    EXPECT_NEAR(turned.azimuthDeg, 100.0f, 1e-3f);
    EXPECT_NEAR(turned.elevationDeg, 35.0f, 1e-3f);

    light = lightOf(LightType::Directional);
    light.azimuthDeg = 170.0f;
    light.elevationDeg = 80.0f;
    const Light sun = turnedLight(light, scene().center(), 20.0f, 30.0f);
    EXPECT_NEAR(sun.azimuthDeg, -170.0f, 1e-3f);
    EXPECT_EQ(sun.elevationDeg, 90.0f);
    EXPECT_EQ(sun.position, light.position);
}

TEST(Lights, ConesThatCrossAreCutAtTheOuterOne) {
    Light light = lightOf(LightType::Spot);
    light.innerConeDeg = 50.0f;
    light.outerConeDeg = 30.0f;
    const auto [scale, offset] = coneScaleOffset(light);
    EXPECT_FLOAT_EQ(scale, 1000.0f); // the floor of KHR_lights_punctual
    EXPECT_NEAR(offset, -std::cos(glm::radians(30.0f)) * 1000.0f, 1e-3f);
}

} // namespace
} // namespace patina
