#include "app/editor/viewport/IblWork.h"

#include "core/base/Log.h"

#include <QFile>
#include <QStandardPaths>
#include <utility>

namespace patina::editor {
namespace {

constexpr IblSettings kFull;

} // namespace

std::filesystem::path iblCacheFolder() {
    const QString folder = QStandardPaths::writableLocation(QStandardPaths::CacheLocation);
    return std::filesystem::path(QFile::encodeName(folder).toStdString()) / "ibl";
}

Hash iblKey(const Image& environment) {
    return IblCache::key(environment, kFull);
}

Result<IblLight> firstIbl(const IblCache& cache, const ImagePtr& environment, const Hash& key,
                          const JobContext& job) {
    IblLight light;
    light.environment = environment;
    light.key = key;
    std::optional<IblMaps> found = cache.find(light.key);
    light.full = found.has_value();
    const Result<HalfMipmapsPtr> background = makeBackground(*environment, job);
    if (!background)
        return background.error();
    light.background = *background;
    Result<IblMaps> maps =
        found ? std::move(*found) : computeIbl(*environment, IblSettings::quick(), job);
    if (!maps)
        return maps.error();
    light.maps = std::make_shared<const IblMaps>(std::move(*maps));
    light.texels = std::make_shared<const EnvironmentTexels>(
        makeEnvironmentTexels(environment, *light.maps, light.background));
    return light;
}

Result<IblLight> refinedIbl(IblLight light, const JobContext& job) {
    Result<IblMaps> maps = computeIbl(*light.environment, kFull, job);
    if (!maps)
        return maps.error();
    light.maps = std::make_shared<const IblMaps>(std::move(*maps));
    light.texels = std::make_shared<const EnvironmentTexels>(
        makeEnvironmentTexels(light.environment, *light.maps, light.background));
    light.full = true;
    return light;
}

Result<IblLight> fullIblMaps(const IblCache& cache, const ImagePtr& environment,
                             const JobContext& job) {
    IblLight light;
    light.environment = environment;
    std::optional<IblMaps> found = cache.find(iblKey(*environment));
    Result<IblMaps> maps = found ? std::move(*found) : computeIbl(*environment, kFull, job);
    if (!maps)
        return maps.error();
    light.maps = std::make_shared<const IblMaps>(std::move(*maps));
    return light;
}

void keepIbl(TaskGroup& tasks, const IblCache& cache, const IblLight& full) {
    tasks.run(
        {.tag = "keeping image-based light",
         .policy = TaskPolicy::Exclusive,
         .priority = TaskPriority::Low},
        [&cache, key = full.key, maps = full.maps](const JobContext&) {
            return cache.store(key, *maps);
        },
        [](const Result<void>& stored) {
            if (!stored)
                logWarning("The light of this environment could not be kept for next time: {}",
                           stored.error().text());
        });
}

} // namespace patina::editor
