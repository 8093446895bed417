#include "app/editor/viewport/AdaptationClock.h"

#include <gtest/gtest.h>

namespace patina::editor {
namespace {

Luminance seen(float adapted, float logAverage) {
    Luminance luminance;
    luminance.adapted = adapted;
    luminance.logAverage = logAverage;
    return luminance;
}

TEST(AdaptationClock, RunsWhileTheEyeAdapts) {
    AdaptationClock clock;
    EXPECT_EQ(clock.beginFrame(100.0), 0.0f) << "nobody knows how long the eye had rested";
    EXPECT_TRUE(clock.endFrame(seen(0.1f, 0.8f), true));
    EXPECT_FLOAT_EQ(clock.beginFrame(100.25), 0.25f);
    EXPECT_TRUE(clock.endFrame(seen(0.2f, 0.8f), true));
    EXPECT_FLOAT_EQ(clock.beginFrame(101.75), 1.5f) << "a slow frame is as long as it is";
    EXPECT_FALSE(clock.endFrame(seen(0.8f, 0.8f), true));
    EXPECT_FALSE(clock.running());
}

TEST(AdaptationClock, ARestDoesNotCount) {
    AdaptationClock clock;
    (void)clock.beginFrame(0.0);
    EXPECT_FALSE(clock.endFrame(seen(0.8f, 0.8f), true));
    EXPECT_EQ(clock.beginFrame(3600.0), 0.0f) << "what changed after an hour is seen coming";
    EXPECT_TRUE(clock.endFrame(seen(0.8f, 0.1f), true));
    EXPECT_FLOAT_EQ(clock.beginFrame(3600.5), 0.5f);
    EXPECT_EQ(clock.beginFrame(3600.4), 0.0f) << "time does not run backwards";
}

TEST(AdaptationClock, StandsStillWithoutAutomaticExposure) {
    AdaptationClock clock;
    (void)clock.beginFrame(0.0);
    EXPECT_FALSE(clock.endFrame(seen(0.1f, 0.8f), false));
    EXPECT_FALSE(clock.endFrame(std::nullopt, true));
    EXPECT_EQ(clock.beginFrame(1.0), 0.0f);
}

} // namespace
} // namespace patina::editor
