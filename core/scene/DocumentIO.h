// The .patina project: versioned JSON with paths relative to the file, keys from the parameter
// table. Attached bakes are stored beside it as EXR files in "<name>.bakes/" (ProjectBakes.h).
#pragma once

#include "core/base/Hash.h"
#include "core/base/Result.h"
#include "core/scene/Scene.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

namespace patina {

inline constexpr int kProjectVersion = 1;

// The JSON text of a project that will live in `folder`; does not touch the disk.
[[nodiscard]] std::string documentToJson(const Document& document,
                                         const std::filesystem::path& projectFile);

// Values only: every payload (mesh, image, bake) is still null. Errors: InputBroken naming the key
// and what was expected. Unknown keys of newer versions are kept (Document::unknownKeys): loading
// says which, saving writes them again beside those of elements that are still there. A newer
// kProjectVersion says that this is not enough, and is an error.
Result<Document> documentFromJson(const std::string& json,
                                  const std::filesystem::path& projectFile);

// Saves the project and its bakes in one step: bakes that are new get files of their own, the
// project's file is replaced, and then the bakes that it no longer names are removed. Whenever this
// ends early, the old project and all of its bakes are there. Two who save the same project do so
// one after the other. The folder must exist.
Result<void> saveProject(WorkerClient& worker, const Document& document,
                         const std::filesystem::path& projectFile);

// The same for a user who is there to be asked.
enum class SaveObstacle {
    None,       // saved, or failed for a reason that no answer changes
    FolderGone, // the project's folder was moved or removed; it is not made anew
    Changed,    // the file holds something else than what was last read or written here
    ReadOnly    // the file may not be written; its folder may
};
struct SaveTerms {
    std::optional<Hash> expected;   // what the file holds, unless others changed it
    bool mayReplaceReadOnly = true; // else that is an obstacle
};
struct SaveOutcome {
    std::optional<Error> error; // nothing was written; also says what the obstacle is
    SaveObstacle obstacle = SaveObstacle::None;
    Hash version; // of what was written, to be expected by the next save
};
[[nodiscard]] SaveOutcome saveProject(WorkerClient& worker, const Document& document,
                                      const std::filesystem::path& projectFile,
                                      const SaveTerms& terms);

// Of what the file holds now; nothing when it cannot be read.
[[nodiscard]] std::optional<Hash> projectVersion(const std::filesystem::path& projectFile);

// Pictures outside the project's folder are left out unless they were shown when this user saved it
// (saveProject() keeps which: OutsideGrants.h), or the user has agreed: to this project
// (WorkerClient::allowOutside()) or to all.
Result<OpenedScene> loadProject(WorkerClient& worker, const std::filesystem::path& projectFile,
                                const JobContext& job = {});
// The same of a text that need not be in that file. `mayShow`: whether it may show a file outside
// its folder; empty: those of outsideGrants().
Result<OpenedScene> loadProjectText(WorkerClient& worker, const std::string& json,
                                    const std::filesystem::path& projectFile,
                                    const JobContext& job = {},
                                    std::function<bool(const std::string& file)> mayShow = {});

} // namespace patina
