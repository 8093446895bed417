#include "core/base/AtomicFile.h"
#include "core/base/Leftovers.h"
#include "core/base/OwnFile.h"
#include "core/base/TemporaryName.h"
#include "tests/support/TemporaryFolder.h"

#include <algorithm>
#include <atomic>
#include <csignal>
#include <fcntl.h>
#include <fstream>
#include <gtest/gtest.h>
#include <set>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>
#include <vector>

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

// Two saves of one file at once, in this process: each is whole, none spoils the other.
TEST_F(AtomicFileTest, WritersOfOneFileDoNotDisturbEachOther) {
    const fs::path file = folder / "a.bin";
    std::atomic<int> failed = 0;
    std::vector<std::thread> writers;
    for (int writer = 0; writer < 4; ++writer)
        writers.emplace_back([&, writer] {
            for (int round = 0; round < 50; ++round)
                if (!writeFileAtomically(
                         file, std::string_view(std::string(5000, static_cast<char>('a' + writer))))
                         .ok())
                    ++failed;
        });
    for (std::thread& writer : writers)
        writer.join();
    EXPECT_EQ(failed, 0);
    const std::string text = readTextFile(file, 10'000).value();
    EXPECT_EQ(text, std::string(5000, text.at(0)));
    EXPECT_EQ(entries(), 1u);
}

TEST_F(AtomicFileTest, TemporaryNamesAreGivenOnce) {
    std::set<fs::path> names;
    for (int i = 0; i < 1000; ++i)
        names.insert(temporaryPath(folder / std::string(250, 'n')));
    EXPECT_EQ(names.size(), 1000u);
    for (const fs::path& name : names) {
        EXPECT_EQ(name.parent_path(), folder);
        EXPECT_LE(name.filename().string().size(), 255u);
        EXPECT_FALSE(isAbandoned(name.filename().string())) << "its process is alive";
    }
}

TEST_F(AtomicFileTest, OnlyWhatEndedProcessesOfThisMachineLeftIsRemoved) {
    const pid_t ended = ::fork();
    if (ended == 0) {
        std::ofstream(temporaryPath(folder / "a.bin")) << "half";
        ::_exit(0);
    }
    ::waitpid(ended, nullptr, 0);
    const std::string own = temporaryPath(folder / "a.bin").filename().string();
    const std::string other = own.substr(0, own.find('-') + 1) + "00000000" +
                              own.substr(own.find('-') + 9); // another host's
    const std::string older = ".a.bin." + std::to_string(ended) + ".part";
    for (const std::string& name : {own, other, older, std::string("a.bin"), std::string(".part")})
        std::ofstream(folder / name) << "x";
    removeLeftovers(folder / "b.bin");
    EXPECT_EQ(entries(), 6u) << "those of another file stay";
    removeLeftovers(folder / "a.bin");
    EXPECT_EQ(entries(), 4u);
    EXPECT_TRUE(fs::exists(folder / own));
    EXPECT_TRUE(fs::exists(folder / other));
    EXPECT_FALSE(fs::exists(folder / older));
}

// Somebody put a link where a file of ours goes: it would lead to a file of the user's.
TEST_F(AtomicFileTest, OwnFilesReplaceALinkAndDoNotFollowIt) {
    const fs::path victim = folder / "victim.txt", file = folder / "checkpoint";
    ASSERT_TRUE(writeFileAtomically(victim, std::string_view("precious")).ok());
    fs::create_symlink(victim, file);
    const std::string data = "ours";
    ASSERT_TRUE(writeOwnFile(file, std::as_bytes(std::span(data))).ok());
    EXPECT_EQ(readTextFile(victim, 100).value(), "precious");
    EXPECT_FALSE(fs::is_symlink(file));
    EXPECT_EQ(readTextFile(file, 100).value(), "ours");
    // A pipe would wait for a reader for ever.
    const fs::path pipe = folder / "pipe";
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    ASSERT_TRUE(writeOwnFile(pipe, std::as_bytes(std::span(data))).ok());
    EXPECT_TRUE(fs::is_regular_file(pipe));
}

TEST_F(AtomicFileTest, PipesTakeTheDataAndAreNotWaitedFor) {
    const fs::path pipe = folder / "pipe";
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    const Result<void> alone = writeFileAtomically(pipe, std::string_view("data"));
    ASSERT_FALSE(alone.ok());
    EXPECT_EQ(alone.error().kind, ErrorKind::CannotCreate);
    EXPECT_NE(alone.error().text().find("nothing reads"), std::string::npos);
    const int reader = ::open(pipe.c_str(), O_RDONLY | O_NONBLOCK);
    ASSERT_GE(reader, 0);
    ASSERT_TRUE(writeFileAtomically(pipe, std::string_view("data")).ok());
    char text[8] = {};
    EXPECT_EQ(::read(reader, text, sizeof text), 4);
    EXPECT_EQ(std::string_view(text), "data");
    ::close(reader);
    struct stat info {};
    ASSERT_EQ(::stat(pipe.c_str(), &info), 0);
    EXPECT_TRUE(S_ISFIFO(info.st_mode)) << "it is not replaced";
}

TEST_F(AtomicFileTest, OwnFoldersAreMadeOnceAndNeverLinks) {
    EXPECT_TRUE(makeOwnFolder(folder / "a").ok());
    EXPECT_TRUE(makeOwnFolder(folder / "a").ok());
    EXPECT_EQ(makeOwnFolder(folder / "no" / "b").error().kind, ErrorKind::CannotCreate);
    EXPECT_FALSE(fs::exists(folder / "no")) << "folders around it are the user's to make";
    fs::create_directory_symlink(folder / "a", folder / "link");
    EXPECT_EQ(makeOwnFolder(folder / "link").error().kind, ErrorKind::CannotCreate);
    ASSERT_TRUE(writeFileAtomically(folder / "file", std::string_view("x")).ok());
    EXPECT_EQ(makeOwnFolder(folder / "file").error().kind, ErrorKind::CannotCreate);
}

TEST_F(AtomicFileTest, ReadReportsMissingFoldersAndLargeFiles) {
    EXPECT_EQ(readFile(folder / "none", 10).error().kind, ErrorKind::InputMissing);
    EXPECT_EQ(readFile(folder, 10).error().kind, ErrorKind::InputMissing);
    ASSERT_TRUE(writeFileAtomically(folder / "a", std::string_view("12345678901")).ok());
    EXPECT_EQ(readFile(folder / "a", 10).error().kind, ErrorKind::InputBroken);
}

} // namespace
