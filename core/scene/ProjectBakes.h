// The bakes beside a project, in NAME.bakes/. A file is named by what it holds, so that one that is
// there never changes: a project and the bakes it names are always of one version, and the step
// from one version to the next is the project file's.
#pragma once

#include "core/bake/domain/BakeArtifact.h"
#include "core/base/Result.h"

#include <filesystem>
#include <map>

namespace patina {

class WorkerClient;
struct Document;

namespace project {

// What the project's text calls each bake: absolute paths, by kind.
using BakeNames = std::map<BakeKind, std::string>;

// "chair.bakes" beside "chair.patina".
[[nodiscard]] std::filesystem::path bakeFolder(const std::filesystem::path& projectFile);

// Writes the document's bakes that are not there yet, synchronised; those that are stay untouched,
// and so does every other file. Absent ones keep the name they had.
Result<BakeNames> writeBakes(WorkerClient& worker, const Document& document,
                             const std::filesystem::path& projectFile);

// Removes bakes that the project does not name any more, and what killed processes left in the
// folder; then the folder when it is empty. What is not called like a bake stays.
void removeOldBakes(const std::filesystem::path& projectFile, const BakeNames& named);

} // namespace project
} // namespace patina
