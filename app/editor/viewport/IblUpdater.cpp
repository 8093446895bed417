#include "app/editor/viewport/IblUpdater.h"

#include "core/base/Log.h"
#include "core/light/Light.h"

#include <optional>

namespace patina::editor {
namespace {

constexpr const char* kFirst = "image-based light";
constexpr const char* kRefined = "image-based light in full";
constexpr const char* kMaps = "image-based light to look at";

} // namespace

IblUpdater::IblUpdater(TaskRunner& runner, PreparedLights& prepared, QObject* parent)
    : QObject(parent)
    , m_prepared(prepared)
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

// Light in no time, and, where that is not all, the rest: somebody waits for it, too, but frames
// under a moving hand go first.
void IblUpdater::prepare() {
    m_finished = false;
    m_tasks.cancel(kRefined);
    if (const std::optional<IblLight> known = m_prepared.known(m_environment)) {
        m_tasks.cancel(kFirst);
        return deliver(*known);
    }
    m_tasks.run(
        {.tag = kFirst, .policy = TaskPolicy::Follow, .priority = TaskPriority::High},
        [this, environment = m_environment](const JobContext& job) {
            return m_prepared.first(environment, job);
        },
        [this](const Result<IblLight>& light) {
            if (!light)
                return fail(light.error());
            if (!light->full && light->environment == m_environment)
                refine(*light);
            deliver(*light);
        });
}

void IblUpdater::refine(const IblLight& small) {
    m_tasks.run(
        {.tag = kRefined, .gate = m_gate},
        [todo = IblLight{small.environment, small.key, small.background, nullptr, nullptr, false}](
            const JobContext& job) { return refinedIbl(todo, job); },
        [this](const Result<IblLight>& light) {
            if (!light)
                return fail(light.error());
            m_prepared.keep(*light);
            keepIbl(m_tasks, m_prepared.disk(), *light);
            deliver(*light);
        });
}

void IblUpdater::requestMaps() {
    if (!m_environment || !m_finished || m_tasks.busy(kMaps))
        return; // they come with the light that is under way
    m_tasks.run(
        {.tag = kMaps},
        [this, environment = m_environment](const JobContext& job) {
            return fullIblMaps(m_prepared.disk(), environment, job);
        },
        [this](const Result<IblLight>& light) {
            if (!light)
                return fail(light.error());
            if (light->environment != m_environment)
                return; // its own are under way
            m_maps = light->maps;
            Q_EMIT mapsReady();
        });
}

void IblUpdater::fail(const Error& error) {
    if (error.kind != ErrorKind::Cancelled)
        logError("image-based light: {}", error.text());
    m_finished = !m_tasks.busy(kFirst);
}

void IblUpdater::deliver(const IblLight& light) {
    m_finished = light.full && light.environment == m_environment;
    m_texels = light.texels;
    m_maps = light.maps;
    Q_EMIT ready();
    Q_EMIT mapsReady();
}

} // namespace patina::editor
