#include "core/light/ClearSky.h"
#include "core/job/Parallel.h"
#include "core/light/LatLongGrid.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <gtest/gtest.h>
#include <numbers>

using namespace patina;

namespace {

using std::numbers::pi;

Sky skyWith(float turbidity, float elevationDeg, float azimuthDeg = 180.0f) {
    Sky sky;
    sky.turbidity = turbidity;
    sky.sunElevationDeg = elevationDeg;
    sky.sunAzimuthDeg = azimuthDeg;
    return sky;
}

glm::dvec3 texel(const Image& image, int x, int y) {
    return glm::dvec3(image.linear(x, y));
}

// What the disc alone adds to the upper half: its flux, and the flux-weighted direction.
struct Disc {
    glm::dvec3 flux{0.0}, direction{0.0};
};
Disc discOf(Sky sky, int height) {
    const Image with = clearSkyImage(sky, height);
    sky.sunScale = 0.0f;
    const Image without = clearSkyImage(sky, height);
    const LatLongGrid grid(height);
    Disc disc;
    for (int y = 0; y < height / 2; ++y)
        for (int x = 0; x < grid.width(); ++x) {
            const glm::dvec3 flux = (texel(with, x, y) - texel(without, x, y)) * grid.solidAngle(y);
            disc.flux += flux;
            disc.direction += flux.g * grid.direction(x, y);
        }
    disc.direction = glm::normalize(disc.direction);
    return disc;
}

glm::dvec3 irradianceUp(const Image& image) {
    const LatLongGrid grid(image.height());
    glm::dvec3 sum(0.0);
    for (int y = 0; y < image.height() / 2; ++y)
        for (int x = 0; x < image.width(); ++x)
            sum += texel(image, x, y) * grid.direction(x, y).y * grid.solidAngle(y);
    return sum;
}

void expectNear(const glm::dvec3& a, const glm::dvec3& b, double relative, const char* what) {
    for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(a[c], b[c], relative * std::abs(b[c])) << what << ", channel " << c;
}

} // namespace

// Equations of Preetham, Shirley, Smits 1999, appendix A.2, evaluated apart from this code:
// luminance / 20000 cd/m² at the zenith, as linear sRGB.
TEST(ClearSky, FollowsThePublishedFormula) {
    Sky sky = skyWith(3.0f, 35.0f);
    sky.sunScale = 0.0f;
    expectNear(texel(clearSkyImage(sky, 1024), 0, 0), {0.177776, 0.294928, 0.574286}, 5e-3, "T 3");
    sky = skyWith(5.0f, 60.0f);
    sky.sunScale = 0.0f;
    const Image hazy = clearSkyImage(sky, 1024);
    expectNear(texel(hazy, 0, 0), {0.653186, 0.940028, 1.566065}, 5e-3, "T 5");
    // 45° above the horizon and a quarter turn from the sun, u = 0.25; there the colour of haze
    // has faded to 0.2 %.
    expectNear(texel(hazy, 512, 256), {0.428198, 0.668588, 1.067096}, 5e-3, "aside");
}

// Planck's law at 5778 K through Rayleigh's, Ångström's and ozone's attenuation (appendix A.1),
// summed apart from this code in steps of 1 nm from 360 to 830 nm; in units of 20000 cd/m².
TEST(ClearSky, SunIsAttenuatedByTheAir) {
    expectNear(sunRadiance(skyWith(3.0f, 35.0f)), {65269.6, 50572.4, 34796.1}, 2e-3, "T 3, 35°");
    expectNear(sunRadiance(skyWith(2.0f, 90.0f)), {85887.9, 71764.8, 58072.8}, 2e-3, "T 2, 90°");
    expectNear(sunRadiance(skyWith(6.0f, 10.0f)), {5925.32, 2468.74, 420.73}, 4e-3, "T 6, 10°");
}

TEST(ClearSky, SunsFluxIsExactHoweverCoarseThePicture) {
    for (const int height : {32, 128, 512})
        for (const float elevation : {90.0f, 89.7f, 41.0f, 21.0f})
            for (const float azimuth : {0.0f, 0.4f, 131.0f})
                for (const float diameter : {0.1f, 0.53f, 4.0f, 40.0f}) {
                    Sky sky = skyWith(3.0f, elevation, azimuth);
                    sky.sunDiameterDeg = diameter;
                    const Disc disc = discOf(sky, height);
                    const double radius = glm::radians(0.5 * diameter);
                    const glm::dvec3 exact =
                        sunRadiance(sky) * (2.0 * pi * (1.0 - std::cos(radius)));
                    expectNear(disc.flux, exact, 2e-3, "flux");
                    // Its centre of light stays where it is, also across the seam and at the pole.
                    const double off =
                        glm::length(disc.direction - directionFromAngles(azimuth, elevation));
                    EXPECT_LT(off, 0.75 * pi / height)
                        << height << " " << elevation << " " << azimuth << " " << diameter;
                }
}

