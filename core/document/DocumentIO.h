// The .patina project: versioned JSON with paths relative to the file, keys from the parameter
// table. Attached bakes are stored beside it as EXR files in "<name>.bakes/".
#pragma once

#include "core/base/Result.h"
#include "core/document/Scene.h"

#include <filesystem>
#include <string>

namespace patina {

inline constexpr int kProjectVersion = 1;

// The JSON text of a project that will live in `folder`; does not touch the disk.
[[nodiscard]] std::string documentToJson(const Document& document,
                                         const std::filesystem::path& projectFile);

// Values only: every payload (mesh, image, bake) is still null. Errors: InputBroken naming the key
// and what was expected; unknown keys of newer versions are an error that says so.
Result<Document> documentFromJson(const std::string& json,
                                  const std::filesystem::path& projectFile);

// Saves the project and its bakes, each file atomically, the project last.
Result<void> saveProject(WorkerClient& worker, const Document& document,
                         const std::filesystem::path& projectFile);
Result<OpenedScene> loadProject(WorkerClient& worker, const std::filesystem::path& projectFile,
                                const JobContext& job = {});

} // namespace patina
