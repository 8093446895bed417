#include "app/editor/viewport/IblUpdater.h"

#include "core/base/Log.h"
#include "core/light/Light.h"

#include <QFile>
#include <QStandardPaths>

namespace patina::editor {
namespace {

constexpr IblSettings kFull;
constexpr const char* kFirst = "image-based light";
constexpr const char* kRefined = "image-based light in full";
constexpr const char* kMaps = "image-based light to look at";

} // namespace

std::filesystem::path iblCacheFolder() {
    const QString folder = QStandardPaths::writableLocation(QStandardPaths::CacheLocation);
    return std::filesystem::path(QFile::encodeName(folder).toStdString()) / "ibl";
}

IblUpdater::IblUpdater(TaskRunner& runner, const std::filesystem::path& cacheFolder,
                       QObject* parent)
    : QObject(parent)
    , m_cache(cacheFolder)
    , m_tasks(runner) {}

void IblUpdater::request(ImagePtr environment) {
    if (environment == m_environment || !environment)
        return;
    m_environment = std::move(environment);
    prepare();
}

void IblUpdater::renew() {
    if (m_environment && !m_texels && !m_tasks.busy(kFirst))
        prepare();
}

// Light in no time, and, where that is not all, the rest when nobody is in a hurry.
void IblUpdater::prepare() {
    m_finished = false;
    m_tasks.cancel(kRefined);
    m_tasks.run(
        {.tag = kFirst, .policy = TaskPolicy::Follow, .priority = TaskPriority::High},
        [this, environment = m_environment](const JobContext& job) {
            return first(m_cache, environment, job);
        },
        [this](const Result<Light>& light) {
            if (!light)
                return fail(light.error());
            if (!light->full && light->environment == m_environment)
                refine(*light);
            deliver(*light);
        });
}

Result<IblUpdater::Light> IblUpdater::first(const IblCache& cache, const ImagePtr& environment,
                                            const JobContext& job) {
    Light light;
    light.environment = environment;
    light.key = IblCache::key(*environment, kFull);
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

void IblUpdater::refine(const Light& small) {
    m_tasks.run(
        {.tag = kRefined, .priority = TaskPriority::Low},
        [todo = Light{small.environment, small.key, small.background, nullptr, nullptr, false}](
            const JobContext& job) { return refined(todo, job); },
        [this](const Result<Light>& light) {
            if (!light)
                return fail(light.error());
            keep(*light);
            deliver(*light);
        });
}

Result<IblUpdater::Light> IblUpdater::refined(Light light, const JobContext& job) {
    Result<IblMaps> maps = computeIbl(*light.environment, kFull, job);
    if (!maps)
        return maps.error();
    light.maps = std::make_shared<const IblMaps>(std::move(*maps));
    light.texels = std::make_shared<const EnvironmentTexels>(
        makeEnvironmentTexels(light.environment, *light.maps, light.background));
    light.full = true;
    return light;
}

void IblUpdater::requestMaps() {
    if (!m_environment || !m_finished || m_tasks.busy(kMaps))
        return; // they come with the light that is under way
    m_tasks.run(
        {.tag = kMaps},
        [this, environment = m_environment](const JobContext& job) -> Result<Light> {
            Light light;
            light.environment = environment;
            std::optional<IblMaps> found = m_cache.find(IblCache::key(*environment, kFull));
            Result<IblMaps> maps = found ? std::move(*found) : computeIbl(*environment, kFull, job);
            if (!maps)
                return maps.error();
            light.maps = std::make_shared<const IblMaps>(std::move(*maps));
            return light;
        },
        [this](const Result<Light>& light) {
            if (!light)
                return fail(light.error());
            if (light->environment != m_environment)
                return; // its own are under way
            m_maps = light->maps;
            Q_EMIT mapsReady();
        });
}

// The disk may take its time: nobody waits for it. What a drag passes over never comes here.
void IblUpdater::keep(const Light& full) {
    m_tasks.run(
        {.tag = "keeping image-based light",
         .policy = TaskPolicy::Exclusive,
         .priority = TaskPriority::Low},
        [this, key = full.key, maps = full.maps](const JobContext&) {
            return m_cache.store(key, *maps);
        },
        [](const Result<void>& stored) {
            if (!stored)
                logWarning("The light of this environment could not be kept for next time: {}",
                           stored.error().text());
        });
}

void IblUpdater::fail(const Error& error) {
    if (error.kind != ErrorKind::Cancelled)
        logError("image-based light: {}", error.text());
    m_finished = !m_tasks.busy(kFirst);
}

void IblUpdater::deliver(const Light& light) {
    m_finished = light.full && light.environment == m_environment;
    m_texels = light.texels;
    m_maps = light.maps;
    Q_EMIT ready();
    Q_EMIT mapsReady();
}

} // namespace patina::editor