TEST(ClearSky, SunHasTheShapeOfADisc) {
    Sky sky = skyWith(3.0f, 40.0f, 180.0f);
    sky.sunDiameterDeg = 20.0f;
    const Image with = clearSkyImage(sky, 256);
    const glm::dvec3 sun = directionFromAngles(180.0, 40.0), radiance = sunRadiance(sky);
    sky.sunScale = 0.0f;
    const Image without = clearSkyImage(sky, 256);
    const LatLongGrid grid(256);
    const double diagonal = 0.75 * grid.texelAngle();
    int partial = 0;
    for (int y = 0; y < 128; ++y)
        for (int x = 0; x < 512; ++x) {
            const double part = (texel(with, x, y) - texel(without, x, y)).g / radiance.g;
            const double angle = std::acos(std::min(1.0, glm::dot(grid.direction(x, y), sun)));
            if (angle < glm::radians(10.0) - diagonal)
                ASSERT_NEAR(part, 1.0, 2e-3) << x << " " << y;
            else if (angle > glm::radians(10.0) + diagonal)
                ASSERT_NEAR(part, 0.0, 1e-6) << x << " " << y;
            else
                partial += part > 0.1 && part < 0.9;
        }
    EXPECT_GT(partial, 40); // its edge is anti-aliased
}

TEST(ClearSky, OfASunOnTheHorizonTheUpperHalfShines) {
    Sky sky = skyWith(2.0f, 0.0f);
    sky.sunDiameterDeg = 4.0f;
    expectNear(discOf(sky, 256).flux, 0.5 * sunSolidAngle(sky) * sunRadiance(sky), 5e-3, "half");
}

TEST(ClearSky, ALargerSunIsSofterAndNotBrighter) {
    Sky sky = skyWith(3.0f, 35.0f);
    const glm::dvec3 flux = sunRadiance(sky) * sunSolidAngle(sky);
    sky.sunDiameterDeg = 12.0f;
    expectNear(sunRadiance(sky) * sunSolidAngle(sky), flux, 1e-12, "flux");
    sky.sunScale = 3.0f;
    expectNear(sunRadiance(sky) * sunSolidAngle(sky), 3.0 * flux, 1e-6, "scaled");
}

TEST(ClearSky, LowAndHazySunsAreRedderAndWeaker) {
    glm::dvec3 last(1e9);
    double lastRed = 0.0;
    for (const float elevation : {90.0f, 50.0f, 25.0f, 10.0f, 3.0f}) {
        const glm::dvec3 sun = sunRadiance(skyWith(3.0f, elevation));
        EXPECT_LT(sun.g, last.g);
        EXPECT_GT(sun.r / sun.g, lastRed);
        EXPECT_GT(sunRadiance(skyWith(2.0f, elevation)).g, sun.g);
        lastRed = sun.r / sun.g;
        last = sun;
    }
}

TEST(ClearSky, IsSymmetricAboutTheSunAndTurnsWithIt) {
    const Image south = clearSkyImage(skyWith(4.0f, 30.0f, 180.0f), 64); // u = 0.5
    const Image turned = clearSkyImage(skyWith(4.0f, 30.0f, 90.0f), 64); // u = 0.75
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 128; ++x) {
            expectNear(texel(south, x, y), texel(south, 127 - x, y), 1e-4, "mirrored");
            expectNear(texel(turned, (x + 32) % 128, y), texel(south, x, y), 1e-4, "turned");
        }
}

TEST(ClearSky, GroundReflectsWhatFallsOnIt) {
    Sky sky = skyWith(3.0f, 50.0f);
    sky.groundAlbedo = 0.4f;
    const Image image = clearSkyImage(sky, 256);
    expectNear(texel(image, 9, 255), 0.4 / pi * irradianceUp(image), 1e-3, "below");
    sky.groundAlbedo = 0.0f;
    EXPECT_LT(texel(clearSkyImage(sky, 256), 9, 255).g, 1e-7);
}

// E / pi ≈ 1 for the default: as bright as builtin:clear-sky, and a draft lights like the final.
TEST(ClearSky, LightsLikeTheBuiltInSkyAtEverySize) {
    const glm::dvec3 draft = irradianceUp(clearSkyImage({}, 64));
    expectNear(draft, irradianceUp(clearSkyImage({}, 512)), 3e-3, "draft");
    EXPECT_NEAR(draft.g / pi, 1.04, 0.05);
}

TEST(ClearSky, HasNoBadTexelAnywhereInItsRange) {
    for (const float turbidity : {2.0f, 3.0f, 6.0f, 10.0f})
        for (const float elevation : {0.0f, 0.01f, 7.0f, 89.9f, 90.0f})
            for (const float diameter : {0.1f, 90.0f}) {
                Sky sky = skyWith(turbidity, elevation, -180.0f);
                sky.sunDiameterDeg = diameter;
                const Image image = clearSkyImage(sky, 32);
                for (const float value : std::as_const(image).f32())
                    ASSERT_TRUE(std::isfinite(value) && value >= 0.0f)
                        << turbidity << " " << elevation << " " << diameter;
            }
}

TEST(ClearSky, IsTheSameOnAnyNumberOfThreads) {
    const Image many = clearSkyImage(Sky{}, 128);
    const ThreadLimit one(1);
    EXPECT_EQ(many, clearSkyImage(Sky{}, 128));
}
