// Where the pictures of a sequence go: numbered files, or one video.
#pragma once

#include "core/base/Result.h"
#include "core/image/Image.h"
#include "core/io/ImageIO.h"
#include "core/job/JobContext.h"

#include <filesystem>
#include <memory>
#include <optional>

namespace patina {

class VideoWriter;

struct SequenceOutput {
    std::filesystem::path file; // its extension says whether it is a video: isVideoFile()
    int width = 0, height = 0;  // of each picture
    int framesPerSecond = 24;   // of a video
    bool transparent = false;   // pictures keep their alpha; a video has none
};

class SequenceWriter {
  public:
    // `worker` outlives it. Errors: those of VideoWriter::create() and imageFormatForPath().
    static Result<std::unique_ptr<SequenceWriter>> create(WorkerClient& worker,
                                                          const SequenceOutput& output);
    ~SequenceWriter(); // without finish(): pictures that were written stay, of a video nothing does

    // Pictures are to be linear, as before the tone curve; else as displayed.
    [[nodiscard]] bool isLinear() const;
    // RGBA, the next one. Its file, once that is written; nothing for a video. Errors: those of
    // encodeImage() with the file, of writeFileAtomically() and VideoWriter::add().
    Result<std::optional<std::filesystem::path>> add(Image picture, const JobContext& job);
    // Errors: those of VideoWriter::finish().
    Result<void> finish(const JobContext& job);
    [[nodiscard]] int written() const { return m_written; } // files of pictures

  private:
    SequenceWriter(WorkerClient& worker, SequenceOutput output);

    WorkerClient& m_worker;
    SequenceOutput m_output;
    ImageFileFormat m_format = ImageFileFormat::Png; // of pictures
    std::unique_ptr<VideoWriter> m_video;            // null: numbered files
    int m_written = 0;
};

} // namespace patina
