// Lights ranked by what their pictures lose: failures that are planted are found.
#include "core/rank/LightSweep.h"

#include "core/document/ViewChoices.h"
#include "core/job/Parallel.h"
#include "core/math/ShRotation.h"
#include "core/math/SphericalHarmonics.h"
#include "tests/reference/ReferenceSweep.h"

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <random>

using namespace patina;
using namespace patina::test;
using testing::HasSubstr;

namespace {

constexpr std::size_t kCoefficients = 25;

// A ball in the middle of the picture, each pixel with the transfer of an open surface there.
SweepPixels ball(int side, float albedo = 0.6f) {
    SweepPixels pixels;
    pixels.width = pixels.height = side;
    pixels.order = 5;
    std::vector<std::vector<float>> transfers;
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const float across = 2.2f * (float(x) + 0.5f) / float(side) - 1.1f,
                        up = 1.1f - 2.2f * (float(y) + 0.5f) / float(side);
            const float squared = 1.0f - across * across - up * up;
            if (squared <= 0.0f)
                continue;
            pixels.places.push_back(std::uint32_t(y * side + x));
            std::vector<float>& transfer = transfers.emplace_back(kCoefficients);
            evaluateSh(5, glm::vec3(across, up, std::sqrt(squared)), std::span(transfer));
            for (int l = 0; l < 5; ++l)
                for (int m = -l; m <= l; ++m)
                    transfer[std::size_t(shIndex(l, m))] *=
                        float(cosineConvolution(l) / 3.14159265);
        }
    pixels.covered = pixels.count();
    pixels.still.resize(3 * pixels.count());
    pixels.transfer.resize(3 * kCoefficients * pixels.count());
    for (std::size_t i = 0; i < kCoefficients; ++i)
        for (std::size_t c = 0; c < 3; ++c)
            for (std::size_t p = 0; p < pixels.count(); ++p)
                pixels.transfer[(3 * i + c) * pixels.count() + p] = albedo * transfers[p][i];
    return pixels;
}

// Uniform light of radiance 0.7 and some that comes from one side, `tilt` of it.
SweepEnvironment skyFrom(const glm::vec3& direction, float tilt, const glm::vec3& color) {
    SweepEnvironment sky;
    sky.name = "sky";
    std::vector<float> y(64);
    evaluateSh(8, direction, std::span(y));
    sky.harmonics.assign(64, glm::vec3(0.0f));
    sky.harmonics[0] = glm::vec3(0.7f * 3.5449077f); // √4π
    for (std::size_t i = 1; i < 64; ++i)
        sky.harmonics[i] = i < 9 ? tilt * y[i] * color : glm::vec3(0.0f);
    return sky;
}

std::vector<SweepEnvironment> skies(int count, unsigned seed, float tilt) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> even(0.0f, 1.0f);
    std::vector<SweepEnvironment> result;
    for (int i = 0; i < count; ++i) {
        const float z = 2.0f * even(random) - 1.0f, phi = 6.2831853f * even(random);
        const float r = std::sqrt(1.0f - z * z);
        const glm::vec3 color(0.8f + 0.2f * even(random), 0.9f, 0.8f + 0.2f * even(random));
        result.push_back(skyFrom({r * std::cos(phi), z, r * std::sin(phi)},
                                 tilt * (0.5f + 0.5f * even(random)), color));
    }
    return result;
}

