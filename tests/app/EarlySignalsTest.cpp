// Signals that come before a command has begun.
#include "app/cli/EarlySignals.h"

#include "app/cli/Options.h"
#include "app/cli/Watcher.h"

#include <csignal>
#include <gtest/gtest.h>
#include <unistd.h>

namespace patina::cli {
namespace {

[[noreturn]] void runAfterSignal(int signal, bool requeues) {
    const EarlySignals early;
    ::raise(signal); // as while the command line is read
    CommonOptions options;
    options.requeues = requeues;
    const Watcher watcher(options);
    ::sleep(30); // work that polls for nothing
    ::_exit(0);
}

TEST(EarlySignalsDeathTest, EndTheCommandAsItSaysThenAndLater) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    EXPECT_EXIT(runAfterSignal(SIGTERM, false), testing::ExitedWithCode(128 + SIGTERM),
                "nothing was written");
    EXPECT_EXIT(runAfterSignal(SIGINT, false), testing::ExitedWithCode(128 + SIGINT),
                "nothing was written");
    EXPECT_EXIT(runAfterSignal(SIGTERM, true), testing::ExitedWithCode(75), "run it again");
}

} // namespace
} // namespace patina::cli
