#include "core/base/FileLock.h"
#include "tests/support/TemporaryFolder.h"

#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
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

TEST_F(FileLockTest, NeedsAFolder) {
    const Result<FileLock> lock = FileLock::take(folder / "no" / "a.exr");
    ASSERT_FALSE(lock.ok());
    EXPECT_EQ(lock.error().kind, ErrorKind::CannotCreate);
}

} // namespace
