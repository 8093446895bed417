// Opening what may be no file at all. A call that waits makes the test run out of time.
#include "core/base/InputFile.h"

#include "core/base/AtomicFile.h"
#include "tests/support/TemporaryFolder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

namespace patina {
namespace {

using testing::HasSubstr;

TEST(InputFile, PipesAndDevicesAreRefusedWithoutWaiting) {
    const test::TemporaryFolder folder;
    const std::string pipe = folder / "pipe";
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    std::filesystem::create_symlink(pipe, folder / "link");
    for (const std::string& name : {pipe, (folder / "link").string(), std::string("/dev/zero")}) {
        for (const Error& error :
             {openRegularFile(name).error(), openInputFile(name, 1 << 20).error(),
              readFile(name, 1 << 20).error(), readTextFile(name, 1 << 20).error()}) {
            EXPECT_EQ(error.kind, ErrorKind::InputMissing) << name;
            EXPECT_THAT(error.message, HasSubstr("a pipe or a device"));
        }
    }
}

TEST(InputFile, SaysWhatIsWrong) {
    const test::TemporaryFolder folder;
    EXPECT_THAT(openRegularFile(folder / "none").error().message, HasSubstr("does not exist"));
    EXPECT_THAT(openRegularFile(folder.path()).error().message, HasSubstr("a folder"));
    const auto empty = folder.write("empty", std::string_view());
    EXPECT_TRUE(openRegularFile(empty).ok());
    EXPECT_THAT(openInputFile(empty, 10).error().message, HasSubstr("empty"));
    const auto large = folder.write("large", std::string_view("12345678901"));
    EXPECT_THAT(openInputFile(large, 10).error().message, HasSubstr("larger"));
    EXPECT_THAT(readFile(large, 10).error().message, HasSubstr("larger"));
    const std::string pointer = "version https://git-lfs.github.com/spec/v1\noid sha256:4d7a\n"
                                "size 12345\n";
    const auto notThere = folder.write("model.glb", pointer);
    EXPECT_THAT(openInputFile(notThere, 1000).error().message, HasSubstr("git lfs pull"));
    EXPECT_TRUE(
        openInputFile(folder.write("long.txt", pointer + std::string(1024, ' ')), 2000).ok())
        << "a text about such files";
}

TEST(InputFile, OpensFilesAndReadsTheirBeginning) {
    const test::TemporaryFolder folder;
    const auto file = folder.write("file", std::string(100, 'a'));
    const Result<InputFile> opened = openInputFile(file, 1000);
    ASSERT_TRUE(opened.ok()) << opened.error().text();
    EXPECT_EQ(opened->size, 100u);
    EXPECT_EQ(opened->head, std::string(64, 'a'));
    EXPECT_EQ(readTextFile(file, 100).value(), std::string(100, 'a'));
}

} // namespace
} // namespace patina
