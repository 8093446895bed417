#include "app/cli/CacheFolders.h"

#include <cstdlib>

namespace patina::cli {
namespace {

namespace fs = std::filesystem;

std::optional<fs::path> pathIn(const char* variable) {
    // NOLINTNEXTLINE(concurrency-mt-unsafe): nobody changes them
    const char* value = std::getenv(variable);
    return value ? std::optional<fs::path>(value) : std::nullopt;
}

} // namespace

// As QStandardPaths::CacheLocation has it for the editor.
fs::path cacheFolder(const char* variable, const char* name) {
    if (const auto named = pathIn(variable))
        return *named;
    const fs::path ours = fs::path("Patina/Patina") / name;
    if (const auto cache = pathIn("XDG_CACHE_HOME"); cache && cache->is_absolute())
        return *cache / ours;
    const auto home = pathIn("HOME");
    return home && home->is_absolute() ? *home / ".cache" / ours : fs::path();
}

std::optional<radiosity::SolutionCache> radiosityCache() {
    const fs::path folder = cacheFolder("PATINA_RADIOSITY_CACHE", "radiosity");
    return folder.empty() ? std::nullopt : std::optional<radiosity::SolutionCache>(folder);
}

} // namespace patina::cli
