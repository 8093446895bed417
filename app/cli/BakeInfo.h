// What `patina info` says about a bake.
#pragma once

#include "app/cli/Report.h"
#include "core/bake/domain/BakeArtifact.h"
#include "core/io/ImageIO.h"

namespace patina::cli {

[[nodiscard]] const char* kindText(BakeKind kind); // "radiance transfer per vertex"

// Adds "bake" to the report: what the file holds, from which settings, part by part.
// Errors: InputBroken for files that no scene would take.
Result<void> describeBake(Report& report, const std::vector<ImagePart>& parts,
                          const std::filesystem::path& file);

// The same of a checkpoint, or of the part that a shard computed. Errors: those of
// readBakeManifest().
Result<void> describeUnfinishedBake(Report& report, const std::filesystem::path& file);

} // namespace patina::cli
