#include "app/cli/PreparedLight.h"

#include "app/cli/CacheFolders.h"
#include "core/base/Log.h"
#include "core/light/IblCache.h"

#include <filesystem>
#include <optional>
#include <utility>

namespace patina::cli {

Result<IblMaps> prepareLight(const Image& environment, const JobContext& job) {
    const std::filesystem::path folder = cacheFolder("PATINA_LIGHT_CACHE", "ibl");
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
