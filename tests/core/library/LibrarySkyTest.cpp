// The built-in environments: finite, seamless, exposed as stated, true to their formulas.
#include "core/library/Library.h"
#include "core/library/SkyCanvas.h"
#include "core/library/SkyRecipes.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <gmock/gmock.h>

using namespace patina;

namespace {

constexpr double kPi = 3.14159265358979;
constexpr int W = 1024, H = 512;

glm::dvec3 texel(const Image& image, int x, int y) {
    const float* p = &image.f32()[static_cast<std::size_t>(3 * (y * W + x))];
    return {p[0], p[1], p[2]};
}
double lum(const glm::dvec3& c) {
    return 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b;
}
double solidAngle(int y) {
    return 2 * kPi / W * (std::cos(kPi * y / H) - std::cos(kPi * (y + 1) / H));
}
// Irradiance divided by pi on a surface facing up, of texels brighter than `above`.
double whiteFacingUp(const Image& image, double above = -1.0) {
    double sum = 0;
    for (int y = 0; y < H / 2; ++y)
        for (int x = 0; x < W; ++x)
            if (const double l = lum(texel(image, x, y)); l > above)
                sum += l * std::cos(kPi * (y + 0.5) / H) * solidAngle(y);
    return sum / kPi;
}
double meanLuminance(const Image& image) {
    double sum = 0;
    for (int y = 0; y < H; ++y)
        for (int x = 0; x < W; ++x)
            sum += lum(texel(image, x, y)) * solidAngle(y);
    return sum / (4 * kPi);
}

class EverySky : public testing::TestWithParam<const char*> {
  protected:
    ImagePtr sky = library::environment(GetParam()).value();
};

} // namespace

INSTANTIATE_TEST_SUITE_P(Library, EverySky,
                         testing::Values("white", "clear-sky", "overcast", "studio", "sunset",
                                         "night"));

TEST_P(EverySky, IsALatLongImageOfFiniteRadiance) {
    EXPECT_EQ(sky->width(), W);
    EXPECT_EQ(sky->height(), H);
    EXPECT_EQ(sky->channels(), 3);
    EXPECT_EQ(sky->type(), PixelType::F32);
    EXPECT_EQ(sky->encoding(), ColorEncoding::Linear);
    for (const float value : sky->f32()) {
        ASSERT_TRUE(std::isfinite(value));
        ASSERT_GE(value, 0.0f);
        ASSERT_LE(value, 65504.0f); // fits a half-float texture
    }
}

TEST_P(EverySky, IsExposedAsItsTableSays) {
    const auto recipes = library::skyRecipes();
    const auto recipe = std::find_if(recipes.begin(), recipes.end(), [&](const auto& r) {
        return std::string(r.name) == GetParam();
    });
    ASSERT_NE(recipe, recipes.end());
    EXPECT_NEAR(whiteFacingUp(*sky), recipe->whiteFacingUp, 2e-3 * recipe->whiteFacingUp);
    const bool night = std::string(GetParam()) == "night";
    EXPECT_GE(recipe->whiteFacingUp, night ? 0.08 : 0.5);
    EXPECT_LE(recipe->whiteFacingUp, night ? 0.2 : 1.0);
    EXPECT_GE(meanLuminance(*sky), night ? 0.03 : 0.2);
    EXPECT_LE(meanLuminance(*sky), night ? 0.3 : 1.2);
}

TEST_P(EverySky, HasNoSeamAndNoPoles) {
    // The step over the seam is no greater than the greatest of the ten beside it.
    const auto step = [&](int a, int b) {
        double sum = 0;
        for (int y = 0; y < H; ++y) {
            const double la = lum(texel(*sky, a, y)), lb = lum(texel(*sky, b, y));
            sum += std::fabs(la - lb) / (la + lb + 0.01);
        }
        return sum;
    };
    double beside = 0;
    for (int x = 0; x < 5; ++x)
        beside = std::max({beside, step(x, x + 1), step(W - 2 - x, W - 1 - x)});
    EXPECT_LE(step(W - 1, 0), 1.1 * beside + 1e-6);

    // All texels of the first row look at almost the same point.
    for (const int y : {0, H - 1}) {
        double smallest = 1e9, largest = 0;
        for (int x = 0; x < W; ++x) {
            smallest = std::min(smallest, lum(texel(*sky, x, y)));
            largest = std::max(largest, lum(texel(*sky, x, y)));
        }
        EXPECT_LE(largest, 1.08 * smallest) << "row " << y;
    }
}

TEST(LibrarySky, WhiteIsAFurnace) {
    const ImagePtr white = library::environment("white").value();
    for (const float value : white->f32())
        ASSERT_EQ(value, 1.0f);
}

