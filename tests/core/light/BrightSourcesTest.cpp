// The sun and lamps of an environment become lights: where they are, how bright they are, and that
// nothing of the light is lost or made.
#include "core/light/BrightSources.h"
#include "core/light/ClearSky.h"
#include "core/light/Environment.h"
#include "core/light/EnvironmentResample.h"
#include "core/light/GeneratedEnvironment.h"
#include "core/light/LatLongGrid.h"
#include "core/light/Light.h"
#include "core/math/Shading.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/trigonometric.hpp>
#include <gmock/gmock.h>
#include <numbers>

namespace patina {
namespace {

double angleDeg(const glm::dvec3& a, const glm::dvec3& b) {
    return glm::degrees(std::acos(std::clamp(glm::dot(a, b), -1.0, 1.0)));
}

glm::dvec3 at(const Image& image, int x, int y) {
    return {image.sample(x, y, 0), image.sample(x, y, 1), image.sample(x, y, 2)};
}

// ∫ L dω, and ∫ L max(0, n·ω) dω.
glm::dvec3 fluxOf(const Image& image) {
    const LatLongGrid grid(image.height());
    glm::dvec3 sum(0.0);
    for (int y = 0; y < grid.height(); ++y)
        for (int x = 0; x < grid.width(); ++x)
            sum += at(image, x, y) * grid.solidAngle(y);
    return sum;
}
glm::dvec3 irradianceOf(const Image& image, const glm::dvec3& normal) {
    const LatLongGrid grid(image.height());
    glm::dvec3 sum(0.0);
    for (int y = 0; y < grid.height(); ++y)
        for (int x = 0; x < grid.width(); ++x)
            sum += at(image, x, y) *
                   (std::max(0.0, glm::dot(normal, grid.direction(x, y))) * grid.solidAngle(y));
    return sum;
}

// A picture with discs: centre, radius in degrees, radiance.
struct BrightDisc {
    glm::dvec3 centre;
    double radiusDeg;
    double radiance;
};
Image discs(const std::vector<BrightDisc>& all, double around, int height = 256) {
    const LatLongGrid grid(height);
    Image image(2 * height, height, 3, PixelType::F32, ColorEncoding::Linear);
    const auto samples = image.f32();
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < 2 * height; ++x) {
            double value = around;
            for (const BrightDisc& disc : all)
                if (angleDeg(grid.direction(x, y), disc.centre) <= disc.radiusDeg)
                    value = disc.radiance;
            for (int c = 0; c < 3; ++c)
                samples[3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(2 * height) +
                             static_cast<std::size_t>(x)) +
                        static_cast<std::size_t>(c)] = static_cast<float>(value);
        }
    return image;
}

// The sky's model says what its sun is: the picture with it less the picture without.
TEST(BrightSources, TheSunOfABuiltInSkyIsFoundWhereItIs) {
    for (const float elevation : {8.0f, 35.0f, 70.0f})
        for (const float azimuth : {-179.0f, 40.0f, 178.5f})
            for (const float diameter : {0.53f, 3.0f}) {
                Sky sky;
                sky.sunElevationDeg = elevation;
                sky.sunAzimuthDeg = azimuth;
                sky.sunDiameterDeg = diameter;
                sky.groundAlbedo = 0.0f; // which reflects the sun
                const Image whole = clearSkyImage(sky, 512);
                sky.sunScale = 0.0f;
                const Image without = clearSkyImage(sky, 512);
                const glm::dvec3 sun = fluxOf(whole) - fluxOf(without);
                const BrightSources found = extractBrightSources(whole, 1);
                ASSERT_EQ(found.sources.size(), 1u);
                const BrightSource& source = found.sources.front();
                SCOPED_TRACE(elevation);
                EXPECT_LT(angleDeg(source.toSource, directionFromAngles(azimuth, elevation)), 1.0);
                for (int c = 0; c < 3; ++c)
                    EXPECT_NEAR(source.irradiance[c] / sun[c], 1.0, 0.02) << c;
                EXPECT_TRUE(source.isClear);
                // A texel is .35° wide: smaller suns are as wide as their texels.
                EXPECT_NEAR(source.diameterDeg, std::max(diameter, 0.5f), 0.3);
                // And the sky is what it is without the sun.
                double worst = 0.0;
                for (int y = 0; y < whole.height() / 2; ++y)
                    for (int x = 0; x < whole.width(); ++x)
                        worst = std::max(worst, std::abs(found.picture.sample(x, y, 1) -
                                                         without.sample(x, y, 1)) /
                                                    (0.05 + without.sample(x, y, 1)));
                EXPECT_LT(worst, 0.5) << "around the sun the sky is steep";
            }
}

