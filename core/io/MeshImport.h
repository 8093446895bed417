// Reading model files: glTF/GLB, OBJ, FBX, COLLADA, PLY, STL. Decoding happens in the isolated
// worker process (core/worker: OBJ, FBX and COLLADA through Assimp, the others by readers of our
// own); every size, index and number is validated before it is believed.
#pragma once

#include "core/base/Result.h"
#include "core/mesh/ImportedModel.h"
#include "core/mesh/ModelKeys.h"

#include <filesystem>
#include <string>
#include <vector>

namespace patina {

class WorkerClient;

// `visualScene`: title of the scene of a COLLADA file that is read (core/mesh/VisualScenes.h);
// empty: the one that the file names.
// Errors: Usage (there is no such scene); InputMissing; InputBroken (damaged, unsupported, no
// faces, beyond the limits, the importer died or ran out of time).
Result<ImportedModel> importModel(WorkerClient& worker, const std::filesystem::path& file,
                                  const std::string& visualScene = {});

// Whether each key of a glTF or GLB file is used, kept or left out: a row for each use and reason.
// Errors: as above.
Result<std::vector<ModelKey>> gltfKeys(WorkerClient& worker, const std::filesystem::path& file);

// The extensions importModel takes, with the dot, lower case.
[[nodiscard]] const std::vector<std::string>& modelExtensions();

} // namespace patina
