#include "core/cells/SequenceWriter.h"

#include "core/base/AtomicFile.h"
#include "core/cells/Sequence.h"
#include "core/image/Channels.h"
#include "core/io/VideoWriter.h"

#include <utility>
#include <vector>

namespace patina {

SequenceWriter::SequenceWriter(WorkerClient& worker, SequenceOutput output)
    : m_worker(worker)
    , m_output(std::move(output)) {}

SequenceWriter::~SequenceWriter() = default;

Result<std::unique_ptr<SequenceWriter>> SequenceWriter::create(WorkerClient& worker,
                                                               const SequenceOutput& output) {
    std::unique_ptr<SequenceWriter> writer(new SequenceWriter(worker, output));
    if (isVideoFile(output.file)) {
        Result<std::unique_ptr<VideoWriter>> video =
            VideoWriter::create(output.file, output.width, output.height, output.framesPerSecond);
        if (!video)
            return video.error();
        writer->m_video = std::move(*video);
        return writer;
    }
    const Result<ImageFileFormat> format = imageFormatForPath(output.file);
    if (!format)
        return format.error();
    writer->m_format = *format;
    return writer;
}

bool SequenceWriter::isLinear() const {
    return !m_video && isLinearFormat(m_format);
}

Result<std::optional<std::filesystem::path>> SequenceWriter::add(Image picture,
                                                                 const JobContext& job) {
    using File = std::optional<std::filesystem::path>;
    if (m_video) {
        const Result<void> added = m_video->add(withoutAlpha(picture), job);
        return added ? Result<File>(File()) : Result<File>(added.error());
    }
    std::vector<ImagePart> parts(1);
    parts[0].image = m_output.transparent ? std::move(picture) : withoutAlpha(picture);
    const std::filesystem::path file = sequenceFile(m_output.file, m_written);
    const Result<Bytes> bytes = encodeImage(m_worker, std::move(parts), m_format);
    if (!bytes) {
        Error error = bytes.error();
        error.file = file;
        return error;
    }
    if (const Result<void> saved = writeFileAtomically(file, *bytes); !saved)
        return saved.error();
    ++m_written;
    return File(file);
}

Result<void> SequenceWriter::finish(const JobContext& job) {
    return m_video ? m_video->finish(job) : Result<void>();
}

} // namespace patina