void expectEqual(const LightSweep& sweep, const LightSweep& reference) {
    ASSERT_EQ(sweep.scores.size(), reference.scores.size());
    for (std::size_t i = 0; i < sweep.scores.size(); ++i) {
        SCOPED_TRACE(i);
        const LightScore &a = sweep.scores[i], &b = reference.scores[i];
        EXPECT_EQ(a.light.environment, b.light.environment);
        EXPECT_DOUBLE_EQ(a.light.rotationDeg, b.light.rotationDeg);
        EXPECT_NEAR(a.clipped.highlights, b.clipped.highlights, 1e-9);
        EXPECT_NEAR(a.clipped.shadows, b.clipped.shadows, 1e-9);
        EXPECT_NEAR(a.contrastStops, b.contrastStops, 1e-4);
        EXPECT_NEAR(a.lostContrast, b.lostContrast, 1e-4);
        EXPECT_NEAR(a.difference.mean, b.difference.mean, 1e-4);
        EXPECT_NEAR(a.difference.max, b.difference.max, 1e-3);
        EXPECT_NEAR(a.difference.worst, b.difference.worst, 1e-3);
    }
    for (std::size_t p = 0; p < sweep.sensitivity.f32().size(); ++p)
        ASSERT_NEAR(sweep.sensitivity.f32()[p], reference.sensitivity.f32()[p], 1e-3f) << p;
    for (std::size_t p = 0; p < sweep.reference.f32().size(); ++p)
        ASSERT_NEAR(sweep.reference.f32()[p], reference.reference.f32()[p], 1e-4f) << p;
}

} // namespace

TEST(LightSweep, EqualsAPlainLoopOverAllLights) {
    const SweepPixels pixels = ball(40);
    std::vector<SweepEnvironment> environments = skies(5, 11, 1.2f);
    for (glm::vec3& c : environments[2].harmonics) // clips
        c *= 6.0f;
    for (glm::vec3& c : environments[3].harmonics) // hardly seen
        c *= 1e-4f;
    SweepSettings settings;
    settings.rotations = 7;
    settings.scale = {1.1f, 1.0f, 0.9f};
    settings.view.exposureEv = 0.5f;
    for (const ToneMap curve : {ToneMap::Clamp, ToneMap::PbrNeutral, ToneMap::AgX}) {
        settings.view.toneMap = curve;
        SCOPED_TRACE(static_cast<int>(curve));
        expectEqual(*sweepLights(pixels, environments, settings, {}),
                    referenceSweep(pixels, environments, settings));
    }
    // Exposures that depend on the picture, another display, a look that is named.
    settings.view.toneMap = ToneMap::ReinhardPhotographic;
    settings.view.displayTransfer = DisplayTransfer::Gamma;
    settings.reference = SweepLight{1, 33.0};
    expectEqual(*sweepLights(pixels, environments, settings, {}),
                referenceSweep(pixels, environments, settings));
    settings.view.toneMap = ToneMap::Clamp;
    settings.view.exposureMode = ExposureMode::Automatic;
    expectEqual(*sweepLights(pixels, environments, settings, {}),
                referenceSweep(pixels, environments, settings));
}

TEST(LightSweep, DoesNotDependOnTheNumberOfThreads) {
    const SweepPixels pixels = ball(32);
    const std::vector<SweepEnvironment> environments = skies(4, 3, 1.0f);
    const SweepSettings settings;
    const LightSweep many = *sweepLights(pixels, environments, settings, {});
    const ThreadLimit limit(1);
    const LightSweep one = *sweepLights(pixels, environments, settings, {});
    EXPECT_EQ(many.reference, one.reference);
    EXPECT_EQ(many.sensitivity, one.sensitivity);
    for (std::size_t i = 0; i < one.scores.size(); ++i) {
        ASSERT_EQ(many.scores[i].difference.worst, one.scores[i].difference.worst);
        ASSERT_EQ(many.scores[i].contrastStops, one.scores[i].contrastStops);
    }
}

