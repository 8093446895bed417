// Who is next, on a machine whose frames and pieces of work take as long as the test says.
#include "app/editor/viewport/FrameSchedule.h"

#include <gtest/gtest.h>
#include <memory>
#include <optional>
#include <string>

namespace patina::editor {
namespace {

class FrameScheduleTest : public ::testing::Test {
  protected:
    FrameScheduleTest() {
        schedule.setClock([this] { return now; });
    }
    // What the event loop does: a frame that was asked for is painted, else the next turn is taken
    // when it is due. False: nothing is, for good.
    bool proceed() {
        if (asked) {
            asked = false;
            paint();
            return true;
        }
        const std::optional<double> wait = schedule.untilTurn();
        if (!wait)
            return false;
        now += *wait;
        schedule.turn();
        return true;
    }
    void paint() {
        now += frameMs;
        ++frames;
        schedule.framePainted(frameMs);
        if (moving)
            animation.start();
    }
    // So many steps of the loop; an animation keeps it going.
    void proceed(int steps) {
        for (int i = 0; i < steps; ++i)
            ASSERT_TRUE(proceed());
    }

    double now = 1000.0;
    double frameMs = 16.0;
    int frames = 0;
    bool asked = false, moving = true, clockMoves = true;
    FrameSchedule schedule;
    FrameSchedule::Animation animation{schedule, 16.0, [this] {
                                           asked = clockMoves;
                                           return clockMoves;
                                       }};
};

TEST_F(FrameScheduleTest, ATaskIsDoneOnceAndNotBeforeItsTime) {
    int done = 0;
    FrameSchedule::Task task(schedule, [&] { ++done; });
    EXPECT_FALSE(schedule.untilTurn().has_value());
    task.want(40.0);
    EXPECT_EQ(schedule.untilTurn(), 40.0);
    now += 30.0;
    schedule.turn();
    EXPECT_EQ(done, 0);
    task.want(40.0); // counted anew
    EXPECT_EQ(schedule.untilTurn(), 40.0);
    now += 40.0;
    schedule.turn();
    EXPECT_EQ(done, 1);
    EXPECT_FALSE(task.isWanted());
    schedule.turn();
    EXPECT_EQ(done, 1);
    task.want();
    task.drop();
    schedule.turn();
    EXPECT_EQ(done, 1);
}

// Each piece wants the next one at once, as slices and uploads do.
TEST_F(FrameScheduleTest, WhatIsAlwaysDueLeavesTheOthersTheirTurn) {
    std::string order;
    std::optional<FrameSchedule::Task> a, b, c;
    a.emplace(schedule, [&] { order += 'a', a->want(); });
    b.emplace(schedule, [&] { order += 'b', b->want(); });
    c.emplace(schedule, [&] { order += 'c', c->want(); });
    a->want();
    b->want();
    c->want();
    for (int i = 0; i < 9; ++i)
        schedule.turn();
    EXPECT_EQ(order, "abcabcabc");
}

// Painting a frame takes as long as the pace, or six times that: there is no time between.
TEST_F(FrameScheduleTest, SlicesAndUploadsEndWhileAnAnimationGoesOn) {
    for (const double ms : {16.0, 100.0}) {
        frameMs = ms;
        int slices = 20, uploads = 6;
        std::optional<FrameSchedule::Task> slicing, upload;
        slicing.emplace(schedule, [&] {
            now += 25.0;
            if (--slices > 0)
                slicing->want();
        });
        upload.emplace(schedule, [&] {
            now += 10.0;
            if (--uploads > 0)
                upload->want();
        });
        animation.start();
        slicing->want();
        upload->want();
        const int before = frames;
        const double begin = now;
        for (int steps = 0; slices > 0 || uploads > 0; ++steps) {
            ASSERT_LT(steps, 200) << ms;
            ASSERT_TRUE(proceed());
        }
        EXPECT_GE(frames - before, 4) << "nor does the animation stand still, " << ms;
        // As much for the work as for the frames, but for the pace between these.
        const double work = 20 * 25.0 + 6 * 10.0;
        EXPECT_LT(now - begin, 2.0 * work + 2.0 * ms + 16.0) << ms;
    }
}

TEST_F(FrameScheduleTest, ShortPiecesDoNotHoldAnAnimationUp) {
    frameMs = 40.0;
    FrameSchedule::Task endless(schedule, [&] {
        now += 1.0;
        endless.want();
    });
    endless.want();
    animation.start();
    const int before = frames;
    proceed(200);
    EXPECT_GE(frames - before, 8);
}

TEST_F(FrameScheduleTest, NothingIsPaintedWhereNoClockHasMoved) {
    clockMoves = false;
    animation.start();
    proceed(50);
    EXPECT_EQ(frames, 0);
    EXPECT_TRUE(animation.isRunning());
    clockMoves = true;
    proceed(2);
    EXPECT_EQ(frames, 1);
    animation.stop();
    EXPECT_FALSE(schedule.untilTurn().has_value());
}

TEST_F(FrameScheduleTest, AnAnimationKeepsItsPace) {
    frameMs = 4.0;
    animation.start();
    const double begin = now;
    while (frames < 10)
        ASSERT_TRUE(proceed());
    EXPECT_DOUBLE_EQ(now - begin, 10 * (16.0 + 4.0)) << "from the end of a frame to the next";
}

// The turn after a frame is the input's, which has come while it was painted.
TEST_F(FrameScheduleTest, InputGoesFirstAfterAFrame) {
    int done = 0;
    FrameSchedule::Task task(schedule, [&] { ++done; });
    task.want();
    schedule.framePainted(5.0);
    schedule.turn();
    EXPECT_EQ(done, 0);
    EXPECT_EQ(schedule.untilTurn(), 0.0);
    schedule.turn();
    EXPECT_EQ(done, 1);
}

// A drag, or whoever calls for a frame again and again.
TEST_F(FrameScheduleTest, FramesThatFollowEachOtherLeaveWorkItsTurns) {
    int done = 0;
    FrameSchedule::Task task(schedule, [&] {
        ++done;
        task.want();
    });
    task.want();
    for (int i = 0; i < 20; ++i) {
        schedule.framePainted(100.0);
        schedule.turn();
    }
    EXPECT_EQ(done, 10);
}

// Those who take part come and go, also in their own turn, and may outlive the schedule.
TEST_F(FrameScheduleTest, OwnersEndWhenTheyLike) {
    auto other = std::make_unique<FrameSchedule>();
    FrameSchedule::Task late(*other, [] { FAIL(); });
    FrameSchedule::Animation lateAnimation(*other, 1.0, [] { return false; });
    late.want();
    lateAnimation.start();
    int done = 0;
    std::unique_ptr<FrameSchedule::Task> ends;
    ends = std::make_unique<FrameSchedule::Task>(*other, [&] {
        ++done;
        ends.reset();
    });
    late.drop();
    ends->want();
    other->turn();
    EXPECT_EQ(done, 1);
    other.reset();
    EXPECT_FALSE(lateAnimation.isRunning());
    late.want();
    lateAnimation.start();
    EXPECT_FALSE(late.isWanted());
}

TEST_F(FrameScheduleTest, WhoeverDrivesItHearsOfEarlierTurns) {
    std::optional<double> heard;
    schedule.setAlarm([&] { heard = schedule.untilTurn(); });
    FrameSchedule::Task task(schedule, [] {});
    task.want(100.0);
    EXPECT_EQ(heard, 100.0);
    animation.start();
    EXPECT_EQ(heard, 16.0);
    task.want();
    EXPECT_EQ(heard, 0.0);
}

} // namespace
} // namespace patina::editor
