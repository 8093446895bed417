// Where the commands keep what takes long to compute, for the next time.
#pragma once

#include "core/radiosity/file/SolutionCache.h"

#include <filesystem>
#include <optional>

namespace patina::cli {

// The folder in the environment variable `variable`; where that is not set, the one in which the
// editor keeps it, too: ~/.cache/Patina/Patina/NAME. Empty: nowhere.
[[nodiscard]] std::filesystem::path cacheFolder(const char* variable, const char* name);

// Of PATINA_RADIOSITY_CACHE; nothing where that is empty.
[[nodiscard]] std::optional<radiosity::SolutionCache> radiosityCache();

} // namespace patina::cli
