// What is measured of environments, against pictures of which it is known.
#include "core/catalog/EnvironmentMeasures.h"

#include "core/catalog/EnvironmentTags.h"
#include "core/catalog/EnvironmentThumbnail.h"
#include "core/light/Blackbody.h"
#include "core/light/LightSides.h"
#include "core/math/Shading.h"
#include "tests/core/catalog/Pictures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <random>

using namespace patina;
using namespace patina::test;
using testing::Contains;
using testing::ElementsAre;
using testing::Not;

namespace {

EnvironmentMeasures measuresOf(const Image& image) {
    return measureLight(image).measures;
}

// The angle between a direction and one given by azimuth and elevation.
double degreesBetween(const glm::dvec3& a, double azimuthDeg, double elevationDeg) {
    return glm::degrees(
        std::acos(std::min(1.0, glm::dot(a, directionFromAngles(azimuthDeg, elevationDeg)))));
}

} // namespace

TEST(EnvironmentMeasures, UniformLight) {
    const EnvironmentMeasures m = measuresOf(uniform(glm::dvec3(0.7)));
    EXPECT_NEAR(m.meanLuminance, 0.7, 1e-5);
    EXPECT_NEAR(m.medianLuminance, 0.7, 0.7 * 0.01);
    EXPECT_EQ(m.rangeStops, 0.0);
    EXPECT_NEAR(m.keyToFill, 1.0, 0.005);
    EXPECT_NEAR(m.directionality, 0.0, 1e-3);
    EXPECT_FALSE(m.source) << m.source->share;
    EXPECT_EQ(m.clippedShare, 0.0);
    ASSERT_TRUE(m.temperature); // sRGB's white is D65
    EXPECT_NEAR(m.temperature->kelvin, 6504, 130);
    EXPECT_THAT(tagsOf(m), ElementsAre(EnvironmentTag::Soft, EnvironmentTag::Neutral));
}

// Files come in any shape: odd heights, no two to one, a row, a texel.
TEST(EnvironmentMeasures, OfPicturesOfAnyShape) {
    for (const auto& [width, height] : {std::pair(2, 1),
                                        {1, 1},
                                        {7, 1},
                                        {1, 9},
                                        {30, 15},
                                        {31, 15},
                                        {37, 100},
                                        {300, 101},
                                        {1030, 515},
                                        {1031, 517}}) {
        SCOPED_TRACE(std::to_string(width) + " x " + std::to_string(height));
        const Image even =
            latLong(width, height, [](const glm::dvec3&) { return glm::dvec3(0.7); });
        EXPECT_NEAR(measuresOf(even).meanLuminance, 0.7, 1e-5);
        const Image withoutSource = measureLight(even).withoutSource;
        EXPECT_EQ(withoutSource.width(), std::min(width, 512));
        EXPECT_FALSE(environmentThumbnail(even, withoutSource).empty());
        if (width < 30)
            continue; // too coarse to say from where light comes
        const glm::dvec3 towards = directionFromAngles(60.0, 30.0);
        const EnvironmentMeasures m = measuresOf(latLong(width, height, [&](const glm::dvec3& d) {
            return glm::dvec3(glm::dot(d, towards) > std::cos(0.15) ? 200.0 : 0.1);
        }));
        const double texelDeg = 180.0 / std::min({width / 2, height, 64});
        ASSERT_TRUE(m.source);
        EXPECT_LT(degreesBetween(towards, m.source->azimuthDeg, m.source->elevationDeg), texelDeg);
        EXPECT_LT(degreesBetween(towards, m.keyAzimuthDeg, m.keyElevationDeg), texelDeg);
        EXPECT_LT(degreesBetween(towards, m.dominantAzimuthDeg, m.dominantElevationDeg), texelDeg);
    }
}

TEST(EnvironmentMeasures, Black) {
    const EnvironmentMeasures m = measuresOf(uniform(glm::dvec3(0.0)));
    EXPECT_EQ(m.meanLuminance, 0.0);
    EXPECT_EQ(m.rangeStops, 0.0);
    EXPECT_EQ(m.keyToFill, 1.0);
    EXPECT_FALSE(m.source);
    EXPECT_FALSE(m.temperature);
    EXPECT_TRUE(tagsOf(m).empty());
}

