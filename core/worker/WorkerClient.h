// The parent's side of the workers: small programs that decode untrusted files and may die doing
// so, one for models (patina-model-worker), one for images (patina-image-worker) and one for what
// only OpenImageIO and OpenColorIO read (patina-openimageio-worker). Each is started once, when it
// is first needed, forks for each request, and answers through a sealed memory file.
//
// Thread-safe: requests from several threads run in parallel children. A request never waits longer
// than limits::kWorkerWallSeconds; a dead, killed or silent child is an Error, and a dead worker is
// started again for the next request.
#pragma once

#include "core/base/Limits.h"
#include "core/base/Result.h"
#include "core/job/JobContext.h"
#include "core/worker/MemoryFile.h"

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace patina {

struct WorkerLimits {
    std::size_t memoryBytes; // address space of the child
    double cpuSeconds;
    double wallSeconds;
    std::size_t replyBytes = limits::kWorkerReplyBytes; // of the payload it may answer with
    bool landlock = true; // where the kernel has it; false shows what holds without
};

enum class WorkerKind { Model, Image, OpenImageIo };

struct WorkerPrograms {
    std::filesystem::path model, image, openImageIo;
};

class WorkerClient {
  public:
    // defaultPrograms() finds them beside the running executable, in ../bin beside it, where they
    // are installed (../libexec/patina), or in $PATINA_BIN_DIR. Nothing starts before the first
    // request or warmUp().
    explicit WorkerClient(WorkerPrograms programs = defaultPrograms());
    ~WorkerClient();
    WorkerClient(const WorkerClient&) = delete;
    WorkerClient& operator=(const WorkerClient&) = delete;

    static WorkerPrograms defaultPrograms();

    // Starts a process in the background, so that the first file does not wait.
    void warmUp(WorkerKind kind);
    void setLimits(const WorkerLimits& limits);

    // Pictures that a model names outside its own folder are read only where somebody has agreed to
    // it: for this model (a path), or for all of them. Kept as long as the client lives.
    void allowOutside(const std::filesystem::path& model);
    void allowOutsideOfAll();
    [[nodiscard]] bool outsideAllowed(const std::filesystem::path& model) const;

    // One request: `header` (JSON text) and an optional payload go out, `header` (JSON) and a
    // payload come back. The adapters in core/io give them meaning.
    struct Reply {
        std::string header;
        MemoryFile payload; // sealed: nobody changes it any more
    };
    Result<Reply> request(WorkerKind kind, const std::string& header,
                          std::span<const std::byte> payload,
                          const std::filesystem::path& fileForMessages);
    // The same with a payload that is in its place already.
    Result<Reply> request(WorkerKind kind, const std::string& header, MemoryFile payload,
                          const std::filesystem::path& fileForMessages);
    // The same with an open file as payload: the child reads it through the descriptor, which stays
    // the caller's. A cancelled job ends the child. Errors, too: Cancelled.
    // The child may read the other files in the folder of `readable` (insideCanonicalFolder()) and
    // below, and none when it is empty; `readable` itself, which may be a link, is the payload.
    Result<Reply> request(WorkerKind kind, const std::string& header, int payloadFd,
                          const std::filesystem::path& fileForMessages, const JobContext& job = {},
                          const std::filesystem::path& readable = {});

    // For tests and diagnosis: the process id of a worker (-1 when none runs) and those of the
    // children at work.
    [[nodiscard]] int workerProcess(WorkerKind kind) const;
    [[nodiscard]] std::vector<int> childProcesses() const;

  private:
    struct Impl;
    std::unique_ptr<Impl> m_impl;
};

// The file's own name, in its folder without links.
[[nodiscard]] std::filesystem::path insideCanonicalFolder(const std::filesystem::path& file);

} // namespace patina
