// One long bake of a scene into a file, as patina bake ao and patina bake prt share it: whole or a
// shard, with checkpoints, from the beginning or from where it was.
#pragma once

#include "app/cli/Options.h"
#include "app/cli/Session.h"
#include "core/bake/domain/BakeRequest.h"
#include "core/bake/domain/BakeStorage.h"
#include "core/document/Document.h"

#include <string>

namespace patina::cli {

// Opens `scene`, bakes it as `request` says and writes `output`; what it did is in the report,
// whose "settings" the caller has filled in. Errors: Usage for options that exclude each other;
// CannotCreate when another process is baking into this file; those of the bake.
Result<void> bakeScene(Session& session, const std::string& scene, const std::string& output,
                       const LongBakeOptions& options, const BakeRequest& request,
                       const BakeFileOptions& storage = {});

// The report's "counts", "inputs" and "samplesDone".
void reportBake(Session& session, const BakeInputs& inputs, const BakeArtifact& artifact);

} // namespace patina::cli
