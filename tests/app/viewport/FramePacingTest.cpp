#include "app/editor/viewport/FramePacing.h"

#include <gtest/gtest.h>

using patina::editor::FramePacing;

TEST(FramePacing, RestRefinesInStepsThatAreAffordable) {
    FramePacing pacing;
    pacing.beginMoving();
    for (int i = 0; i < 10; ++i)
        pacing.frameTook(90.0);
    EXPECT_LT(pacing.scale(), 0.5f);
    EXPECT_EQ(pacing.samples(), 1);
    EXPECT_TRUE(pacing.refine());
    EXPECT_EQ(pacing.scale(), 1.0f);
    EXPECT_EQ(pacing.samples(), 1);
    pacing.frameTook(120.0);
    EXPECT_TRUE(pacing.refine());
    EXPECT_EQ(pacing.samples(), 4);
    pacing.frameTook(350.0);
    EXPECT_FALSE(pacing.refine()) << "as fine as it gets";

    pacing.beginMoving();
    pacing.refine();
    pacing.frameTook(400.0);
    EXPECT_FALSE(pacing.refine()) << "would hold up the hand for more than a second";
}

TEST(FramePacing, AChangeAtRestIsShownBeforeItIsRefined) {
    FramePacing pacing;
    pacing.frameTook(90.0);
    EXPECT_TRUE(pacing.refine());
    pacing.frameTook(300.0);
    pacing.pictureChanged();
    EXPECT_EQ(pacing.samples(), 1);
    EXPECT_EQ(pacing.scale(), 1.0f);
    EXPECT_TRUE(pacing.refine());
    EXPECT_EQ(pacing.samples(), 4);

    pacing.beginMoving();
    pacing.pictureChanged();
    EXPECT_TRUE(pacing.moving()) << "the hand has not let go";
}

TEST(FramePacing, AFastGpuAlwaysDrawsAtFullQuality) {
    FramePacing pacing;
    pacing.frameTook(3.0);
    EXPECT_TRUE(pacing.refine());
    pacing.frameTook(5.0);
    pacing.beginMoving();
    EXPECT_EQ(pacing.scale(), 1.0f);
    EXPECT_EQ(pacing.samples(), 4);
}

// A frame's time is proportional to its pixels plus a fixed part. The pacing must find a scale
// that is fast enough where there is one, and stay there instead of flickering.
TEST(FramePacing, SettlesOnAScaleThatHoldsTheRate) {
    for (const double fullFrameMs : {5.0, 20.0, 60.0, 150.0, 240.0, 400.0}) {
        FramePacing pacing;
        pacing.beginMoving();
        const auto frame = [&] {
            const double scale = static_cast<double>(pacing.scale());
            const double ms = 2.0 + fullFrameMs * scale * scale;
            pacing.frameTook(ms);
            return ms;
        };
        for (int i = 0; i < 100; ++i)
            frame();
        int changes = 0;
        for (int i = 0; i < 200; ++i) {
            const float before = pacing.scale();
            EXPECT_LE(frame(), 31.0) << fullFrameMs;
            changes += before != pacing.scale();
        }
        EXPECT_EQ(changes, 0) << fullFrameMs;
    }
}

TEST(FramePacing, TheFirstMovingFrameIsAsFastAsTheOthers) {
    FramePacing pacing;
    pacing.frameTook(150.0); // at rest, full resolution
    pacing.beginMoving();
    EXPECT_LE(150.0f * pacing.scale() * pacing.scale(), 30.0f);
    EXPECT_GT(pacing.scale(), 0.39f) << "no coarser than needed";

    FramePacing fast;
    fast.frameTook(20.0);
    fast.beginMoving();
    EXPECT_EQ(fast.scale(), 1.0f);
}