TEST(EnvironmentMeasures, ADiscsShareDirectionAndSize) {
    for (const Disc& disc : {Disc{60, 40, 4, 1000, 1}, Disc{-150, -20, 10, 300, 2},
                             Disc{10, 75, 3, 5000, 0.5}, Disc{179, 5, 6, 800, 1}}) {
        const EnvironmentMeasures m = measuresOf(disc.picture());
        ASSERT_TRUE(m.source);
        const double added = (disc.radiance - disc.around) * disc.solidAngle();
        const double whole = 4.0 * std::numbers::pi * disc.around + added;
        EXPECT_NEAR(m.source->share, added / whole, 0.02 * added / whole);
        EXPECT_TRUE(m.source->isClear);
        EXPECT_LT(degreesBetween(disc.direction(), m.source->azimuthDeg, m.source->elevationDeg),
                  0.3);
        EXPECT_NEAR(m.source->diameterDeg, disc.diameterDeg, 0.1 * disc.diameterDeg);
        EXPECT_NEAR(m.meanLuminance, whole / (4.0 * std::numbers::pi), 0.02 * m.meanLuminance);
        // It is the side that gets most, and the direction that light comes from on the mean.
        EXPECT_LT(degreesBetween(disc.direction(), m.keyAzimuthDeg, m.keyElevationDeg), 1.5);
        EXPECT_LT(degreesBetween(disc.direction(), m.dominantAzimuthDeg, m.dominantElevationDeg),
                  0.5);
        EXPECT_EQ(testing::Value(tagsOf(m), Contains(EnvironmentTag::Sun)),
                  disc.elevationDeg > 0 && disc.diameterDeg <= kSunDiameterDeg);
    }
}

TEST(EnvironmentMeasures, KeyToFillOfADisc) {
    const Disc disc{60, 40, 8, 300, 1};
    const double more = disc.radiance - disc.around, even = std::numbers::pi * disc.around;
    const double key = even + more * disc.projected();
    const double fill = even + 0.25 * more * (disc.solidAngle() - disc.projected());
    EXPECT_NEAR(measuresOf(disc.picture()).keyToFill, key / fill, 0.03 * key / fill);
}

TEST(EnvironmentMeasures, KeyToFillOfAHalfSphere) {
    const Image sky = latLong(64, [](const glm::dvec3& d) { return glm::dvec3(d.y > 0.0); });
    const EnvironmentMeasures m = measuresOf(sky);
    EXPECT_NEAR(m.keyToFill, 4.0, 0.02); // π over (2π - π) / 4
    EXPECT_GT(m.keyElevationDeg, 89.0);
    EXPECT_EQ(m.rangeStops, kMostStops); // black below
}

TEST(EnvironmentMeasures, KeyToFillIsBounded) {
    const EnvironmentMeasures m = measuresOf(Disc{0, 30, 1, 1e6, 0}.picture());
    EXPECT_EQ(m.keyToFill, kMostKeyToFill);
    EXPECT_THAT(tagsOf(m), Contains(EnvironmentTag::HighContrast));
}

// The closed form against the mean of many normals, of a picture of many discs.
TEST(LightSides, IrradianceAwayIsTheMeanOverThatHemisphere) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    const auto direction = [&] {
        for (;;)
            if (const glm::dvec3 v(unit(random), unit(random), unit(random));
                glm::length(v) > 0.1 && glm::length(v) <= 1.0)
                return glm::normalize(v);
    };
    const glm::dvec3 a = direction(), b = direction();
    const LightSides sides(latLong(32, [&](const glm::dvec3& d) {
        return glm::dvec3(0.2 + 3.0 * (glm::dot(d, a) > 0.8) + 5.0 * (glm::dot(d, b) > 0.95));
    }));
    const LatLongGrid normals(90);
    for (const glm::dvec3& side : {a, b, glm::dvec3(0, 1, 0)}) {
        double sum = 0.0, area = 0.0;
        for (int y = 0; y < normals.height(); ++y)
            for (int x = 0; x < normals.width(); ++x)
                if (const glm::dvec3 normal = normals.direction(x, y); glm::dot(normal, side) < 0) {
                    sum += normals.solidAngle(y) * sides.irradiance(normal);
                    area += normals.solidAngle(y);
                }
        EXPECT_NEAR(sides.irradianceAway(side), sum / area, 0.005 * sum / area);
    }
}

TEST(EnvironmentMeasures, RangeIsThatOfLightAndArea) {
    const auto halves = [](double above, double below) {
        return measuresOf(latLong(64,
                                  [&](const glm::dvec3& d) {
                                      return glm::dvec3(d.y > 0.0 ? above : below);
                                  }))
            .rangeStops;
    };
    EXPECT_NEAR(halves(8.0, 1.0), 3.0, 1e-9);
    EXPECT_NEAR(halves(1.0, 1024.0), 10.0, 1e-9);
    // Scaling all light changes nothing.
    EXPECT_NEAR(halves(8e-3, 1e-3), 3.0, 1.1 / 64);
}

TEST(EnvironmentMeasures, ABrightSampleWithoutLightIsNoRange) {
    Image image = uniform(glm::dvec3(1.0), 256);
    for (std::size_t c = 0; c < 3; ++c) // at the horizon, where texels are large: .6 % of the light
        image.f32()[3 * (std::size_t{128} * 512 + 77) + c] = 500.0f;
    EXPECT_EQ(measuresOf(image).rangeStops, 0.0);
    // A sun that is as small and has a third of the light is one: log2 of 50,000.
    for (std::size_t c = 0; c < 3; ++c)
        image.f32()[3 * (std::size_t{128} * 512 + 77) + c] = 50000.0f;
    EXPECT_NEAR(measuresOf(image).rangeStops, std::log2(50000.0), 1.1 / 64);
}

