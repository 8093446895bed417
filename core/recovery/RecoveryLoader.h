// Makes a document of unsaved work. Reads the user's files and writes none.
#pragma once

#include "core/recovery/RecoveryRecord.h"
#include "core/scene/Scene.h"

namespace patina {

class WorkerClient;

// `bakeFolder`: RecoverySession::bakeFolder(). What is missing (models, textures, bakes) becomes a
// notice, as in openScene(); what was left out when the record was written, too. Errors:
// InputBroken, Cancelled.
Result<OpenedScene> loadRecovered(WorkerClient& worker, const RecoveryRecord& record,
                                  const std::filesystem::path& bakeFolder,
                                  const JobContext& job = {});

// Whether the saved project is still what the unsaved work began with: only then saving may replace
// it without asking where.
[[nodiscard]] bool savedFileUnchanged(const RecoveryRecord& record);

} // namespace patina