// What the lights give is what the picture loses, and a sphere looks the same.
TEST(BrightSources, NoLightIsLostOrMade) {
    const double around = 0.3;
    const Image image = discs({{glm::normalize(glm::dvec3(0.3, 0.8, 0.4)), 2.0, 400.0},
                               {glm::normalize(glm::dvec3(-0.8, 0.1, -0.2)), 4.0, 20.0},
                               {glm::dvec3(0.0, 1.0, 0.0), 1.0, 90.0}},
                              around);
    const BrightSources found = extractBrightSources(image, 3);
    ASSERT_EQ(found.sources.size(), 3u);
    const glm::dvec3 before = fluxOf(image), after = fluxOf(found.picture);
    double share = 0.0;
    for (const BrightSource& source : found.sources)
        share += source.shareOfLight;
    EXPECT_NEAR(share, (before.x - after.x) / before.x, 1e-6);
    EXPECT_NEAR(after.x, around * 4.0 * std::numbers::pi, 1e-3) << "all of them are gone";
    double squares = 0.0, mean = 0.0;
    int count = 0;
    for (const double y : {-0.9, -0.5, 0.0, 0.5, 0.9})
        for (int i = 0; i < 12; ++i, ++count) {
            const double turn = 2.0 * std::numbers::pi * i / 12, r = std::sqrt(1.0 - y * y);
            const glm::dvec3 normal(r * std::sin(turn), y, r * std::cos(turn));
            double lit = irradianceOf(found.picture, normal).x;
            for (const BrightSource& source : found.sources)
                lit += source.irradiance.x * std::max(0.0, glm::dot(normal, source.toSource));
            const double whole = irradianceOf(image, normal).x;
            squares += (lit - whole) * (lit - whole);
            mean += whole;
        }
    EXPECT_LT(std::sqrt(squares / count) / (mean / count), 0.01);
}

TEST(BrightSources, TheOneWithTheMostLightOfItsPlaceComesFirst) {
    const glm::dvec3 large = glm::normalize(glm::dvec3(0.2, 0.3, 1.0));
    const glm::dvec3 small = glm::normalize(glm::dvec3(-1.0, 0.4, 0.1));
    Image image = discs({{large, 3.0, 50.0}, {small, 1.5, 30.0}}, 0.1);
    image.f32()[3 * 70000] = 60.0f; // a texel of noise
    const BrightSources found = extractBrightSources(image, 2);
    ASSERT_EQ(found.sources.size(), 2u);
    EXPECT_LT(angleDeg(found.sources[0].toSource, large), 0.5);
    EXPECT_LT(angleDeg(found.sources[1].toSource, small), 0.5);
    EXPECT_NEAR(found.sources[0].diameterDeg, 6.0, 0.5);
    EXPECT_NEAR(found.sources[1].diameterDeg, 3.0, 0.5);
    // One more of one that is taken out already gives the same others.
    const BrightSources one = extractBrightSources(image, 1);
    EXPECT_EQ(one.sources[0].toSource, found.sources[0].toSource);
    EXPECT_EQ(extractBrightSources(one.picture, 1).sources[0].irradiance,
              found.sources[1].irradiance);
}