// One light of 7,200 in whose picture one pixel in a thousand fails: some pixels answer to a shape
// of light in the fourth band that one environment has, most of all at one of its rotations.
TEST(LightSweep, AFailureInAThousandthOfThePixelsUnderOneOf7200LightsIsRankedFirst) {
    constexpr int kSide = 64, kEnvironments = 200, kRotations = 36;
    constexpr std::size_t kPlantedEnvironment = 137, kPlantedRotation = 23;
    SweepPixels pixels = ball(kSide);
    std::vector<SweepEnvironment> environments = skies(kEnvironments, 5, 0.12f);
    environments[kPlantedEnvironment] = skyFrom({0, 1, 0}, 0.0f, glm::vec3(1.0f));
    // Coefficients 16 … 24 of no symmetry about +Y.
    const float shape[9] = {0.2f, -0.5f, 0.1f, 0.4f, -0.3f, 0.35f, 0.45f, -0.1f, 0.3f};
    for (std::size_t i = 16; i < 25; ++i)
        environments[kPlantedEnvironment].harmonics[i] = glm::vec3(0.7f * shape[i - 16]);
    std::vector<glm::vec3> rotated(25);
    ShRotation::aboutY(glm::radians(360.0 * kPlantedRotation / kRotations), 5)
        .apply(std::span(environments[kPlantedEnvironment].harmonics).first(25),
               std::span(rotated));
    // 4 of 4,096 pixels, in the middle of the ball.
    const std::uint32_t planted[] = {32 * kSide + 32, 32 * kSide + 33, 33 * kSide + 32,
                                     33 * kSide + 33};
    ASSERT_LE(std::size(planted) * 1000, std::size_t{kSide * kSide});
    float most = 0.0f;
    for (std::size_t i = 16; i < 25; ++i)
        most += rotated[i].x * rotated[i].x;
    for (std::size_t p = 0; p < pixels.count(); ++p) {
        const bool fails = std::ranges::find(planted, pixels.places[p]) != std::end(planted);
        for (std::size_t i = 16; i < 25; ++i)
            for (std::size_t c = 0; c < 3; ++c)
                pixels.transfer[(3 * i + c) * pixels.count() + p] =
                    fails ? 0.59f * rotated[i].x / most : 0.0f;
    }
    SweepSettings settings;
    settings.rotations = kRotations;
    settings.view.toneMap = ToneMap::Clamp;
    const LightSweep sweep = *sweepLights(pixels, environments, settings, {});
    ASSERT_EQ(sweep.scores.size(), std::size_t{7200});
    for (const RankBy by : {RankBy::Difference, RankBy::Clipping}) {
        SCOPED_TRACE(static_cast<int>(by));
        const std::vector<std::size_t> order = rankLights(sweep, by);
        const LightScore &first = sweep.scores[order[0]], &second = sweep.scores[order[1]];
        EXPECT_EQ(first.light.environment, kPlantedEnvironment);
        EXPECT_DOUBLE_EQ(first.light.rotationDeg, 10.0 * kPlantedRotation);
        EXPECT_GT(rankingScore(first, by), rankingScore(second, by));
        EXPECT_NE(std::ranges::find(planted,
                                    std::uint32_t(first.worstPixel.y * kSide + first.worstPixel.x)),
                  std::end(planted));
    }
    // It is the only light of all that clips.
    EXPECT_EQ(sweep.scores[rankLights(sweep, RankBy::Clipping)[1]].clipped.sum(), 0.0);
    // A mean over the picture does not find it.
    std::size_t above = 0;
    const double mean = sweep.scores[rankLights(sweep, RankBy::Difference)[0]].difference.mean;
    for (const LightScore& score : sweep.scores)
        above += score.difference.mean > mean ? 1 : 0;
    EXPECT_GT(above, 100u);
}

TEST(LightSweep, ALightThatClipsAndOneThatShowsNothingAreRankedFirst) {
    const SweepPixels pixels = ball(48);
    std::vector<SweepEnvironment> environments = skies(6, 2, 0.8f);
    for (glm::vec3& c : environments[4].harmonics)
        c *= 20.0f;
    SweepSettings settings;
    settings.rotations = 12;
    settings.view.toneMap = ToneMap::Clamp;
    const LightSweep sweep = *sweepLights(pixels, environments, settings, {});
    for (const RankBy by : {RankBy::Clipping, RankBy::Contrast}) // all white: no contrast either
        for (std::size_t k = 0; k < 12; ++k)
            EXPECT_EQ(sweep.scores[rankLights(sweep, by)[k]].light.environment, 4u);
    for (const LightScore& score : sweep.scores)
        EXPECT_EQ(clips(score), score.light.environment == 4);
    // The reference itself differs from itself by nothing and loses nothing.
    settings.reference = SweepLight{1, 60.0};
    const LightSweep against = *sweepLights(pixels, environments, settings, {});
    const LightScore& itself = against.scores[12 + 2];
    EXPECT_EQ(itself.light.rotationDeg, 60.0);
    EXPECT_EQ(itself.difference.max, 0.0);
    EXPECT_EQ(itself.lostContrast, 0.0);
}

