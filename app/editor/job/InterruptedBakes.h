// Checkpoints that a crash, a quit or another document left behind: bakes that can go on.
#pragma once

#include "core/bake/domain/BakeRequest.h"
#include "core/bake/transfer/BakeCheckpoint.h"

#include <filesystem>
#include <vector>

namespace patina::editor {

struct InterruptedBake {
    std::filesystem::path file;
    BakeRequest request;
    double done = 0.0;                         // share of its rays, 0…1
    std::filesystem::file_time_type written{}; // when that was
};

// What a checkpoint of this bake must say to be gone on from.
[[nodiscard]] BakeManifest bakeManifest(const BakeRequest& request, const BakeInputs& inputs);

// Where its checkpoint is kept; `key`: BakeCache::key().
[[nodiscard]] std::filesystem::path checkpointFile(const std::filesystem::path& folder,
                                                   const Hash& key);

// Those in `folder` that belong to these inputs and that no bake writes now, of whichever process.
// Damaged ones, and those that nobody resumed for a month, are removed.
[[nodiscard]] std::vector<InterruptedBake> interruptedBakes(const std::filesystem::path& folder,
                                                            const BakeInputs& inputs);

// Errors: CannotCreate when a bake writes it now.
Result<void> removeCheckpoint(const std::filesystem::path& file);

} // namespace patina::editor
