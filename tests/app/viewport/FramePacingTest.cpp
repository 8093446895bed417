#include "app/editor/viewport/FramePacing.h"

#include <gtest/gtest.h>
#include <utility>

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

TEST(FramePacing, OnlyFramesAtRestThatTakeLongAreDrawnInSlices) {
    FramePacing pacing;
    EXPECT_FALSE(pacing.slices()) << "nothing is known of them";
    pacing.frameTook(90.0);
    EXPECT_TRUE(pacing.slices());
    EXPECT_EQ(pacing.expectedMs(), 90.0);
    pacing.beginMoving();
    EXPECT_FALSE(pacing.slices());
    // A reduced frame says what all pixels will take.
    const double pixels = static_cast<double>(pacing.scale()) * static_cast<double>(pacing.scale());
    pacing.frameTook(40.0 * pixels);
    pacing.refine();
    EXPECT_NEAR(pacing.expectedMs(), 40.0, 1e-6);
    EXPECT_TRUE(pacing.slices());
    pacing.frameTook(6.0);
    EXPECT_FALSE(pacing.slices());
    // Four samples take some three times as long, until one such frame has been measured.
    pacing.frameTook(15.0);
    pacing.refine();
    ASSERT_EQ(pacing.samples(), 4);
    EXPECT_TRUE(pacing.slices());
    pacing.frameTook(11.0);
    EXPECT_FALSE(pacing.slices());
}

// Eight frames are added up for a smooth picture where that does not keep the processors busy for
// long.
TEST(FramePacing, FramesAreAddedUnlessTheyAreVerySlow) {
    FramePacing pacing;
    pacing.setAccumulates(true);
    const auto nextPicture = [&] {
        pacing.beginMoving();
        EXPECT_TRUE(pacing.refine());
        return pacing.accumulating();
    };
    for (const auto& [ms, adds] : {std::pair(120.0, true), {240.0, true}, {260.0, false}}) {
        pacing.frameTook(ms);
        EXPECT_EQ(nextPicture(), adds) << ms;
    }
    // Of a picture all frames or none, however long one of them waited for a compiler.
    pacing.frameTook(120.0);
    EXPECT_TRUE(pacing.accumulating()) << "it was not the scene that was slow";
    pacing.frameTook(900.0);
    EXPECT_TRUE(pacing.accumulating()) << "they have begun";
    pacing.pictureChanged();
    EXPECT_FALSE(pacing.accumulating());
    pacing.setAddsSlowFrames(true);
    EXPECT_TRUE(pacing.accumulating());
    pacing.beginMoving();
    EXPECT_FALSE(pacing.accumulating());
}
