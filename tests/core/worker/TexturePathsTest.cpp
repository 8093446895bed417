#include "core/io/TexturePaths.h"

#include "tests/support/TemporaryFolder.h"

#include <gtest/gtest.h>

namespace patina {
namespace {

class TexturePathsTest : public testing::Test {
  protected:
    TexturePathsTest() {
        folder.write("Wood.png", std::string_view("any"));
        folder.write("maps/stone.png", std::string_view("any"));
        folder.write("Textures/Rust.TGA", std::string_view("any"));
        folder.write("empty.png", std::string_view());
        folder.write("back\\slash.png", std::string_view("any"));
        std::filesystem::create_directory(folder.path() / "folder.png");
    }
    std::optional<std::filesystem::path> find(const std::string& name) {
        return TexturePaths(folder.path()).find(name);
    }
    test::TemporaryFolder folder;
};

TEST_F(TexturePathsTest, AsSpelled) {
    EXPECT_EQ(find("Wood.png"), folder.path() / "Wood.png");
    EXPECT_EQ(find("maps/stone.png"), folder.path() / "maps/stone.png");
    EXPECT_EQ(find("maps/../Wood.png"), folder.path() / "Wood.png");
    EXPECT_EQ(find((folder.path() / "maps/stone.png").string()), folder.path() / "maps/stone.png");
    EXPECT_EQ(TexturePaths(folder.path() / "maps").find("../Wood.png"), folder.path() / "Wood.png");
}

TEST_F(TexturePathsTest, BackslashesAndOtherCase) {
    EXPECT_EQ(find("maps\\stone.png"), folder.path() / "maps/stone.png");
    EXPECT_EQ(find("wood.PNG"), folder.path() / "Wood.png");
    EXPECT_EQ(find("back\\slash.png"), folder.path() / "back\\slash.png");
}

TEST_F(TexturePathsTest, FromAnotherComputer) {
    EXPECT_EQ(find("C:\\art\\wood.png"), folder.path() / "Wood.png");
    EXPECT_EQ(find("D:/x/y/rust.tga"), folder.path() / "Textures/Rust.TGA");
    EXPECT_EQ(find("/home/somebody/wood.png"), folder.path() / "Wood.png");
    EXPECT_EQ(find("//server/share/wood.png"), folder.path() / "Wood.png");
}

TEST_F(TexturePathsTest, InTheOnlyOtherFolderThatHasOne) {
    EXPECT_EQ(find("stone.png"), folder.path() / "maps/stone.png");
    EXPECT_EQ(find("C:\\art\\Stone.PNG"), folder.path() / "maps/stone.png");
    folder.write("others/stone.png", std::string_view("any"));
    EXPECT_FALSE(find("stone.png")) << "which one?";
}

TEST_F(TexturePathsTest, Latin1IsTakenForUtf8) {
    folder.write("h\u00f6lz \u2013 \u0161.png", std::string_view("any"));
    EXPECT_EQ(find("h\xf6lz \x96 \x9a.png"), folder.path() / "h\u00f6lz \u2013 \u0161.png");
    folder.write("h\xf6lz \x96 \x9a.png", std::string_view("any"));
    EXPECT_EQ(find("h\xf6lz \x96 \x9a.png"), folder.path() / "h\xf6lz \x96 \x9a.png");
}

TEST_F(TexturePathsTest, NothingToFind) {
    EXPECT_FALSE(find("gone.png"));
    EXPECT_FALSE(find("empty.png"));
    EXPECT_FALSE(find("folder.png"));
    EXPECT_FALSE(find(""));
    EXPECT_FALSE(find("https://example.org/Wood.png"));
    EXPECT_FALSE(TexturePaths("/nowhere").find("a.png"));
}

TEST_F(TexturePathsTest, WhereAMissingFileIsExpected) {
    const TexturePaths paths(folder.path());
    EXPECT_EQ(paths.expected("maps\\gone.png"), folder.path() / "maps/gone.png");
    EXPECT_EQ(paths.expected("C:\\art\\gone.png"), folder.path() / "gone.png");
}

} // namespace
} // namespace patina
