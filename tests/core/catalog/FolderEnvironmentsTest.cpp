// The environments of a folder.
#include "core/scene/FolderEnvironments.h"

#include "tests/support/TemporaryFolder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

using namespace patina;
using testing::ElementsAre;

namespace fs = std::filesystem;

namespace {

class FolderEnvironmentsTest : public testing::Test {
  protected:
    std::vector<std::string> found(const FolderSearch& search = {}) {
        const Result<FolderEnvironments> result = environmentFilesOf(m_folder.path(), search);
        EXPECT_TRUE(result.ok());
        std::vector<std::string> names;
        if (result.ok()) {
            m_complete = result->complete;
            for (const fs::path& file : result->files)
                names.push_back(fs::relative(file, m_folder.path()).string());
        }
        return names;
    }

    test::TemporaryFolder m_folder;
    bool m_complete = true;
};

} // namespace

TEST_F(FolderEnvironmentsTest, ThoseOfTheFolderByName) {
    for (const char* name : {"b.hdr", "a.EXR", "c.png", "readme.txt", "below/d.hdr"})
        m_folder.write(name, "");
    fs::create_directory(m_folder / "folder.hdr");
    EXPECT_THAT(found(), ElementsAre("a.EXR", "b.hdr"));
    EXPECT_TRUE(m_complete);
}

TEST_F(FolderEnvironmentsTest, OfSixFacesTheFirst) {
    for (const char* face : {"px", "nx", "py", "ny", "pz", "nz"})
        m_folder.write(std::string("sky_") + face + ".hdr", "");
    m_folder.write("lone_nx.hdr", ""); // without its first face it stands for itself
    EXPECT_THAT(found(), ElementsAre("lone_nx.hdr", "sky_px.hdr"));
}

TEST_F(FolderEnvironmentsTest, FoldersBelowAsFarAsAsked) {
    for (const char* name : {"0.hdr", "1/1.hdr", "1/2/2.hdr", "1/2/3/3.hdr"})
        m_folder.write(name, "");
    EXPECT_THAT(found({.levels = 3}), ElementsAre("0.hdr", "1/1.hdr", "1/2/2.hdr"));
    EXPECT_THAT(found({.levels = 9}), ElementsAre("0.hdr", "1/1.hdr", "1/2/2.hdr", "1/2/3/3.hdr"));
}

TEST_F(FolderEnvironmentsTest, LinksToFoldersAreNotFollowed) {
    m_folder.write("in/a.hdr", "");
    fs::create_directory_symlink(m_folder.path(), m_folder / "in/again");
    EXPECT_THAT(found({.levels = 9}), ElementsAre("in/a.hdr"));
}

TEST_F(FolderEnvironmentsTest, NoMoreThanAsked) {
    for (int i = 0; i < 9; ++i)
        m_folder.write(std::to_string(i) + ".hdr", "");
    EXPECT_EQ(found({.mostFiles = 9}).size(), 9u);
    EXPECT_TRUE(m_complete);
    EXPECT_EQ(found({.mostFiles = 4}).size(), 4u);
    EXPECT_FALSE(m_complete);
    EXPECT_LE(found({.mostEntries = 5}).size(), 5u);
    EXPECT_FALSE(m_complete);
}

TEST_F(FolderEnvironmentsTest, AFolderThatIsNotThere) {
    const Result<FolderEnvironments> result = environmentFilesOf(m_folder / "gone");
    ASSERT_FALSE(result.ok());
    EXPECT_EQ(result.error().kind, ErrorKind::InputMissing);
    EXPECT_EQ(result.error().file, m_folder / "gone");
    EXPECT_FALSE(environmentFilesOf(m_folder.write("file.hdr", "")).ok());
}

TEST_F(FolderEnvironmentsTest, CanBeCancelled) {
    m_folder.write("a.hdr", "");
    JobControl control;
    control.cancel();
    const Result<FolderEnvironments> result =
        environmentFilesOf(m_folder.path(), {}, control.context());
    ASSERT_FALSE(result.ok());
    EXPECT_EQ(result.error().kind, ErrorKind::Cancelled);
}
