// A bake as the editor's jobs do it: found in the cache, or gone on with from its checkpoint, or
// computed. A function of values, on any thread.
#pragma once

#include "app/editor/job/LivePreview.h"
#include "core/bake/document/BakeCache.h"
#include "core/bake/domain/BakeRequest.h"

#include <QString>
#include <atomic>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>

namespace patina::editor {

struct BakeWork {
    BakeRequest request;
    std::shared_ptr<const BakeInputs> inputs;
    std::shared_ptr<LivePreview> preview;
    BakeCache cache;
    std::filesystem::path checkpoints; // their folder
    // Whether the checkpoint outlives a cancel; asked when the bake has ended.
    std::shared_ptr<const std::atomic<bool>> resumable;
    // That no checkpoint is kept, from the job's thread; the bake goes on.
    std::function<void(const Error&)> warn;
};

struct BakeEnd {
    std::optional<Error> error;
    BakeArtifactPtr artifact;              // unless there was an error
    std::shared_ptr<const HitSource> hits; // of its rays, where light bounces; may be null
    QString summary;                       // also of an error, where something was kept
};

[[nodiscard]] BakeEnd runBake(const BakeWork& work, const JobContext& job);

[[nodiscard]] QString bakeSummary(const BakeArtifact& artifact); // "128 of 512 rays per vertex"

} // namespace patina::editor
