// Videos through a program called ffmpeg that does what each test says.
#include "core/io/VideoWriter.h"
#include "core/base/AtomicFile.h"
#include "tests/support/TemporaryFolder.h"

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <thread>

namespace patina {
namespace {

using testing::HasSubstr;

class VideoWriterTest : public testing::Test {
  protected:
    VideoWriterTest() {
        m_path = std::getenv("PATH");
        setenv("PATH", (folder.path().string() + ":" + m_path).c_str(), 1);
    }
    ~VideoWriterTest() override { setenv("PATH", m_path.c_str(), 1); }

    void installFfmpeg(const std::string& script) const {
        std::ofstream(folder / "ffmpeg") << "#!/bin/sh\n" << script << "\n";
        std::filesystem::permissions(folder / "ffmpeg", std::filesystem::perms::owner_all);
    }
    static Image picture(std::uint8_t value, int width = 4, int height = 3) {
        Image image(width, height, 3, PixelType::U8, ColorEncoding::Srgb);
        std::ranges::fill(image.u8(), value);
        return image;
    }

    test::TemporaryFolder folder;

  private:
    std::string m_path;
};

TEST_F(VideoWriterTest, HandsOverEachPictureAndWritesWhatComesBack) {
    // What it was told, then the pictures as they came.
    installFfmpeg("for last in \"$@\"; do :; done\necho \"$@\" > \"$last\"\ncat >> \"$last\"");
    const std::filesystem::path file = folder / "turn.mp4";
    Result<std::unique_ptr<VideoWriter>> writer = VideoWriter::create(file, 4, 3, 25);
    ASSERT_TRUE(writer) << writer.error().text();
    for (const std::uint8_t value : {65, 66, 67})
        ASSERT_TRUE((*writer)->add(picture(value)));
    EXPECT_FALSE(std::filesystem::exists(file)) << "in full or not at all";
    ASSERT_TRUE((*writer)->finish());
    const Result<std::string> written = readTextFile(file, 1 << 20);
    ASSERT_TRUE(written);
    EXPECT_THAT(*written, HasSubstr("rgb24 -video_size 4x3 -framerate 25"));
    EXPECT_THAT(*written, HasSubstr("libx264"));
    EXPECT_TRUE(
        written->ends_with(std::string(36, 'A') + std::string(36, 'B') + std::string(36, 'C')));
    EXPECT_EQ(folder.files(), (std::vector<std::string>{"ffmpeg", "turn.mp4"}));
}

TEST_F(VideoWriterTest, WhatFailsMidwayLeavesNoFileAndSaysWhy) {
    installFfmpeg("head -c 20 > /dev/null\necho 'Unknown encoder libx264' >&2\nexit 1");
    Result<std::unique_ptr<VideoWriter>> writer =
        VideoWriter::create(folder / "turn.mp4", 256, 256, 24);
    ASSERT_TRUE(writer);
    Result<void> result;
    for (int i = 0; i < 1000 && result; ++i) // until it is noticed
        result = (*writer)->add(picture(7, 256, 256));
    ASSERT_FALSE(result);
    EXPECT_THAT(result.error().text(), HasSubstr("Unknown encoder libx264"));
    EXPECT_THAT(result.error().message, HasSubstr("numbered pictures"));
    EXPECT_FALSE(std::filesystem::exists(folder / "turn.mp4"));
}

TEST_F(VideoWriterTest, AFailureAtTheEndKeepsTheOldFile) {
    installFfmpeg("cat > /dev/null\nexit 3");
    std::ofstream(folder / "turn.webm") << "old";
    Result<std::unique_ptr<VideoWriter>> writer =
        VideoWriter::create(folder / "turn.webm", 4, 3, 24);
    ASSERT_TRUE(writer);
    ASSERT_TRUE((*writer)->add(picture(1)));
    EXPECT_FALSE((*writer)->finish());
    EXPECT_EQ(*readTextFile(folder / "turn.webm", 100), "old");
}

TEST_F(VideoWriterTest, AnAbandonedOneEndsItsProgram) {
    const std::filesystem::path note = folder / "pid";
    installFfmpeg("echo $$ > '" + note.string() + ".part'; mv '" + note.string() + ".part' '" +
                  note.string() + "'\nexec sleep 1000");
    pid_t program = 0;
    {
        Result<std::unique_ptr<VideoWriter>> writer =
            VideoWriter::create(folder / "turn.mp4", 4, 3, 24);
        ASSERT_TRUE(writer);
        ASSERT_TRUE((*writer)->add(picture(1)));
        while (!std::filesystem::exists(note))
            std::this_thread::yield();
        std::ifstream(note) >> program;
        ASSERT_EQ(kill(program, 0), 0);
    } // does not wait for it
    EXPECT_NE(kill(program, 0), 0);
    EXPECT_FALSE(std::filesystem::exists(folder / "turn.mp4"));
}

TEST_F(VideoWriterTest, ACancelIsNoticedWhileItsProgramTakesItsTime) {
    installFfmpeg("exec sleep 1000"); // takes nothing, and does not end
    JobControl control;
    Result<std::unique_ptr<VideoWriter>> writer =
        VideoWriter::create(folder / "turn.mp4", 1024, 1024, 24);
    ASSERT_TRUE(writer);
    std::thread cancels([&] { control.cancel(); });
    const Result<void> added = (*writer)->add(picture(1, 1024, 1024), control.context());
    cancels.join();
    ASSERT_FALSE(added);
    EXPECT_EQ(added.error().kind, ErrorKind::Cancelled);

    JobControl last;
    writer = VideoWriter::create(folder / "turn.mp4", 4, 3, 24);
    ASSERT_TRUE(writer);
    ASSERT_TRUE((*writer)->add(picture(1), last.context()));
    last.cancel();
    const Result<void> finished = (*writer)->finish(last.context());
    ASSERT_FALSE(finished);
    EXPECT_EQ(finished.error().kind, ErrorKind::Cancelled);
    EXPECT_FALSE(std::filesystem::exists(folder / "turn.mp4"));
}

TEST_F(VideoWriterTest, SaysWhatIsMissing) {
    setenv("PATH", folder.path().c_str(), 1);
    const auto without = VideoWriter::create(folder / "turn.mp4", 4, 3, 24);
    ASSERT_FALSE(without);
    EXPECT_THAT(without.error().message, HasSubstr("ffmpeg, which is not installed"));
    installFfmpeg("exit 0");
    EXPECT_FALSE(VideoWriter::create(folder / "turn.avi", 4, 3, 24));
    EXPECT_FALSE(VideoWriter::create(folder / "turn.mp4", 4, 3, 0));
    EXPECT_EQ(*videoProgram(), folder / "ffmpeg");
}

} // namespace
} // namespace patina
