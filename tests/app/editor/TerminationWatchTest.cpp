// Whoever ends the editor is heard at once, whatever its window is busy with.
#include "app/editor/TerminationWatch.h"

#include <chrono>
#include <csignal>
#include <cstdio>
#include <gtest/gtest.h>
#include <thread>
#include <unistd.h>

namespace patina::editor {
namespace {

using namespace std::chrono_literals;

[[noreturn]] void hang() {
    std::this_thread::sleep_for(60s); // a driver that compiles
    ::_exit(0);
}

void say(const char* words) {
    std::fputs(words, stderr);
}

class TerminationWatchDeathTest : public testing::Test {
  protected:
    void SetUp() override { GTEST_FLAG_SET(death_test_style, "threadsafe"); }
};

TEST_F(TerminationWatchDeathTest, WhileNothingCanBeUnsavedTheProcessEndsAtOnce) {
    for (const int signal : {SIGTERM, SIGHUP, SIGINT})
        EXPECT_EXIT(
            {
                TerminationWatch watch(60s);
                watch.atSignal([] { say("heard"); });
                ::raise(signal);
                hang();
            },
            testing::ExitedWithCode(128 + signal), "^heard$");
}

TEST_F(TerminationWatchDeathTest, AWindowThatHangsIsEndedWithItsWorkOnTheDisk) {
    EXPECT_EXIT(
        {
            TerminationWatch watch(100ms);
            watch.atSignal([] { say("heard, "); });
            watch.endInOrder([](int) { say("asked, "); });
            watch.atLast([] { say("saved"); });
            ::raise(SIGTERM);
            hang();
        },
        testing::ExitedWithCode(128 + SIGTERM), "^heard, asked, saved$");
}

TEST_F(TerminationWatchDeathTest, AnEndInOrderIsNotDisturbed) {
    EXPECT_EXIT(
        {
            {
                TerminationWatch watch(60s);
                watch.endInOrder([](int) {});
                watch.atLast([] { say("too late"); });
                ::raise(SIGTERM);
                watch.release();
            }
            std::this_thread::sleep_for(50ms);
            ::_exit(7);
        },
        testing::ExitedWithCode(7), "^$");
}

TEST_F(TerminationWatchDeathTest, ASecondSignalEndsTheProcess) {
    EXPECT_EXIT(
        {
            TerminationWatch watch(60s);
            watch.endInOrder([](int) {});
            ::raise(SIGTERM);
            ::raise(SIGTERM);
            hang();
        },
        testing::KilledBySignal(SIGTERM), "");
}

} // namespace
} // namespace patina::editor