TEST(LightSweep, SensitivityIsTheStandardDeviationInStops) {
    const SweepPixels pixels = ball(16);
    // Twice the light, four times the light: log2 has a deviation of one stop about its mean.
    SweepEnvironment dim = skyFrom({0, 1, 0}, 0.0f, glm::vec3(1.0f)), bright = dim;
    for (glm::vec3& c : dim.harmonics)
        c *= 100.0f;
    for (glm::vec3& c : bright.harmonics)
        c *= 400.0f;
    SweepSettings settings;
    settings.rotations = 1;
    const LightSweep sweep = *sweepLights(pixels, std::vector{dim, bright}, settings, {});
    for (const std::uint32_t place : pixels.places)
        EXPECT_NEAR(sweep.sensitivity.f32()[place], 1.0f, 1e-3f);
    EXPECT_EQ(sweep.sensitivity.f32()[0], 0.0f) << "no surface";
}

TEST(LightSweep, ScoresOfPicturesThatAreKnown) {
    // 100 pixels: 3 white in one channel, 2 black, the others grey.
    std::vector<float> shown(300, 0.2f);
    for (std::size_t p = 0; p < 3; ++p)
        shown[100 * p + p] = 1.0f;
    for (std::size_t p = 10; p < 12; ++p)
        shown[p] = shown[100 + p] = shown[200 + p] = 0.0f;
    const ClippedShares clipped = clippedShares(shown, {1e-4f, 0.99f});
    EXPECT_DOUBLE_EQ(clipped.highlights, 0.03);
    EXPECT_DOUBLE_EQ(clipped.shadows, 0.02);
    // Half black, half white: 6.66 stops with a flare of 1 %; the same everywhere: none.
    std::vector<float> halves(300, 0.0f);
    for (std::size_t c = 0; c < 3; ++c)
        std::fill_n(halves.begin() + std::ptrdiff_t(100 * c), 50, 1.0f);
    EXPECT_NEAR(contrastStops(halves), std::log2(101.0), 1e-5);
    EXPECT_EQ(contrastStops(std::vector<float>(300, 0.4f)), 0.0);
    // The worst one in a thousand of 2,000: two.
    std::vector<float> errors(2000, 0.1f);
    errors[700] = 0.9f;
    errors[701] = 0.7f;
    const DifferenceScore score = differenceScore(errors);
    EXPECT_NEAR(score.worst, 0.8, 1e-6);
    EXPECT_NEAR(score.max, 0.9, 1e-6);
    EXPECT_EQ(score.maxAt, 700u);
    EXPECT_NEAR(score.mean, (1998 * 0.1 + 1.6) / 2000, 1e-6);
}

TEST(LightSweep, RefusesWhatItCannotRank) {
    const SweepPixels pixels = ball(8);
    const std::vector<SweepEnvironment> environments = skies(2, 1, 0.5f);
    SweepSettings settings;
    settings.view.toneMap = ToneMap::OpenColorIo;
    EXPECT_THAT(sweepLights(pixels, environments, settings, {}).error().message,
                HasSubstr("OpenColorIO"));
    settings = {};
    settings.rotations = 0;
    EXPECT_EQ(sweepLights(pixels, environments, settings, {}).error().kind, ErrorKind::Usage);
    settings = {};
    EXPECT_EQ(sweepLights(pixels, {}, settings, {}).error().kind, ErrorKind::Usage);
    settings.reference = SweepLight{2, 0.0};
    EXPECT_EQ(sweepLights(pixels, environments, settings, {}).error().kind, ErrorKind::Usage);
    settings = {};
    std::vector<SweepEnvironment> broken = environments;
    broken[1].harmonics[3] = glm::vec3(std::nanf(""));
    const Result<LightSweep> sweep = sweepLights(pixels, broken, settings, {});
    EXPECT_TRUE(sweep.ok()) << "what is no number is black, as in every picture";
    JobControl control;
    control.cancel();
    EXPECT_EQ(sweepLights(pixels, environments, {}, control.context()).error().kind,
              ErrorKind::Cancelled);
}
