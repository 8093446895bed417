// What is freed in small blocks goes back to the system by itself.

#include "app/editor/Allocator.h"

#include <QTest>
#include <fstream>
#include <gtest/gtest.h>
#include <memory>
#include <thread>
#include <unistd.h>
#include <vector>

namespace patina::editor {
namespace {

long residentMiB() {
    long pages = 0, resident = 0;
    std::ifstream("/proc/self/statm") >> pages >> resident;
    return resident * sysconf(_SC_PAGESIZE) >> 20;
}

TEST(AllocatorTest, FreedMemoryGoesBackToTheSystem) {
    prepareAllocator();
    const long before = residentMiB();
    // As compilers leave it: many small blocks that are free, and a few between them that are not.
    constexpr std::size_t kBlocks = 1 << 19, kBytes = 256, kKeptEvery = 1 << 12; // 128 MiB
    std::vector<std::unique_ptr<char[]>> blocks(kBlocks);
    std::thread([&] { // its heap is not that of this thread
        for (std::size_t i = 0; i < kBlocks; ++i)
            blocks[i] = std::make_unique<char[]>(kBytes); // zeros: its pages are there
    })
        .join();
    EXPECT_GT(residentMiB(), before + 100);
    for (std::size_t i = 0; i < kBlocks; ++i)
        if (i % kKeptEvery != kKeptEvery - 1)
            blocks[i].reset();
    EXPECT_TRUE(QTest::qWaitFor([&] { return residentMiB() < before + 28; }, 60'000))
        << before << " MiB before, " << residentMiB() << " after";
}

} // namespace
} // namespace patina::editor
