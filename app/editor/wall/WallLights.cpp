#include "app/editor/wall/WallLights.h"

#include "core/base/Log.h"

#include <algorithm>
#include <utility>

namespace patina::editor {
namespace {

constexpr const char* kTag = "light of the wall";

} // namespace

WallLights::WallLights(TaskRunner& runner, PreparedLights& lights, QObject* parent)
    : QObject(parent)
    , m_lights(lights)
    , m_tasks(runner) {}

bool WallLights::resolve(Document& shown, const Document& document) {
    bool complete = true;
    for (Environment& environment : shown.environments) {
        const EnvironmentRecipe recipe = environmentRecipe(environment);
        const Environment* linked = document.environment(environment.id);
        if (linked != nullptr && environmentRecipe(*linked) == recipe)
            continue;
        if (!isGenerated(recipe)) {
            environment.image = environment.fileImage;
            continue;
        }
        auto found = std::ranges::find(m_generated, recipe, &Generated::recipe);
        if (found == m_generated.end())
            found = m_generated.insert(m_generated.end(), {recipe, nullptr});
        found->wanted = true;
        environment.image = found->picture;
        complete = complete && found->picture != nullptr;
    }
    if (!complete) {
        startNext();
        return false;
    }
    const std::optional<EnvironmentBlend> blend = environmentBlend(shown);
    if (!blend) {
        shown.mix.blended = nullptr;
    } else if (blend != environmentBlend(document)) {
        auto found = std::ranges::find(m_blended, *blend, &Blended::blend);
        if (found == m_blended.end())
            found = m_blended.insert(m_blended.end(), {*blend, nullptr});
        found->wanted = true;
        shown.mix.blended = found->picture;
        complete = found->picture != nullptr;
    }
    startNext();
    return complete;
}

EnvironmentTexelsPtr WallLights::light(const ImagePtr& picture) {
    if (!picture)
        return nullptr;
    auto found = std::ranges::find(m_prepared, picture, &Prepared::picture);
    if (found == m_prepared.end())
        found = m_prepared.insert(m_prepared.end(), {picture, {}});
    found->wanted = true;
    startNext();
    return found->light.texels;
}

void WallLights::sweep() {
    const auto drop = [](auto& entries) {
        std::erase_if(entries, [](auto& entry) { return !std::exchange(entry.wanted, false); });
    };
    drop(m_generated);
    drop(m_blended);
    drop(m_prepared);
}

void WallLights::clear() {
    m_tasks.cancel(kTag);
    m_generated.clear();
    m_blended.clear();
    m_prepared.clear();
}

// Pictures first: a small light of each, then all of it.
void WallLights::startNext() {
    if (!m_tasks.busy(kTag) && !generateNext() && !blendNext() && !prepareNext())
        refineNext();
}

void WallLights::ended() {
    startNext();
    Q_EMIT changed();
}

bool WallLights::generateNext() {
    const auto next = std::ranges::find(m_generated, nullptr, &Generated::picture);
    if (next == m_generated.end())
        return false;
    m_tasks.run(
        {.tag = kTag, .priority = TaskPriority::High, .name = "environment of a cell"},
        [recipe = next->recipe](const JobContext& job) {
            return generateEnvironment(recipe, kEnvironmentHeight, job);
        },
        [this, recipe = next->recipe](const Result<ImagePtr>& picture) {
            const auto entry = std::ranges::find(m_generated, recipe, &Generated::recipe);
            if (picture && entry != m_generated.end())
                entry->picture = *picture;
            ended();
        });
    return true;
}

bool WallLights::blendNext() {
    const auto next = std::ranges::find(m_blended, nullptr, &Blended::picture);
    if (next == m_blended.end())
        return false;
    m_tasks.run(
        {.tag = kTag, .priority = TaskPriority::High, .name = "cross-fade of a cell"},
        [blend = next->blend](const JobContext& job) { return blendEnvironments(blend, job); },
        [this, blend = next->blend](const Result<ImagePtr>& picture) {
            const auto entry = std::ranges::find(m_blended, blend, &Blended::blend);
            if (picture && entry != m_blended.end())
                entry->picture = *picture;
            ended();
        });
    return true;
}

bool WallLights::prepareNext() {
    const auto next = std::ranges::find_if(
        m_prepared, [](const Prepared& entry) { return !entry.light.texels && !entry.failed; });
    if (next == m_prepared.end())
        return false;
    m_tasks.run(
        {.tag = kTag, .priority = TaskPriority::High, .name = "image-based light of a cell"},
        [this, picture = next->picture](const JobContext& job) {
            return m_lights.first(picture, job);
        },
        [this, picture = next->picture](const Result<IblLight>& light) {
            const auto entry = std::ranges::find(m_prepared, picture, &Prepared::picture);
            if (entry != m_prepared.end()) {
                entry->failed = !light;
                if (light)
                    entry->light = *light;
            }
            if (!light)
                logError("The light of a cell cannot be prepared: {}", light.error().text());
            ended();
        });
    return true;
}

bool WallLights::refineNext() {
    const auto next = std::ranges::find_if(m_prepared, [](const Prepared& entry) {
        return entry.light.texels && !entry.light.full && !entry.failed;
    });
    if (next == m_prepared.end())
        return false;
    IblLight todo = next->light;
    todo.maps = nullptr;
    todo.texels = nullptr;
    m_tasks.run(
        {.tag = kTag, .name = "image-based light of a cell in full", .gate = m_gate},
        [todo](const JobContext& job) { return refinedIbl(todo, job); },
        [this, picture = next->picture](const Result<IblLight>& light) {
            const auto entry = std::ranges::find(m_prepared, picture, &Prepared::picture);
            if (light) {
                m_lights.keep(*light);
                keepIbl(m_tasks, m_lights.disk(), *light);
            }
            if (entry != m_prepared.end()) {
                entry->failed = !light; // the small one stays
                if (light)
                    entry->light = *light;
            }
            ended();
        });
    return true;
}

} // namespace patina::editor
