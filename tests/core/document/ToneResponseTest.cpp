// A view's exposure and tone curve on the CPU.
#include "core/document/ToneResponse.h"
#include "core/document/View.h"
#include "core/document/ViewChoices.h"

#include <cmath>
#include <gtest/gtest.h>

namespace patina {
namespace {

Luminance pictureOf(float logAverage, float adapted) {
    return {logAverage, adapted, 0.001f, 100.0f};
}

TEST(ToneResponse, ExposureByHandAndByTheEye) {
    View view;
    EXPECT_FALSE(needsLuminance(view));
    view.exposureEv = 2.0f;
    EXPECT_FLOAT_EQ(exposureScale(view, pictureOf(9.0f, 9.0f)), 4.0f);
    view.exposureMode = ExposureMode::Automatic;
    EXPECT_TRUE(needsLuminance(view));
    // The luminance that the eye is used to becomes middle grey, times the correction.
    EXPECT_FLOAT_EQ(exposureScale(view, pictureOf(9.0f, 0.36f)), 2.0f);
    EXPECT_FLOAT_EQ(exposureInForce(view, pictureOf(9.0f, 0.36f)), 1.0f);
}

TEST(ToneResponse, ThePhotographicKeyIsAnExposureOfItsOwn) {
    View view;
    view.toneMap = ToneMap::ReinhardPhotographic;
    EXPECT_TRUE(needsLuminance(view));
    view.exposureMode = ExposureMode::Automatic; // does not expose twice
    view.reinhardKey = 0.36f;
    const Luminance picture = pictureOf(1.0f, 0.09f);
    EXPECT_FLOAT_EQ(exposureScale(view, picture), 1.0f);
    EXPECT_FLOAT_EQ(exposureInForce(view, picture), 2.0f);
    view.displayTransfer = DisplayTransfer::Gamma;
    view.displayGamma = 1.0f;
    EXPECT_FLOAT_EQ(displayedGrey(view, picture, 0.25f), 0.5f); // L = 4 · 0.25
    view.reinhardWhite = 1.0f;
    EXPECT_FLOAT_EQ(displayedGrey(view, picture, 0.25f), 1.0f);
    // Reinhard 2002, automatic key for 0.001 … 0.1 … 100.
    view.reinhardAutoKey = true;
    EXPECT_NEAR(std::exp2(exposureInForce(view, pictureOf(0.1f, 0.1f))), 0.136414490986 / 0.1,
                1e-4);
}

TEST(ToneResponse, TheDisplayComesLastAndOnce) {
    View view;
    view.toneMap = ToneMap::Clamp;
    EXPECT_NEAR(displayedGrey(view, {}, 0.18f), 0.4613561295, 1e-6);
    view.displayTransfer = DisplayTransfer::Gamma;
    EXPECT_NEAR(displayedGrey(view, {}, 0.5f), 0.729740052841, 1e-6);
    view.toneMap = ToneMap::Exponential;
    view.displayGamma = 1.0f;
    view.exponentialK = 2.0f;
    EXPECT_NEAR(displayedGrey(view, {}, 0.5f), 1.0 - std::exp(-1.0), 1e-6);
}

} // namespace
} // namespace patina
