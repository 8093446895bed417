// Pictures that follow each other as a video, encoded by the external program ffmpeg where it is
// installed: Patina links no encoder. The file is there in full at the end, or not at all.
#pragma once

#include "core/base/FileDescriptor.h"
#include "core/base/Result.h"
#include "core/image/Image.h"
#include "core/job/JobContext.h"

#include <filesystem>
#include <memory>
#include <string>
#include <sys/types.h>

namespace patina {

inline constexpr int kMostVideoRate = 240; // pictures per second

// .mp4 (H.264) or .webm (VP9).
[[nodiscard]] bool isVideoFile(const std::filesystem::path& file);

// Where ffmpeg is, by PATH. Error: InputMissing, with what to do.
[[nodiscard]] Result<std::filesystem::path> videoProgram();

class VideoWriter {
  public:
    // All pictures are of this size; sides that are odd gain a row or column, which the formats ask
    // for. Errors: Usage for another ending or rate, InputMissing without ffmpeg, Internal.
    static Result<std::unique_ptr<VideoWriter>> create(const std::filesystem::path& file, int width,
                                                       int height, int framesPerSecond);
    ~VideoWriter(); // without finish(): ffmpeg is ended, nothing is written
    VideoWriter(const VideoWriter&) = delete;
    VideoWriter& operator=(const VideoWriter&) = delete;

    // 8-bit sRGB of 3 channels. Waits while ffmpeg has enough to do. Errors: Internal with what
    // ffmpeg said, when it ended early; Cancelled.
    Result<void> add(const Image& picture, const JobContext& job = {});
    // Waits for ffmpeg and writes the file. Errors: as add(), those of writeFileAtomically().
    Result<void> finish(const JobContext& job = {});

  private:
    VideoWriter() = default;
    [[nodiscard]] Error failure(); // once ffmpeg has ended
    void end();                    // kills it, if it still runs

    std::filesystem::path m_file;
    int m_width = 0, m_height = 0;
    pid_t m_pid = -1;
    int m_status = 0; // of waitpid(), once it has ended
    FileDescriptor m_pictures, m_video, m_messages;
};

} // namespace patina