TEST(EnvironmentMeasures, TemperatureOfThePicture) {
    for (const float kelvin : {2700.0f, 5000.0f, 12000.0f}) {
        const EnvironmentMeasures m = measuresOf(uniform(glm::dvec3(blackbodyColor(kelvin))));
        ASSERT_TRUE(m.temperature);
        EXPECT_NEAR(m.temperature->kelvin, kelvin, 0.005 * kelvin);
        EXPECT_THAT(tagsOf(m), Contains(kelvin < kWarmBelowK   ? EnvironmentTag::Warm
                                        : kelvin > kCoolAboveK ? EnvironmentTag::Cool
                                                               : EnvironmentTag::Neutral));
    }
    const EnvironmentMeasures green = measuresOf(uniform({0.1, 1.0, 0.1}));
    EXPECT_FALSE(green.temperature);
    for (const EnvironmentTag tag :
         {EnvironmentTag::Warm, EnvironmentTag::Neutral, EnvironmentTag::Cool})
        EXPECT_THAT(tagsOf(green), Not(Contains(tag)));
}

TEST(EnvironmentMeasures, AFlatTopOfManyTexelsIsClipped) {
    const Disc disc{60, 40, 8, 65504, 1};
    const EnvironmentMeasures clipped = measuresOf(disc.picture(128));
    EXPECT_NEAR(clipped.clippedShare, disc.solidAngle() / (4.0 * std::numbers::pi),
                0.4 * clipped.clippedShare); // its edge is mixed
    EXPECT_THAT(tagsOf(clipped), Contains(EnvironmentTag::Clipped));
    // One that rises to its middle is not.
    const Image round = latLong(128, [towards = disc.direction()](const glm::dvec3& d) {
        return glm::dvec3(1.0 + 1000.0 * std::pow(std::max(0.0, glm::dot(d, towards)), 200.0));
    });
    EXPECT_EQ(measuresOf(round).clippedShare, 0.0);
}

TEST(EnvironmentMeasures, DarkIsWhatIsDarkBesideItsBrightestSource) {
    // A sun with nine tenths of the light over an even sky leaves the sky bright …
    const EnvironmentMeasures sun = measuresOf(Disc{60, 40, 2, 120000, 1}.picture());
    ASSERT_TRUE(sun.source);
    EXPECT_GT(sun.source->share, 0.85);
    EXPECT_THAT(tagsOf(sun), Not(Contains(EnvironmentTag::Dark)));
    // … and windows of a room at night do not.
    const Image room = latLong(128, [](const glm::dvec3& d) {
        const bool window = std::abs(d.y) < 0.3 && std::sin(8.0 * std::atan2(d.x, d.z)) > 0.5;
        return glm::dvec3(window ? 10.0 : 0.05);
    });
    EXPECT_THAT(tagsOf(measuresOf(room)), Contains(EnvironmentTag::Dark));
}

TEST(EnvironmentMeasures, DoNotDependOnTheResolution) {
    const Disc disc{60, 40, 8, 300, 1};
    const EnvironmentMeasures fine = measuresOf(disc.picture(1024)),
                              coarse = measuresOf(disc.picture(256));
    EXPECT_NEAR(fine.source->share, coarse.source->share, 0.01);
    EXPECT_NEAR(fine.keyToFill, coarse.keyToFill, 0.02 * fine.keyToFill);
    EXPECT_NEAR(fine.meanLuminance, coarse.meanLuminance, 0.01 * fine.meanLuminance);
    EXPECT_NEAR(fine.rangeStops, coarse.rangeStops, 0.05);
}

TEST(EnvironmentThumbnail, MeanBecomesMiddleGreyWhateverTheSun) {
    // What PBR Neutral makes of 0.18, as sRGB.
    const float shown =
        shading::srgbEncode(shading::toneMapPbrNeutral(glm::vec3(shading::kMiddleGrey))).x;
    for (const Disc& disc : {Disc{60, 40, 4, 1000, 1}, Disc{60, 40, 4, 1000, 0.01}}) {
        const Image picture = disc.picture();
        const Image thumbnail = environmentThumbnail(picture, measureLight(picture).withoutSource);
        ASSERT_EQ(thumbnail.width(), kThumbnailWidth);
        ASSERT_EQ(thumbnail.height(), kThumbnailHeight);
        EXPECT_NEAR(thumbnail.sample(10, 120, 1), shown, 0.02);
        const auto at = [](double degrees, double around, int size) {
            return static_cast<int>(degrees / around * size);
        };
        // Azimuth 60 from +Z to +X is 120 right of the middle, which is -Z, seen from inside.
        const int x = at(180.0 + 120.0, 360.0, kThumbnailWidth),
                  y = at(50.0, 180.0, kThumbnailHeight);
        EXPECT_GT(thumbnail.sample(x, y, 1), 0.95);
    }
    const Image black = uniform(glm::dvec3(0.0));
    EXPECT_EQ(environmentThumbnail(black, black).sample(5, 5, 0), 0.0f);
}
