#include "core/base/FileLock.h"
#include "tests/support/TemporaryFolder.h"

#include <chrono>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <optional>
#include <sys/stat.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace fs = std::filesystem;
using namespace patina;
using ::testing::HasSubstr;

namespace {

class FileLockTest : public ::testing::Test {
  protected:
    [[nodiscard]] std::size_t entries() const {
        return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), {}));
    }
    const test::TemporaryFolder temporary;
    const fs::path folder = temporary.path();
    const fs::path file = folder / "a.exr";
};

TEST_F(FileLockTest, IsHeldOnceAndLeavesNothing) {
    {
        const Result<FileLock> first = FileLock::take(file);
        ASSERT_TRUE(first.ok()) << first.error().text();
        const Result<FileLock> second = FileLock::take(file);
        ASSERT_FALSE(second.ok());
        EXPECT_EQ(second.error().kind, ErrorKind::CannotCreate);
        EXPECT_EQ(second.error().file, file);
        EXPECT_THAT(second.error().message, HasSubstr(std::to_string(::getpid())));
        EXPECT_TRUE(FileLock::take(folder / "b.exr").ok()) << "other files are free";
        EXPECT_FALSE(FileLock::take(file).ok()) << "a refusal does not free the first";
    }
    EXPECT_EQ(entries(), 0u);
    EXPECT_TRUE(FileLock::take(file).ok());
}

TEST_F(FileLockTest, MovesWithItsOwner) {
    Result<FileLock> taken = FileLock::take(file);
    ASSERT_TRUE(taken.ok());
    {
        const FileLock moved = std::move(taken).value();
        EXPECT_FALSE(FileLock::take(file).ok());
    }
    EXPECT_TRUE(FileLock::take(file).ok());
}

TEST_F(FileLockTest, EndsWithItsProcess) {
    int ready[2];
    ASSERT_EQ(::pipe(ready), 0);
    const pid_t child = ::fork();
    if (child == 0) {
        const Result<FileLock> held = FileLock::take(file);
        const char answer = held.ok() ? 'y' : 'n';
        if (::write(ready[1], &answer, 1) == 1)
            ::pause();
        ::_exit(1);
    }
    char answer = 'n';
    ASSERT_EQ(::read(ready[0], &answer, 1), 1);
    EXPECT_EQ(answer, 'y');
    const Result<FileLock> refused = FileLock::take(file);
    ASSERT_FALSE(refused.ok());
    EXPECT_THAT(refused.error().message, HasSubstr(std::to_string(child)));
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    EXPECT_TRUE(FileLock::take(file).ok());
    EXPECT_EQ(entries(), 0u) << "what the killed process left was taken over";
    ::close(ready[0]);
    ::close(ready[1]);
}

// Links and files that somebody put where the lock goes are neither followed nor emptied.
TEST_F(FileLockTest, TouchesNothingThatIsNoLock) {
    const fs::path victim = folder / "victim", lock = folder / ".a.exr.lock";
    std::ofstream(victim) << "precious";
    const auto expectRefused = [&](const char* what) {
        const Result<FileLock> taken = FileLock::take(file);
        ASSERT_FALSE(taken.ok()) << what;
        EXPECT_EQ(taken.error().kind, ErrorKind::CannotCreate) << what;
        EXPECT_THAT(taken.error().message, HasSubstr(".a.exr.lock")) << what;
        EXPECT_EQ(fs::file_size(victim), 8u) << what;
        EXPECT_TRUE(fs::exists(fs::symlink_status(lock))) << what;
        fs::remove(lock);
    };
    fs::create_symlink(victim, lock);
    expectRefused("a link");
    fs::create_hard_link(victim, lock);
    expectRefused("a second name");
    fs::copy_file(victim, lock);
    expectRefused("a file that says something");
    ASSERT_EQ(::mkfifo(lock.c_str(), 0600), 0);
    expectRefused("a pipe");
    EXPECT_TRUE(FileLock::take(file).ok());
}

TEST_F(FileLockTest, WhoWaitsGetsItWhenItIsFree) {
    std::optional<FileLock> first;
    first.emplace(FileLock::take(file).value());
    const auto impatient = FileLock::takeWhenFree(file, std::chrono::milliseconds(1));
    ASSERT_FALSE(impatient.ok());
    EXPECT_THAT(impatient.error().message, HasSubstr(std::to_string(::getpid())));
    bool locked = false;
    std::thread waiting([&] {
        const auto patient = FileLock::takeWhenFree(file, std::chrono::minutes(1));
        locked = patient.ok() && patient.value().has_value();
    });
    first.reset();
    waiting.join();
    EXPECT_TRUE(locked);
    // Where nobody can lock it is for the writer to fail, or not.
    const auto none = FileLock::takeWhenFree(folder / "no" / "a.exr", std::chrono::minutes(1));
    ASSERT_TRUE(none.ok());
    EXPECT_FALSE(none.value().has_value());
}

TEST_F(FileLockTest, NeedsAFolder) {
    const Result<FileLock> lock = FileLock::take(folder / "no" / "a.exr");
    ASSERT_FALSE(lock.ok());
    EXPECT_EQ(lock.error().kind, ErrorKind::CannotCreate);
}

} // namespace