TEST(BrightSources, AcrossTheSeamAndOverThePolesASourceIsOne) {
    for (const glm::dvec3 centre :
         {glm::dvec3(0.0, 0.0, 1.0), glm::dvec3(0.0, 1.0, 0.0), glm::dvec3(0.0, -1.0, 0.0),
          glm::normalize(glm::dvec3(0.01, 1.0, 0.01))}) {
        const Image image = discs({{centre, 4.0, 100.0}}, 1.0);
        const BrightSources found = extractBrightSources(image, 1);
        ASSERT_EQ(found.sources.size(), 1u);
        EXPECT_LT(angleDeg(found.sources[0].toSource, centre), 0.5);
        // Of a surface that faces it, less the π of what surrounds it.
        const double expected = irradianceOf(image, centre).x - std::numbers::pi;
        EXPECT_NEAR(found.sources[0].irradiance.x / expected, 1.0, 0.01);
    }
}

TEST(BrightSources, WhereNothingStandsOutThatIsSaid) {
    EXPECT_TRUE(extractBrightSources(discs({}, 0.0), 2).sources.empty()) << "black";
    const Image even = discs({}, 1.0);
    const BrightSources none = extractBrightSources(even, 1);
    EXPECT_TRUE(none.sources.empty() || !none.sources.front().isClear);
    EXPECT_NEAR(fluxOf(none.picture).x, fluxOf(even).x, 1e-2);
    const BrightSources faint =
        extractBrightSources(discs({{glm::dvec3(0.0, 0.0, -1.0), 5.0, 2.0}}, 1.0), 1);
    ASSERT_EQ(faint.sources.size(), 1u);
    EXPECT_FALSE(faint.sources.front().isClear);
    EXPECT_EQ(extractBrightSources(even, 0).picture, even);
}

TEST(BrightSources, TheLightGoesWithTheEnvironment) {
    BrightSource source;
    source.toSource = glm::normalize(glm::dvec3(0.3, 0.5, -0.7));
    source.irradiance = {8.0, 4.0, 2.0};
    source.diameterDeg = 1.5;
    Environment environment;
    environment.rotationDeg = 100.0f;
    environment.exposureEv = 1.0f;
    environment.tint = {1.0f, 0.5f, 1.0f};
    const Light light = lightOf(source, environment);
    // Counter-clockwise seen from above: about +Y.
    const glm::dvec3 rotated(glm::rotate(glm::dmat4(1.0), glm::radians(100.0), {0.0, 1.0, 0.0}) *
                             glm::dvec4(source.toSource, 0.0));
    EXPECT_LT(angleDeg(glm::dvec3(light.directionToLight()), rotated), 0.02);
    EXPECT_EQ(light.type, LightType::Directional);
    EXPECT_FLOAT_EQ(light.intensity, 16.0f);
    EXPECT_FLOAT_EQ(light.color.r, 1.0f);
    EXPECT_FLOAT_EQ(light.color.g, 0.25f);
    EXPECT_FLOAT_EQ(light.color.b, 0.25f);
    EXPECT_FLOAT_EQ(light.shadowSoftness, 1.5f);
}

TEST(BrightSources, AnEnvironmentIsGeneratedWithoutThem) {
    Environment environment;
    environment.image = environment.fileImage =
        std::make_shared<const Image>(discs({{glm::dvec3(0.0, 0.0, -1.0), 3.0, 80.0}}, 0.5));
    EXPECT_FALSE(isGenerated(environmentRecipe(environment)));
    environment.removedSources = 1;
    EXPECT_TRUE(isGenerated(environmentRecipe(environment)));
    resolveEnvironment(environment);
    EXPECT_EQ(*environment.image, extractBrightSources(*environment.fileImage, 1).picture);
    EXPECT_NEAR(environment.image->sample(256, 128, 0), 0.5f, 1e-3f);
    const ImagePtr draft =
        generateEnvironment(environmentRecipe(environment), kDraftEnvironmentHeight);
    ASSERT_NE(draft, nullptr);
    EXPECT_LE(draft->height(), kDraftEnvironmentHeight);
    environment.removedSources = 0;
    resolveEnvironment(environment);
    EXPECT_EQ(environment.image, environment.fileImage);
}

} // namespace
} // namespace patina