TEST(LibrarySky, ClearSkyHasASunThatGivesTwoThirdsOfTheLight) {
    const ImagePtr sky = library::environment("clear-sky").value();
    int bestX = 0, bestY = 0;
    for (int y = 0; y < H; ++y)
        for (int x = 0; x < W; ++x)
            if (lum(texel(*sky, x, y)) > lum(texel(*sky, bestX, bestY))) {
                bestX = x;
                bestY = y;
            }
    EXPECT_GT(lum(texel(*sky, bestX, bestY)), 1e4);
    // Azimuth -22° (as a camera's yaw: from +Z towards -X), elevation 43.8°.
    EXPECT_NEAR(90.0 - (bestY + 0.5) * 180.0 / H, 43.8, 0.36);
    const double azimuth = 180.0 - ((bestX + 0.5) * 360.0 / W - 180.0) - 360.0;
    EXPECT_NEAR(std::remainder(azimuth + 22.0, 360.0), 0.0, 0.36);
    EXPECT_NEAR(whiteFacingUp(*sky, 100.0) / whiteFacingUp(*sky), 2.0 / 3.0, 0.005);
    // Away from the sun the sky is blue.
    const glm::dvec3 blue = texel(*sky, W / 2, H / 4);
    EXPECT_GT(blue.b, 1.5 * blue.r);
}

TEST(LibrarySky, OvercastFollowsTheCieFormula) {
    const ImagePtr sky = library::environment("overcast").value();
    const double zenith = 9.0 / 7.0 * 0.80; // E = 7 pi / 9 Lz
    for (const int y : {0, 40, 128, 200, 255})
        for (const int x : {0, 511, 700}) {
            const double elevation = kPi / 2 - (y + 0.5) * kPi / H;
            EXPECT_NEAR(lum(texel(*sky, x, y)), zenith * (1.0 + 2.0 * std::sin(elevation)) / 3.0,
                        2e-3);
        }
}

TEST(LibrarySky, StudioIsADarkRoomWithBrightBoxes) {
    const ImagePtr sky = library::environment("studio").value();
    double bright = 0, dark = 0;
    for (int y = 0; y < H; ++y)
        for (int x = 0; x < W; ++x) {
            const double l = lum(texel(*sky, x, y));
            bright += l > 3.0 ? solidAngle(y) : 0.0;
            dark += l < 0.3 ? solidAngle(y) : 0.0;
        }
    EXPECT_GT(bright / (4 * kPi), 0.03);
    EXPECT_LT(bright / (4 * kPi), 0.20);
    EXPECT_GT(dark / (4 * kPi), 0.6);
}

TEST(LibrarySky, SunsetIsWarmTowardsTheSunAndBlueAbove) {
    const ImagePtr sky = library::environment("sunset").value();
    // The sun's azimuth -44° is u = 0.5 + (180 + 44) / 360 - 1.
    const int sunX = static_cast<int>((0.5 + 224.0 / 360.0 - 1.0) * W);
    const glm::dvec3 low = texel(*sky, sunX + 12, H / 2 - 10), high = texel(*sky, 10, 4);
    EXPECT_GT(low.r, 2.0 * low.b);
    EXPECT_GT(lum(low), 3.0 * lum(high));
}

TEST(LibrarySky, NightHasLightsInManyColours) {
    const ImagePtr sky = library::environment("night").value();
    int warm = 0, cool = 0, magenta = 0, lit = 0;
    for (int y = 0; y < H; ++y)
        for (int x = 0; x < W; ++x) {
            const glm::dvec3 c = texel(*sky, x, y);
            if (lum(c) < 1.0)
                continue;
            ++lit;
            warm += c.r > 2.0 * c.b;
            cool += c.b > 2.0 * c.r;
            magenta += c.r > 4.0 * c.g && c.b > 2.0 * c.g;
        }
    EXPECT_GT(warm, 10);
    EXPECT_GT(cool, 10);
    EXPECT_GT(magenta, 5);
    EXPECT_LT(lit, W * H / 100);
}

// A disc keeps its energy wherever it falls on the grid of texels.
TEST(LibrarySky, DiscsKeepTheirEnergy) {
    for (const double elevation : {-60.0, 0.1, 33.3, 88.0}) {
        library::SkyCanvas canvas;
        const double e = elevation * kPi / 180.0;
        canvas.addDisc(glm::vec3(std::cos(e) * 0.6, std::sin(e), std::cos(e) * 0.8), 0.27,
                       glm::vec3(1000.0f));
        double sum = 0;
        for (int y = 0; y < H; ++y)
            for (int x = 0; x < W; ++x)
                sum += canvas.pixel(x, y).g * solidAngle(y);
        const double expected = 1000.0 * 2 * kPi * (1.0 - std::cos(0.27 * kPi / 180.0));
        EXPECT_NEAR(sum, expected, 1e-4 * expected) << elevation;
    }
}
