// Planck's law and the analytic matching functions against published numbers.
#include "core/light/Blackbody.h"

#include <gtest/gtest.h>

namespace patina {
namespace {

TEST(Blackbody, MatchingFunctionsHaveTheirPublishedPeaks) {
    // CIE 1931 tables: x̄(600) = 1.0622, ȳ(555) = 1.0, z̄(445) = 1.7826; the fit is within 2 %.
    EXPECT_NEAR(cieColorMatching(600.0).x, 1.0622, 0.02);
    EXPECT_NEAR(cieColorMatching(555.0).y, 1.0000, 0.02);
    EXPECT_NEAR(cieColorMatching(445.0).z, 1.7826, 0.03);
    EXPECT_NEAR(cieColorMatching(504.0).x, 0.0039, 0.012); // between the two lobes of x̄
}

TEST(Blackbody, ChromaticitiesLieOnThePlanckianLocus) {
    // Illuminant A is a Planckian radiator of 2856 K: x, y = 0.44757, 0.40745 (CIE 15). The others:
    // Wyszecki & Stiles 1982, table 1(3.11).
    const struct {
        double kelvin, x, y;
    } known[] = {{1500, 0.5857, 0.3931},  {2000, 0.5267, 0.4133}, {2856, 0.44757, 0.40745},
                 {4000, 0.3805, 0.3768},  {5000, 0.3451, 0.3516}, {6500, 0.3135, 0.3237},
                 {10000, 0.2807, 0.2884}, {20000, 0.2565, 0.2577}};
    for (const auto& k : known) {
        const glm::dvec2 xy = blackbodyChromaticity(k.kelvin);
        EXPECT_NEAR(xy.x, k.x, 0.005) << k.kelvin;
        EXPECT_NEAR(xy.y, k.y, 0.005) << k.kelvin;
    }
}

TEST(Blackbody, ColoursHaveLuminanceOneAndNoNegativeParts) {
    for (const float kelvin : {0.0f, 1000.0f, 1500.0f, 2700.0f, 6500.0f, 40000.0f, 1e9f}) {
        const glm::vec3 c = blackbodyColor(kelvin);
        EXPECT_NEAR(0.2126729f * c.r + 0.7151522f * c.g + 0.0721750f * c.b, 1.0f, 1e-5f) << kelvin;
        EXPECT_GE(std::min({c.r, c.g, c.b}), 0.0f) << kelvin;
    }
    EXPECT_EQ(blackbodyColor(1500.0f).b, 0.0f);
    EXPECT_GT(blackbodyColor(2700.0f).r, 1.5f * blackbodyColor(2700.0f).g);
    EXPECT_GT(blackbodyColor(15000.0f).b, 1.3f * blackbodyColor(15000.0f).r);
    // Near the white point of sRGB (6504 K, a little greener) no channel stands out.
    const glm::vec3 day = blackbodyColor(6500.0f);
    EXPECT_NEAR(day.r, 1.0f, 0.05f);
    EXPECT_NEAR(day.g, 1.0f, 0.05f);
    EXPECT_NEAR(day.b, 1.0f, 0.05f);
}

} // namespace
} // namespace patina
