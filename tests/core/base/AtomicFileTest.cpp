#include "core/base/AtomicFile.h"
#include "tests/support/TemporaryFolder.h"

#include <algorithm>
#include <csignal>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace fs = std::filesystem;
using namespace patina;

namespace {

class AtomicFileTest : public ::testing::Test {
  protected:
    [[nodiscard]] std::size_t entries() const {
        return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), {}));
    }
    const test::TemporaryFolder temporary;
    const fs::path folder = temporary.path();
};

TEST_F(AtomicFileTest, WritesAndReplaces) {
    const fs::path file = folder / "a.txt";
    ASSERT_TRUE(writeFileAtomically(file, std::string_view("one")).ok());
    ASSERT_TRUE(writeFileAtomically(file, std::string_view("two")).ok());
    EXPECT_EQ(readTextFile(file, 100).value(), "two");
    EXPECT_EQ(entries(), 1u);
}

TEST_F(AtomicFileTest, WritesPiecesOneAfterAnother) {
    const fs::path file = folder / "a.txt";
    const std::string first = "one ", none, last = "two";
    const std::vector<std::span<const std::byte>> pieces = {std::as_bytes(std::span(first)),
                                                            std::as_bytes(std::span(none)),
                                                            std::as_bytes(std::span(last))};
    ASSERT_TRUE(writePiecesAtomically(file, pieces).ok());
    EXPECT_EQ(readTextFile(file, 100).value(), "one two");
}

TEST_F(AtomicFileTest, KeepsPermissionsAndFollowsLinks) {
    const fs::path file = folder / "a.txt", link = folder / "link.txt";
    ASSERT_TRUE(writeFileAtomically(file, std::string_view("one")).ok());
    fs::permissions(file, fs::perms::owner_read | fs::perms::owner_write);
    fs::create_symlink(file, link);
    ASSERT_TRUE(writeFileAtomically(link, std::string_view("two")).ok());
    EXPECT_TRUE(fs::is_symlink(link));
    EXPECT_EQ(readTextFile(file, 100).value(), "two");
    EXPECT_EQ(fs::status(file).permissions(), fs::perms::owner_read | fs::perms::owner_write);
}

TEST_F(AtomicFileTest, ReportsWhatCannotBeCreated) {
    EXPECT_EQ(writeFileAtomically(folder / "no" / "a", std::string_view("x")).error().kind,
              ErrorKind::CannotCreate);
    EXPECT_EQ(writeFileAtomically(folder, std::string_view("x")).error().kind,
              ErrorKind::CannotCreate);
    EXPECT_EQ(writeFileAtomically(fs::path("/dev/full"), std::string_view("x")).error().kind,
              ErrorKind::Io);
}

// A write that hits the file size limit half-way is a disk that fills up.
TEST_F(AtomicFileTest, KeepsTheOldContentWhenWritingFails) {
    const fs::path file = folder / "a.bin";
    ASSERT_TRUE(writeFileAtomically(file, std::string_view("old")).ok());
    const pid_t child = ::fork();
    if (child == 0) {
        std::signal(SIGXFSZ, SIG_IGN);
        const rlimit limit{4096, 4096};
        ::setrlimit(RLIMIT_FSIZE, &limit);
        const std::string large(1 << 20, 'x');
        const Result<void> result = writeFileAtomically(file, std::string_view(large));
        ::_exit(!result.ok() && result.error().kind == ErrorKind::Io ? 0 : 1);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_EQ(status, 0);
    EXPECT_EQ(readTextFile(file, 100).value(), "old");
    EXPECT_EQ(entries(), 1u);
}

// Killed at any moment, the file holds the old or the new content and nothing else lies about.
TEST_F(AtomicFileTest, SurvivesBeingKilled) {
    const fs::path file = folder / "a.bin";
    const std::string oldText(100'000, 'o'), newText(3'000'000, 'n');
    for (int round = 0; round < 40; ++round) {
        ASSERT_TRUE(writeFileAtomically(file, std::string_view(oldText)).ok());
        const pid_t child = ::fork();
        if (child == 0) {
            static_cast<void>(writeFileAtomically(file, std::string_view(newText)));
            ::_exit(0);
        }
        ::usleep(static_cast<useconds_t>(round * 100));
        ::kill(child, SIGKILL);
        ::waitpid(child, nullptr, 0);
        const std::string text = readTextFile(file, 10'000'000).value();
        EXPECT_TRUE(text == oldText || text == newText) << "round " << round;
    }
    // Between linkat and rename a name may remain; the window is a few microseconds.
    EXPECT_LE(entries(), 2u);
}

TEST_F(AtomicFileTest, ReadReportsMissingFoldersAndLargeFiles) {
    EXPECT_EQ(readFile(folder / "none", 10).error().kind, ErrorKind::InputMissing);
    EXPECT_EQ(readFile(folder, 10).error().kind, ErrorKind::InputMissing);
    ASSERT_TRUE(writeFileAtomically(folder / "a", std::string_view("12345678901")).ok());
    EXPECT_EQ(readFile(folder / "a", 10).error().kind, ErrorKind::InputBroken);
}

} // namespace
