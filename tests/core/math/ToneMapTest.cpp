// Exposure, adaptation and tone curves: exact values, and what holds for every curve.
#include "core/document/Document.h"
#include "core/document/ViewChoices.h"
#include "core/edit/ParameterChoices.h"
#include "core/math/Shading.h"

#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <random>
#include <vector>

namespace patina::shading {
namespace {

ToneCurve toneCurve(int curve, float scale = 1.0f, float white = 0.0f, float k = 1.0f) {
    return {curve, scale, white, k, 0};
}

void expectNear(const vec3& actual, const vec3& expected, float tolerance) {
    for (int i = 0; i < 3; ++i)
        EXPECT_NEAR(actual[i], expected[i], tolerance) << "channel " << i;
}

// Every choice but OpenColorIO's displays, which come last, is a curve of toneMap(). One that this
// forgets would show as another.
TEST(ToneMap, EachChoiceIsACurveOfItsOwn) {
    const std::size_t curves = kToneMaps.names().size() - 1;
    EXPECT_EQ(std::size_t{kToneMapOpenColorIo}, curves);
    std::vector<vec3> seen;
    for (std::size_t i = 0; i < curves; ++i) {
        const ToneCurve curve = toneCurve(static_cast<int>(i), 0.5f, 4.0f, 1.3f);
        const vec3 shown = toneMap(vec3(0.6f, 0.3f, 0.1f), curve);
        for (std::size_t other = 0; other < seen.size(); ++other)
            EXPECT_GT(glm::distance(shown, seen[other]), 1e-3f)
                << kToneMaps.names()[i] << " shows what " << kToneMaps.names()[other] << " shows";
        seen.push_back(shown);
    }
}

TEST(ToneMap, IsPbrNeutralAtAFixedExposureByDefault) {
    EXPECT_EQ(View().toneMap, ToneMap::PbrNeutral);
    EXPECT_EQ(View().exposureMode, ExposureMode::Fixed);
}

// --- Exact values --------------------------------------------------------------------------------

TEST(ToneMap, ReinhardIdentities) {
    EXPECT_NEAR(reinhard(1.0f), 0.5f, 1e-7f);
    EXPECT_NEAR(reinhard(0.18f), 0.152542372881, 1e-7);
    EXPECT_NEAR(reinhardExtended(1.0f, 2.0f), 0.625f, 1e-7f);
    EXPECT_NEAR(reinhardExtended(2.0f, 2.0f), 1.0f, 1e-7f);
    EXPECT_NEAR(reinhardExtended(4.0f, 4.0f), 1.0f, 1e-7f);
    EXPECT_NEAR(reinhardExtended(0.7f, 1e6f), reinhard(0.7f), 1e-6f);

    // On colours: luminance follows the curve, ratios of channels stay.
    const vec3 c(0.6f, 0.3f, 0.1f), mapped = toneMap(c, toneCurve(kToneMapReinhard));
    EXPECT_NEAR(luminance(mapped), reinhard(luminance(c)), 1e-6f);
    EXPECT_NEAR(mapped.x / mapped.y, 2.0f, 1e-5f);
    EXPECT_EQ(toneMap(vec3(1e6f, 0.0f, 0.0f), toneCurve(kToneMapReinhard)).x, 1.0f);
    EXPECT_EQ(toneMap(vec3(-1.0f, 0.5f, 3.0f), toneCurve(kToneMapClamp)), vec3(0.0f, 0.5f, 1.0f));

    // Per channel: each follows the curve by itself, and none is cut.
    ToneCurve channels = toneCurve(kToneMapReinhard);
    channels.perChannel = 1;
    expectNear(toneMap(c, channels), vec3(reinhard(0.6f), reinhard(0.3f), reinhard(0.1f)), 1e-7f);
    EXPECT_LT(toneMap(vec3(50.0f, 40.0f, 30.0f), channels).x, 1.0f);
    EXPECT_EQ(toneMap(vec3(50.0f, 40.0f, 30.0f), toneCurve(kToneMapReinhard)).x, 1.0f);
    EXPECT_NEAR(toneMap(vec3(0.7f), channels).x, toneMap(vec3(0.7f), toneCurve(kToneMapReinhard)).x,
                1e-6f)
        << "grey has one luminance";

    EXPECT_FLOAT_EQ(applyExposure(vec3(0.25f), 2.0f).x, 1.0f);
    EXPECT_FLOAT_EQ(applyExposure(vec3(0.25f), -1.0f).x, 0.125f);
}

// Reinhard et al. 2002 on six pixels, by hand: Lavg = exp(mean(ln(1e-4 + L))), L = 0.18 / Lavg Lw,
// Ld = L (1 + L / Lwhite²) / (1 + L), Lwhite the largest L, colours scaled by Ld / Lw.
TEST(ToneMap, ReinhardPhotographicOnSixPixels) {
    constexpr std::array<vec3, 6> kPixels = {vec3(0.01f, 0.02f, 0.03f),
                                             vec3(0.2f, 0.1f, 0.05f),
                                             vec3(1.0f),
                                             vec3(4.0f, 8.0f, 2.0f),
                                             vec3(0.0f),
                                             vec3(50.0f, 40.0f, 30.0f)};
    double sum = 0.0;
    for (const vec3& pixel : kPixels)
        sum += static_cast<double>(logLuminance(pixel));
    const auto logAverage = static_cast<float>(std::exp2(sum / 6.0));
    EXPECT_NEAR(logAverage, 0.198528670882, 1e-6); // 1/N outside of exp would give 1.02e-5

    const float scale = 0.18f / logAverage, white = 37.5397667595f;
    constexpr std::array<double, 6> kScaled = {
        0.016860436254, 0.106669731409, 0.906670050225, 6.08955872533, 0.0, 37.5397667595};
    constexpr std::array<double, 6> kSimple = {
        0.0165808754602, 0.0963880445823, 0.475525406254, 0.858947497476, 0.0, 0.974052774988};
    constexpr std::array<double, 6> kWhite = {
        0.0165810738381, 0.0963953405219, 0.475831348785, 0.862659167007, 0.0, 1.0};
    // A channel above 1 is cut, here and on the display.
    constexpr std::array<vec3, 6> kColors = {
        vec3(0.00891647334807f, 0.0178329466961f, 0.0267494200442f),
        vec3(0.163867982188f, 0.0819339910939f, 0.0409669955469f),
        vec3(0.475831348785f),
        vec3(0.513762829496f, 1.0f, 0.256881414748f),
        vec3(0.0f),
        vec3(1.0f, 0.966090232828f, 0.724567674621f)};
    for (std::size_t i = 0; i < kPixels.size(); ++i) {
        SCOPED_TRACE(i);
        const float L = luminance(kPixels[i]);
        EXPECT_NEAR(scale * L, kScaled[i], 1e-5 * (1.0 + kScaled[i]));
        EXPECT_NEAR(reinhard(scale * L), kSimple[i], 1e-5);
        EXPECT_NEAR(reinhardExtended(scale * L, white), kWhite[i], 1e-5);
        expectNear(toneMap(kPixels[i], toneCurve(kToneMapReinhardPhotographic, scale, white)),
                   kColors[i], 1e-5f);
        const vec3 channels = toneMapReinhardPhotographicChannels(kPixels[i], scale, white);
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(channels[c], std::min(reinhardExtended(scale * kPixels[i][c], white), 1.0f),
                        1e-6f);
        // Without a white point: equation 3.
        const vec3 simple = toneMapReinhardPhotographic(kPixels[i], scale, 0.0f);
        expectNear(simple, min(kPixels[i] * (L > 0 ? reinhard(scale * L) / L : 0.0f), vec3(1.0f)),
                   1e-5f);
    }
}

TEST(ToneMap, TheWhitePointAndAllAboveBecomeWhite) {
    for (const float white : {0.5f, 1.0f, 4.0f, 100.0f}) {
        const ToneCurve curve = toneCurve(kToneMapReinhardPhotographic, 0.25f, white);
        expectNear(toneMap(vec3(4.0f * white), curve), vec3(1.0f), 1e-6f);
        expectNear(toneMap(vec3(400.0f * white), curve), vec3(1.0f), 1e-6f);
        EXPECT_LT(toneMap(vec3(2.0f * white), curve).x, 0.99f);
    }
}

// Reinhard 2002 (JGT 7(1)): 0.18 · 4^((2 log2 Lav - log2 Lmin - log2 Lmax)/(log2 Lmax - log2 Lmin))
TEST(ToneMap, AutomaticKey) {
    constexpr std::array<std::pair<float, double>, 5> kKeys = {{{0.01f, 0.0783495506967},
                                                                {0.1f, 0.136414490986},
                                                                {1.0f, 0.237511423939},
                                                                {10.0f, 0.413531407799},
                                                                {100.0f, 0.72}}};
    for (const auto& [average, key] : kKeys)
        EXPECT_NEAR(reinhardAutoKey(average, 0.001f, 100.0f), key, 1e-6);
    EXPECT_NEAR(reinhardAutoKey(0.001f, 0.001f, 100.0f), 0.045, 1e-6);
    EXPECT_EQ(reinhardAutoKey(0.5f, 0.5f, 0.5f), 0.18f) << "a picture of one luminance";
}

TEST(ToneMap, ExponentialIsAnExposure) {
    EXPECT_NEAR(toneMapExponential(vec3(1.0f), 1.0f).x, 0.632120558829, 1e-6);
    EXPECT_NEAR(toneMapExponential(vec3(0.5f), 2.0f).x, 0.632120558829, 1e-6);
    EXPECT_NEAR(toneMapExponential(vec3(0.001f), 3.0f).x, 0.003f, 5e-6f) << "slope k at black";
}

// F90 = 0.04, compression from 0.8 - 0.04, desaturation 0.15.
TEST(ToneMap, KhronosPbrNeutral) {
    constexpr std::array<std::pair<vec3, vec3>, 6> kValues = {{
        {vec3(0.18f), vec3(0.14f)},
        {vec3(0.5f, 0.3f, 0.1f), vec3(0.46f, 0.26f, 0.06f)},
        {vec3(0.04f, 0.02f, 0.01f), vec3(0.030625f, 0.010625f, 0.000625f)},
        {vec3(1.0f), vec3(0.869090909091f)},
        {vec3(4.0f, 2.0f, 1.0f), vec3(0.983255813953f, 0.639951387048f, 0.468299173595f)},
        {vec3(0.0f), vec3(0.0f)},
    }};
    for (const auto& [radiance, shown] : kValues)
        expectNear(toneMap(radiance, toneCurve(kToneMapPbrNeutral)), shown, 1e-5f);
}

// What it is for: a surface of base colour b under white light of 1 reflects b and 4 % of the
// light; the operator shows b.
TEST(ToneMap, KhronosPbrNeutralKeepsBaseColors) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> channel(0.08f, 0.8f);
    for (int i = 0; i < 1000; ++i) {
        const vec3 c(channel(random), channel(random), channel(random));
        expectNear(toneMap(c, toneCurve(kToneMapPbrNeutral)), c - 0.04f, 1e-6f);
    }
}

// By hand from the published fit: (v (v + 0.0245786) - 0.000090537) /
// (v (0.983729 v + 0.4329510) + 0.238081); the rows of both matrices add up to 1.
TEST(ToneMap, AcesFit) {
    expectNear(toneMapAces(vec3(0.18f)), vec3(0.105575f), 2e-5f);
    expectNear(toneMapAces(vec3(1.0f)), vec3(0.619115f), 3e-5f);
    // Bright saturated red turns towards yellow and white, as film does.
    const vec3 red = toneMapAces(vec3(20.0f, 0.0f, 0.0f));
    EXPECT_EQ(red.x, 1.0f);
    EXPECT_GT(red.y, 0.1f);
    EXPECT_GT(red.y, red.z);
}

// Against B. Wrensch's polynomial of degree 6, an independent fit of the original curve.
TEST(ToneMap, AgXCurveIsThePublishedOne) {
    for (int i = 0; i <= 100; ++i) {
        const float x = 0.01f * static_cast<float>(i);
        const float x2 = x * x, x4 = x2 * x2;
        const float fit = 15.5f * x4 * x2 - 40.14f * x4 * x + 31.96f * x4 - 6.868f * x2 * x +
                          0.4298f * x2 + 0.1191f * x - 0.00232f;
        EXPECT_NEAR(agxCurve(x), fit, 0.006f) << x;
    }
    EXPECT_NEAR(agxCurve(0.0f), 0.0f, 1e-6f);
    EXPECT_NEAR(agxCurve(1.0f), 1.0f, 1e-6f);
    EXPECT_NEAR(agxCurve(10.0f / 16.5f), 0.5f, 1e-6f);
    const float h = 1e-3f, pivot = 10.0f / 16.5f;
    EXPECT_NEAR((agxCurve(pivot + h) - agxCurve(pivot - h)) / (2 * h), 2.0f, 1e-2f);
    // Middle grey is half the encoded range of a display with gamma 2.2.
    expectNear(toneMapAgX(vec3(0.18f)), vec3(std::pow(0.5f, 2.2f)), 2e-4f);
    // Greys stay grey.
    const vec3 grey = toneMapAgX(vec3(3.0f));
    EXPECT_NEAR(grey.x, grey.z, 5e-4f);
    EXPECT_NEAR(grey.x, grey.y, 5e-4f);
}

// --- What holds for all of them ------------------------------------------------------------------

class EveryCurve : public testing::TestWithParam<int> {
  protected:
    [[nodiscard]] static vec3 mapped(const vec3& c) {
        return toneMap(c, toneCurve(GetParam(), 0.9f, GetParam() % 2 == 0 ? 6.0f : 0.0f, 1.3f));
    }
};

TEST_P(EveryCurve, BlackStaysBlackAndLightBecomesLight) {
    expectNear(mapped(vec3(0.0f)), vec3(0.0f), 1e-12f);
    EXPECT_GT(mapped(vec3(1e4f)).x, 0.99f);
}

TEST_P(EveryCurve, IsMonotoneOnGreys) {
    vec3 before(0.0f);
    for (float ev = -16.0f; ev <= 20.0f; ev += 0.01f) {
        const vec3 now = mapped(vec3(std::exp2(ev)));
        for (int i = 0; i < 3; ++i)
            ASSERT_GE(now[i], before[i] - 2e-7f) << "at " << ev << " EV, channel " << i;
        before = now;
    }
}

// More light of one colour is never darker.
TEST_P(EveryCurve, LuminanceIsMonotoneOnColors) {
    std::mt19937 random(11);
    std::uniform_real_distribution<float> channel(0.0f, 1.0f);
    for (int i = 0; i < 100; ++i) {
        const vec3 hue(channel(random), channel(random), channel(random));
        float before = 0.0f;
        for (float ev = -12.0f; ev <= 14.0f; ev += 0.1f) {
            const float now = luminance(mapped(hue * std::exp2(ev)));
            ASSERT_GE(now, before - 1e-6f)
                << "at " << ev << " EV of " << hue.x << ", " << hue.y << ", " << hue.z;
            before = now;
        }
    }
}

TEST_P(EveryCurve, IsFiniteWhateverComes) {
    constexpr float kInf = std::numeric_limits<float>::infinity();
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    constexpr std::array kBad = {kNan,    kInf, -kInf,  -1.0f,  -1e30f,   1e30f,
                                 3.4e38f, 0.0f, 1e-45f, 1e-30f, 65504.0f, 1.0f};
    for (const float r : kBad)
        for (const float g : kBad)
            for (const float b : {kNan, kInf, -1.0f, 1e30f, 0.0f, 0.5f}) {
                const vec3 shown = mapped(vec3(r, g, b));
                for (int i = 0; i < 3; ++i)
                    ASSERT_TRUE(shown[i] >= 0.0f && shown[i] <= 1.0f)
                        << r << ", " << g << ", " << b << " channel " << i << ": " << shown[i];
            }
    EXPECT_EQ(mapped(vec3(kNan)), mapped(vec3(0.0f))) << "NaN is shown as black";
    EXPECT_EQ(mapped(vec3(-5.0f)), mapped(vec3(0.0f)));
    EXPECT_EQ(mapped(vec3(kInf)), mapped(vec3(kMaxRadiance)));
}

INSTANTIATE_TEST_SUITE_P(Each, EveryCurve, testing::Range(0, kToneMapOpenColorIo));

// --- The display ---------------------------------------------------------------------------------

TEST(Display, EncodesOnce) {
    // IEC 61966-2-1.
    constexpr std::array<std::pair<float, double>, 8> kSrgb = {{{0.0f, 0.0},
                                                                {0.001f, 0.01292},
                                                                {0.0031308f, 0.040449936},
                                                                {0.01f, 0.0998528227341},
                                                                {0.18f, 0.4613561295},
                                                                {0.214041f, 0.499999848223},
                                                                {0.5f, 0.735356983052},
                                                                {1.0f, 1.0}}};
    constexpr std::array kCodes = {0, 3, 10, 25, 118, 127, 188, 255};
    for (std::size_t i = 0; i < kSrgb.size(); ++i) {
        const vec3 shown = displayEncode(vec3(kSrgb[i].first), kDisplaySrgb, 1.0f);
        EXPECT_NEAR(shown.x, kSrgb[i].second, 1e-6);
        EXPECT_EQ(std::lround(255.0f * shown.y), kCodes[i]);
    }
    EXPECT_NEAR(displayEncode(vec3(0.5f), kDisplayGamma, 2.2f).x, 0.729740052841, 1e-6);
    EXPECT_NEAR(displayEncode(vec3(0.25f), kDisplayGamma, 2.0f).z, 0.5f, 1e-6f);
    EXPECT_NEAR(displayEncode(vec3(0.3f), kDisplayGamma, 1.0f).x, 0.3f, 1e-6f);
    EXPECT_EQ(displayEncode(vec3(-1.0f, 0.0f, 7.0f), kDisplayGamma, 2.4f), vec3(0.0f, 0.0f, 1.0f));
}

// --- Adaptation ----------------------------------------------------------------------------------

// 1 - 0.98^(60 t)
TEST(Adaptation, WeightsOfTime) {
    constexpr std::array<std::pair<float, double>, 7> kWeights = {
        {{1.0f / 240.0f, 0.00503794360731},
         {1.0f / 60.0f, 0.02},
         {1.0f / 30.0f, 0.0396},
         {0.1f, 0.114157619136},
         {0.5f, 0.454515680618},
         {1.0f, 0.702446857308},
         {5.0f, 0.997667494332}}};
    for (const auto& [seconds, weight] : kWeights)
        EXPECT_NEAR(adaptationWeight(seconds), weight, 1e-6) << seconds;
    EXPECT_EQ(adaptationWeight(0.0f), 0.0f);
    EXPECT_NEAR(adaptationWeight(0.5718269748586f), 0.5, 1e-6) << "half-life";
    EXPECT_NEAR(adaptationWeight(0.8249719408754f), 1.0 - std::exp(-1.0), 1e-6) << "tau";
    EXPECT_NEAR(adaptationWeight(2.47139506806f), 0.95, 1e-6);
}

TEST(Adaptation, DoesNotDependOnTheFrameRate) {
    const auto after = [](int frames, float seconds) {
        float L = 1.0f;
        for (int i = 0; i < frames; ++i)
            L = adaptLuminance(L, 10.0f, seconds);
        return L;
    };
    EXPECT_NEAR(after(60, 1.0f / 60.0f), 7.32202171577, 1e-4);
    EXPECT_NEAR(after(30, 1.0f / 30.0f), 7.32202171577, 1e-4);
    EXPECT_NEAR(after(1, 1.0f), 7.32202171577, 1e-5);
    // Two half steps are one whole step.
    for (const float seconds : {0.004f, 0.02f, 0.1f, 0.7f})
        EXPECT_NEAR(
            adaptLuminance(adaptLuminance(0.3f, 2.0f, 0.5f * seconds), 2.0f, 0.5f * seconds),
            adaptLuminance(0.3f, 2.0f, seconds), 1e-6f);
    EXPECT_EQ(adaptLuminance(0.3f, 2.0f, 0.0f), 0.3f);
    EXPECT_EQ(adaptLuminance(1e6f, 1e-4f, 1e4f), 1e-4f) << "out of the sun into the dark";
}

TEST(Adaptation, BringsThePictureToMiddleGrey) {
    EXPECT_FLOAT_EQ(automaticExposure(0.18f), 1.0f);
    EXPECT_FLOAT_EQ(automaticExposure(1.8f), 0.1f);
    EXPECT_FLOAT_EQ(automaticExposure(0.0f), 1800.0f) << "bounded in the dark";
    EXPECT_FLOAT_EQ(std::exp2(logLuminance(vec3(0.5f))), 0.5001f);
    EXPECT_NEAR(std::exp2(logLuminance(vec3(-3.0f))), 1e-4f, 1e-9f);
}

} // namespace
} // namespace patina::shading
