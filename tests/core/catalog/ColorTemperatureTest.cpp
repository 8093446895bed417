// Correlated colour temperatures against black bodies and standard illuminants.
#include "core/light/ColorTemperature.h"

#include "core/light/Blackbody.h"

#include <cmath>
#include <gtest/gtest.h>

using namespace patina;

namespace {

// Linear sRGB of CIE 1931 x, y at Y = 1 (IEC 61966-2-1).
glm::dvec3 colorOf(double x, double y) {
    const glm::dvec3 xyz(x / y, 1.0, (1.0 - x - y) / y);
    return {3.2404542 * xyz.x - 1.5371385 * xyz.y - 0.4985314 * xyz.z,
            -0.9692660 * xyz.x + 1.8760108 * xyz.y + 0.0415560 * xyz.z,
            0.0556434 * xyz.x - 0.2040259 * xyz.y + 1.0572252 * xyz.z};
}

} // namespace

TEST(ColorTemperature, OfABlackBodyIsItsOwn) {
    for (const double kelvin : {2000.0, 2700.0, 3456.0, 5000.0, 6504.0, 9300.0, 15000.0, 30000.0}) {
        const auto found = colorTemperature(glm::dvec3(blackbodyColor(static_cast<float>(kelvin))));
        ASSERT_TRUE(found) << kelvin;
        EXPECT_NEAR(1e6 / found->kelvin, 1e6 / kelvin, 0.1) << kelvin;
        EXPECT_NEAR(found->distance, 0.0, 1e-4) << kelvin;
    }
}

TEST(ColorTemperature, DoesNotDependOnBrightness) {
    const glm::dvec3 color(0.9, 0.7, 0.5);
    ASSERT_TRUE(colorTemperature(color));
    EXPECT_NEAR(colorTemperature(color)->kelvin, colorTemperature(1e4 * color)->kelvin, 1e-6);
    EXPECT_NEAR(colorTemperature(color)->kelvin, colorTemperature(1e-4 * color)->kelvin, 1e-6);
}

// CIE 15:2004: D65 has 6504 K and is greener than a black body (Δuv = +.0032), D50 5003 K, A 2856
// K, F2 (a cool white fluorescent lamp) 4230 K. The colour matching functions are fits, which is
// some percent of a hundred mired.
TEST(ColorTemperature, OfStandardIlluminants) {
    struct Illuminant {
        double x, y, kelvin;
    };
    for (const Illuminant& i : {Illuminant{0.31272, 0.32903, 6504},
                                {0.34567, 0.35850, 5003},
                                {0.44758, 0.40745, 2856},
                                {0.37208, 0.37529, 4230}}) {
        const auto found = colorTemperature(colorOf(i.x, i.y));
        ASSERT_TRUE(found) << i.kelvin;
        EXPECT_NEAR(found->kelvin, i.kelvin, 0.02 * i.kelvin);
    }
    EXPECT_NEAR(colorTemperature(colorOf(0.31272, 0.32903))->distance, 0.0032, 0.002);
}

TEST(ColorTemperature, NoneFarFromTheLocusAndOfBlack) {
    EXPECT_FALSE(colorTemperature({0.1, 1.0, 0.1})); // green
    EXPECT_FALSE(colorTemperature({1.0, 0.0, 1.0})); // magenta
    EXPECT_FALSE(colorTemperature({0.0, 0.0, 0.0}));
    EXPECT_FALSE(colorTemperature({std::nan(""), 1.0, 1.0}));
}

TEST(ColorTemperature, BeyondTheHottestItIsTheHottest) {
    const auto blue = colorTemperature({0.55, 0.75, 1.6});
    ASSERT_TRUE(blue);
    EXPECT_NEAR(1e6 / blue->kelvin, 25.0, 0.1); // 40,000 K
}
