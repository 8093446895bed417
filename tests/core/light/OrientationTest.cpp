// How environments stand in the world: rotation, tilt and roll, and what is derived from them.
#include "core/light/Orientation.h"
#include "core/light/BrightSources.h"
#include "core/light/Environment.h"
#include "core/light/EnvironmentLookup.h"
#include "core/light/EnvironmentMapping.h"
#include "core/light/EnvironmentResample.h"
#include "core/light/Light.h"
#include "core/light/OrientedEnvironment.h"
#include "core/math/Shading.h"
#include "tests/core/light/LatLongPicture.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <gtest/gtest.h>
#include <vector>

using namespace patina;
using namespace patina::test;

namespace {

const std::vector<glm::vec3> kDirections{
    {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -1}, {0.48f, -0.6f, 0.64f}, {-0.6f, 0.64f, -0.48f}};

glm::vec3 smooth(const glm::vec3& d) {
    return glm::vec3(1.0f) + glm::vec3(0.7f * d.x, 0.5f * d.y, 0.6f * d.z * d.x);
}

void expectNear(const glm::vec3& a, const glm::vec3& b, float tolerance, const char* what) {
    EXPECT_LT(glm::distance(a, b), tolerance) << what;
}

} // namespace

TEST(Orientation, OneAxisAfterTheOther) {
    const glm::vec3 x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
    expectNear(Orientation(90.0f).toWorld(-z), -x, 1e-6f, "counter-clockwise from above");
    expectNear(Orientation(0, 90).toWorld(y), z, 1e-6f, "what is above comes to the front");
    expectNear(Orientation(0, 0, 90).toWorld(x), y, 1e-6f, "counter-clockwise from the front");
    // The roll first, then the tilt, the rotation last: it always goes round the horizon.
    expectNear(Orientation(90, 90, 90).toWorld(x), x, 1e-6f, "x to y, to z, to x");
    for (const float rotation : {0.0f, 40.0f, -170.0f})
        EXPECT_NEAR(Orientation(rotation, 30, 20).toWorld(y).y, Orientation(0, 30, 20).toWorld(y).y,
                    1e-6f)
            << rotation;
}

TEST(Orientation, LevelIsARotationAboutYToTheBit) {
    for (const float angle : {0.0f, 25.0f, -130.3f})
        for (const glm::vec3& d : kDirections) {
            const Orientation level(angle);
            EXPECT_EQ(level.toWorld(d), shading::rotateY(d, glm::radians(angle)));
            EXPECT_EQ(level.toPicture(d), shading::rotateY(d, -glm::radians(angle)));
            // The general form says the same.
            expectNear(glm::mat3(level.matrix()) * d, level.toWorld(d), 1e-6f, "matrix");
        }
}

TEST(Orientation, LooksUpWhereItPutsThings) {
    for (const Orientation& stands : {Orientation(20, 35, -50), Orientation(-75, -90, 120)})
        for (const glm::vec3& d : kDirections)
            expectNear(stands.toPicture(stands.toWorld(d)), d, 1e-6f, "there and back");
}

// Radiance, irradiance, bands and prefiltered light of a tilted environment are those of the level
// one, where the orientation says; and those of the picture that was resampled into it.
TEST(Orientation, AllLightGoesWithIt) {
    const ImagePtr picture = latLong(128, 64, smooth);
    const Orientation stands(35, 50, -20);
    const auto lookupOf = [](const ImagePtr& image) {
        EnvironmentLookup light;
        IblSettings settings = IblSettings::quick();
        settings.cubeSize = 32;
        light.analysis = analyseEnvironment(image, {});
        light.maps = std::make_shared<const IblMaps>(
            computeIbl(*light.analysis->environment, settings, {}).value());
        return light;
    };
    const EnvironmentLookup level = lookupOf(picture);
    EnvironmentLookup tilted = level;
    tilted.orientation = stands;
    const EnvironmentLookup resampled =
        lookupOf(std::make_shared<const Image>(orientEnvironment(*picture, stands, 0.0f)));
    for (const glm::vec3& d : kDirections) {
        const glm::vec3 p = stands.toPicture(d);
        expectNear(*tilted.radiance(d), smooth(p), 0.02f, "radiance");
        expectNear(*tilted.irradiance(d), *level.irradiance(p), 1e-6f, "irradiance");
        expectNear(*tilted.bandSum(4, d), *level.bandSum(4, p), 1e-6f, "bands");
        expectNear(*resampled.radiance(d), *tilted.radiance(d), 0.02f, "resampled radiance");
        expectNear(*resampled.irradiance(d), *tilted.irradiance(d), 0.02f, "resampled irradiance");
        expectNear(*resampled.prefiltered(0.5f, d), *tilted.prefiltered(0.5f, d), 0.02f,
                   "resampled reflections");
    }
    // Coefficients that are rotated are those of the resampled picture.
    std::vector<glm::vec3> rotated(9);
    stands.harmonics(3).apply(std::span<const glm::vec3>(level.maps->irradianceSh),
                              std::span<glm::vec3>(rotated));
    for (std::size_t i = 0; i < rotated.size(); ++i)
        expectNear(rotated[i], resampled.maps->irradianceSh[i], 0.02f, "coefficients");
}

TEST(Orientation, ASunThatIsExtractedShinesFromWhereItIsSeen) {
    const glm::vec3 toSun = glm::normalize(glm::vec3(0.4f, 0.5f, -0.7f));
    const ImagePtr picture = latLong(256, 128, [&](const glm::vec3& d) {
        return glm::vec3(glm::dot(d, toSun) > 0.999f ? 5000.0f : 0.5f);
    });
    const BrightSources found = extractBrightSources(*picture, 1);
    ASSERT_EQ(found.sources.size(), 1u);
    for (const Orientation& stands : {Orientation(60), Orientation(60, 25, -40)}) {
        Environment environment;
        environment.rotationDeg = stands.rotationDeg;
        environment.tiltDeg = stands.tiltDeg;
        environment.rollDeg = stands.rollDeg;
        EXPECT_EQ(orientationOf(environment), stands);
        const Light light = lightOf(found.sources[0], environment);
        expectNear(light.directionToLight(), stands.toWorld(toSun), 0.01f, "sun");
    }
}

TEST(Orientation, ResamplingKeepsTheFluxOfASmallSun) {
    Image image(128, 64, 3, PixelType::F32, ColorEncoding::Linear);
    for (float& value : image.f32())
        value = 0.25f;
    for (std::size_t c = 0; c < 3; ++c)
        image.f32()[(20 * 128 + 40) * 3 + c] = 4e4f;
    const EnvironmentMapping mapping =
        EnvironmentMapping::create(EnvironmentLayout::LatLong, {128, 64}).value();
    const Image tilted = orientEnvironment(image, {10, 70, 30}, 1.0f);
    const glm::dvec3 before = environmentFlux(image, mapping),
                     after = environmentFlux(tilted, mapping);
    EXPECT_NEAR(after.x, 2.0 * before.x, 2e-3 * before.x);
}
