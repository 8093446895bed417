// A process that ends from a thread leaves no file between its temporary and its final name.
#include "core/base/FileNaming.h"

#include "core/base/AtomicFile.h"
#include "tests/support/TemporaryFolder.h"

#include <atomic>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <gtest/gtest.h>
#include <system_error>
#include <thread>

namespace patina {
namespace {

using namespace std::chrono_literals;

// 0: as it should be.
[[noreturn]] void endFromAThread() {
    const test::TemporaryFolder folder;
    std::atomic<bool> begun = false, done = false;
    std::thread other([&] {
        const FileNaming between;
        begun = true;
        while (!done)
            std::this_thread::sleep_for(1ms);
        std::this_thread::sleep_for(20ms);
    });
    while (!begun)
        std::this_thread::sleep_for(1ms);
    bool sound = !stopFileNaming(1ms); // somebody is in between
    done = true;
    sound = stopFileNaming(60s) && sound;
    other.join();
    std::thread late([&folder] {
        static_cast<void>(writeFileAtomically(folder / "late", std::string_view("text")).ok());
    });
    std::this_thread::sleep_for(100ms);
    sound = folder.files().empty() && sound;
    std::error_code ignored;
    std::filesystem::remove_all(folder.path(), ignored);
    std::_Exit(sound ? 0 : 1);
}

TEST(FileNamingDeathTest, AnEndWaitsForThoseInBetweenAndLetsNobodyBegin) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    EXPECT_EXIT(endFromAThread(), testing::ExitedWithCode(0), "");
}

} // namespace
} // namespace patina
