#include "app/cli/PreparedLight.h"

#include "core/base/Log.h"
#include "core/light/IblCache.h"

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <utility>

namespace patina::cli {

namespace {

namespace fs = std::filesystem;

std::optional<fs::path> variable(const char* name) {
    const char* value = std::getenv(name); // NOLINT(concurrency-mt-unsafe): nobody changes them
    return value ? std::optional<fs::path>(value) : std::nullopt;
}

// As QStandardPaths::CacheLocation has it for the editor. Empty: nowhere.
fs::path cacheFolder() {
    if (const auto named = variable("PATINA_LIGHT_CACHE"))
        return *named;
    const fs::path ours = "Patina/Patina/ibl";
    if (const auto cache = variable("XDG_CACHE_HOME"); cache && cache->is_absolute())
        return *cache / ours;
    const auto home = variable("HOME");
    return home && home->is_absolute() ? *home / ".cache" / ours : fs::path();
}

} // namespace

Result<IblMaps> prepareLight(const Image& environment, const JobContext& job) {
    const fs::path folder = cacheFolder();
    if (folder.empty())
        return computeIbl(environment, {}, job);
    const IblCache cache(folder);
    const Hash key = IblCache::key(environment, {});
    if (std::optional<IblMaps> found = cache.find(key))
        return std::move(*found);
    Result<IblMaps> computed = computeIbl(environment, {}, job);
    if (computed)
        if (const Result<void> stored = cache.store(key, *computed); !stored)
            logInfo("The light of this environment could not be kept for next time: {}",
                    stored.error().text());
    return computed;
}

} // namespace patina::cli
