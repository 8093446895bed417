// What is said of the room on a disk before something is computed for it.
#include "core/base/DiskSpace.h"
#include "tests/support/TemporaryFolder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

using namespace patina;
using namespace patina::test;
using ::testing::AllOf;
using ::testing::HasSubstr;

TEST(DiskSpace, WhatDoesNotFitIsRefused) {
    const TemporaryFolder folder;
    const auto file = folder.path() / "new.exr";
    const std::optional<std::uint64_t> available = freeDiskBytes(file);
    ASSERT_TRUE(available);
    EXPECT_GT(*available, 0u);
    EXPECT_TRUE(checkDiskSpace(file, 1, 1).ok());
    const Result<void> refused = checkDiskSpace(file, std::uint64_t{1} << 60, 1);
    ASSERT_FALSE(refused.ok());
    EXPECT_EQ(refused.error().kind, ErrorKind::Io);
    EXPECT_EQ(refused.error().file, file);
    EXPECT_THAT(refused.error().message,
                AllOf(HasSubstr("up to 1073741824.0 GiB"), HasSubstr("another place")));
}

TEST(DiskSpace, NobodyKnowsOfDevicesAndMissingFolders) {
    EXPECT_FALSE(freeDiskBytes("/dev/full"));
    EXPECT_FALSE(freeDiskBytes("/no/such/folder/new.exr"));
    EXPECT_TRUE(checkDiskSpace("/dev/full", std::uint64_t{1} << 60, std::uint64_t{1} << 60).ok());
    // A link leads to where it leads.
    const TemporaryFolder folder;
    std::filesystem::create_symlink("/dev/full", folder.path() / "link.exr");
    EXPECT_FALSE(freeDiskBytes(folder.path() / "link.exr"));
}
