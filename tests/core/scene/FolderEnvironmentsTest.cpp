// Which files of a folder are environments.
#include "core/scene/FolderEnvironments.h"

#include "tests/support/TemporaryFolder.h"

#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <string>
#include <vector>

namespace patina {
namespace {

namespace fs = std::filesystem;

void touch(const fs::path& file) {
    std::ofstream(file) << "not read";
}

} // namespace

TEST(FolderEnvironments, AreItsHdrAndExrByNameAndOfSixFacesTheFirstAlone) {
    const test::TemporaryFolder folder;
    for (const char* name : {"b.exr", "A.HDR", "notes.txt", "room_px.hdr", "room_nx.hdr",
                             "room_py.hdr", "room_ny.hdr", "room_pz.hdr", "room_nz.hdr",
                             // the first face is missing: what reads this one says so
                             "half_nx.hdr"})
        touch(folder.path() / name);
    fs::create_directory(folder.path() / "inner.hdr");
    touch(folder.path() / "inner.hdr" / "c.hdr");
    const Result<std::vector<fs::path>> files = environmentFilesOf(folder.path());
    ASSERT_TRUE(files.ok());
    std::vector<std::string> names;
    for (const fs::path& file : *files) {
        EXPECT_EQ(file.parent_path(), folder.path());
        names.push_back(file.filename());
    }
    EXPECT_THAT(names, testing::ElementsAre("A.HDR", "b.exr", "half_nx.hdr", "room_px.hdr"));
}

TEST(FolderEnvironments, NoFolderAndOneWithoutEnvironmentsAreErrors) {
    const test::TemporaryFolder folder;
    touch(folder.path() / "notes.txt");
    const Result<std::vector<fs::path>> empty = environmentFilesOf(folder.path());
    ASSERT_FALSE(empty.ok());
    EXPECT_EQ(empty.error().kind, ErrorKind::Usage);
    const Result<std::vector<fs::path>> gone = environmentFilesOf(folder.path() / "gone");
    ASSERT_FALSE(gone.ok());
    EXPECT_EQ(gone.error().kind, ErrorKind::InputMissing);
}

} // namespace patina
