#include "core/base/AtomicFolder.h"
#include "tests/support/TemporaryFolder.h"

#include <csignal>
#include <gmock/gmock.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace fs = std::filesystem;
using namespace patina;
using testing::ElementsAre;
using testing::IsEmpty;

namespace {

Bytes bytes(std::string_view text) {
    const auto view = std::as_bytes(std::span(text));
    return {view.begin(), view.end()};
}

class AtomicFolderTest : public ::testing::Test {
  protected:
    Result<void> write(const fs::path& folder, const std::vector<FolderFile>& files,
                       bool mayReplace = false) {
        return writeFolderAtomically(
            folder, files, [=](const fs::path&) { return mayReplace; },
            [this] { return m_looks++ >= m_cancelAt; });
    }
    static std::vector<std::string> contents(const fs::path& folder) {
        std::vector<std::string> names;
        for (const auto& entry : fs::directory_iterator(folder))
            names.push_back(entry.path().filename().string());
        std::sort(names.begin(), names.end());
        return names;
    }

    const test::TemporaryFolder m_around;
    const std::vector<FolderFile> m_files = {{"a.txt", bytes("one")}, {"b.txt", bytes("two")}};
    int m_looks = 0, m_cancelAt = 1 << 30;
};

TEST_F(AtomicFolderTest, AppearsWithExactlyItsFiles) {
    ASSERT_TRUE(write(m_around / "out", m_files).ok());
    EXPECT_THAT(contents(m_around / "out"), ElementsAre("a.txt", "b.txt"));
    EXPECT_EQ(readTextFile(m_around / "out" / "b.txt", 100).value(), "two");
    EXPECT_THAT(m_around.files(), ElementsAre("out"));
    const fs::perms allowed = fs::status(m_around / "out" / "a.txt").permissions();
    EXPECT_NE(allowed & fs::perms::owner_read, fs::perms::none);
}

TEST_F(AtomicFolderTest, ANameAloneLiesInTheCurrentFolder) {
    const fs::path before = fs::current_path();
    fs::current_path(m_around.path());
    const Result<void> written = write("out", m_files);
    fs::current_path(before);
    ASSERT_TRUE(written.ok()) << written.error().text();
    EXPECT_THAT(contents(m_around / "out"), ElementsAre("a.txt", "b.txt"));
}

TEST_F(AtomicFolderTest, TakesANameWithASlashAndAnEmptyFolder) {
    fs::create_directory(m_around / "out");
    ASSERT_TRUE(write(m_around / "out/", m_files).ok());
    EXPECT_THAT(contents(m_around / "out"), ElementsAre("a.txt", "b.txt"));
    EXPECT_THAT(m_around.files(), ElementsAre("out"));
}

TEST_F(AtomicFolderTest, ReplacesOnlyWhatItMay) {
    fs::create_directory(m_around / "out");
    m_around.write("out/holiday.jpg", "precious");
    const Result<void> refused = write(m_around / "out", m_files);
    ASSERT_FALSE(refused.ok());
    EXPECT_EQ(refused.error().kind, ErrorKind::CannotCreate);
    EXPECT_EQ(refused.error().file, m_around / "out");
    EXPECT_THAT(contents(m_around / "out"), ElementsAre("holiday.jpg"));

    ASSERT_TRUE(write(m_around / "out", m_files, true).ok());
    EXPECT_THAT(contents(m_around / "out"), ElementsAre("a.txt", "b.txt"));
    EXPECT_THAT(m_around.files(), ElementsAre("out")) << "nothing of the old one is left";
}

TEST_F(AtomicFolderTest, FollowsALink) {
    fs::create_directory(m_around / "real");
    fs::create_directory_symlink(m_around / "real", m_around / "link");
    ASSERT_TRUE(write(m_around / "link", m_files).ok());
    EXPECT_TRUE(fs::is_symlink(m_around / "link"));
    EXPECT_THAT(contents(m_around / "real"), ElementsAre("a.txt", "b.txt"));
}

TEST_F(AtomicFolderTest, RefusesWhatCannotBe) {
    m_around.write("file", "x");
    for (const fs::path& path : {m_around / "file", m_around / "missing/out", m_around / "file/out",
                                 fs::path("/proc/out")}) {
        const Result<void> refused = write(path, m_files);
        ASSERT_FALSE(refused.ok()) << path;
        EXPECT_EQ(refused.error().kind, ErrorKind::CannotCreate) << path;
        EXPECT_EQ(refused.error().file, path);
    }
    EXPECT_THAT(m_around.files(), ElementsAre("file"));
}

TEST_F(AtomicFolderTest, ACancelLeavesNothingWhenEverItComes) {
    int looks = 0;
    for (m_cancelAt = 0;; ++m_cancelAt) {
        m_looks = 0;
        const Result<void> result = write(m_around / "out", m_files);
        if (result.ok())
            break;
        EXPECT_EQ(result.error().kind, ErrorKind::Cancelled);
        EXPECT_THAT(m_around.files(), IsEmpty());
        ++looks;
    }
    EXPECT_GE(looks, 2);
    EXPECT_THAT(m_around.files(), ElementsAre("out"));
}

// A limit on file sizes stands in for a full disk.
TEST_F(AtomicFolderTest, AFailedWriteLeavesTheOldFolder) {
    ASSERT_TRUE(write(m_around / "out", m_files).ok());
    const pid_t child = ::fork();
    if (child == 0) {
        ::signal(SIGXFSZ, SIG_IGN);
        const rlimit limit{1000, 1000};
        ::setrlimit(RLIMIT_FSIZE, &limit);
        const Result<void> result =
            write(m_around / "out", {{"a.txt", bytes("new")}, {"big", Bytes(5000)}}, true);
        ::_exit(!result.ok() && result.error().kind == ErrorKind::Io ? 0 : 1);
    }
    int status = -1;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    EXPECT_EQ(status, 0);
    EXPECT_THAT(m_around.files(), ElementsAre("out"));
    EXPECT_EQ(readTextFile(m_around / "out" / "a.txt", 100).value(), "one");
}

} // namespace
