// One long bake of a scene into a file, as patina bake ao, prt and light share it: whole or a
// shard, with checkpoints, from the beginning or from where it was.
#pragma once

#include "app/cli/Options.h"
#include "app/cli/Session.h"
#include "core/bake/domain/BakeRequest.h"
#include "core/bake/domain/BakeStorage.h"
#include "core/document/Document.h"

#include <string>

namespace patina::cli {

struct SceneBake {
    std::string scene, output;
    LongBakeOptions work;
    BakeRequest request;
    BakeFileOptions storage = {};
    std::string environment = {}, environmentLayout = {}; // empty: the scene's own; guessed
};

// Opens the scene, bakes it as the request says and writes the output; what it did is in the
// report, whose "settings" the caller has filled in. Errors: Usage for options that exclude each
// other; CannotCreate when another process is baking into this file; those of the bake.
Result<void> bakeScene(Session& session, const SceneBake& bake);

// The report's "counts", "inputs" and "samplesDone".
void reportBake(Session& session, const BakeInputs& inputs, const BakeArtifact& artifact);

} // namespace patina::cli
