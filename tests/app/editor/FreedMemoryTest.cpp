// What is freed in small blocks goes back to the system once the editor rests.

#include "app/editor/FreedMemory.h"

#include <QSignalSpy>
#include <QTest>
#include <fstream>
#include <gtest/gtest.h>
#include <memory>
#include <string>
#include <unistd.h>
#include <vector>

namespace patina::editor {
namespace {

long residentMiB() {
    long pages = 0, resident = 0;
    std::ifstream("/proc/self/statm") >> pages >> resident;
    return resident * sysconf(_SC_PAGESIZE) >> 20;
}

TEST(FreedMemoryAtRest, GoesBackToTheSystem) {
    // As compilers leave it: many small blocks that are free, and a few between them that are not.
    constexpr std::size_t kBlocks = 1 << 19, kBytes = 256, kKeptEvery = 1 << 12; // 128 MiB
    std::vector<std::unique_ptr<char[]>> blocks(kBlocks);
    for (std::size_t i = 0; i < kBlocks; ++i) {
        blocks[i] = std::make_unique<char[]>(kBytes); // zeros: its pages are there
    }
    for (std::size_t i = 0; i < kBlocks; ++i)
        if (i % kKeptEvery != kKeptEvery - 1)
            blocks[i].reset();
    const long before = residentMiB();

    FreedMemory freed;
    QSignalSpy returned(&freed, &FreedMemory::returned);
    freed.frameDrawn();
    freed.frameDrawn();
    EXPECT_EQ(returned.count(), 0) << "not while frames follow each other";
    ASSERT_TRUE(returned.wait(60'000));
    EXPECT_LT(residentMiB(), before - 100) << before << " MiB before";
}

} // namespace
} // namespace patina::editor
