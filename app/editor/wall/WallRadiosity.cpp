#include "app/editor/wall/WallRadiosity.h"

#include "app/editor/document/QtText.h"
#include "app/editor/radiosity/RadiosityUpdater.h"
#include "core/trace/document/DocumentTraceInputs.h"

#include <algorithm>
#include <utility>

namespace patina::editor {
namespace {

constexpr const char* kRadiosityTag = "radiosity of the wall";

RadiositySettings cellRadiositySettings(const Document& document) {
    RadiositySettings settings = radiositySettings(document.view);
    settings.maxElements = RadiosityUpdater::kMaxElements;
    return settings;
}

} // namespace

WallRadiosity::WallRadiosity(TaskRunner& runner, QObject* parent)
    : QObject(parent)
    , m_tasks(runner) {}

void WallRadiosity::setRadiosity(RadiosityUpdater& radiosity) {
    m_radiosity = &radiosity;
    connect(&radiosity, &RadiosityUpdater::shownChanged, this, &WallRadiosity::changed);
    // What waited for the scene's own solution need not any more.
    connect(&radiosity, &RadiosityUpdater::changed, this, &WallRadiosity::startNext);
}

WallRadiosity::Found WallRadiosity::find(const Document& shown, const Document& document) {
    TraceInputs inputs = traceInputs(shown);
    const RadiositySettings settings = cellRadiositySettings(shown);
    if (settings == cellRadiositySettings(document) && inputs == traceInputs(document))
        return {true, m_radiosity->shown(), {}};
    Solving* known = find(inputs, settings);
    if (known == nullptr)
        known = &m_solving.emplace_back(Solving{std::move(inputs), settings, nullptr, nullptr, {}});
    known->wanted = true;
    const Found found{false, known->shown, known->failure};
    startNext();
    return found;
}

void WallRadiosity::sweep() {
    std::erase_if(m_solving, [this](Solving& solving) {
        if (std::exchange(solving.wanted, false))
            return false;
        if (solving.running)
            m_tasks.cancel(kRadiosityTag);
        return true;
    });
}

void WallRadiosity::clear() {
    m_tasks.cancel(kRadiosityTag);
    m_solving.clear();
}

WallRadiosity::Solving* WallRadiosity::find(const TraceInputs& inputs,
                                            const RadiositySettings& settings) {
    const auto found = std::ranges::find_if(
        m_solving, [&](const Solving& solving) { return solving.isOf(inputs, settings); });
    return found != m_solving.end() ? &*found : nullptr;
}

LiveRadiosityPtr WallRadiosity::closestTo(const Solving& solving) const {
    const auto fits = [&](const LiveRadiosityPtr& live) {
        return live && live->inputs.meshes == solving.inputs.meshes;
    };
    if (fits(m_radiosity->live()))
        return m_radiosity->live();
    for (const Solving& other : m_solving)
        if (fits(other.live))
            return other.live;
    return nullptr;
}

// The scene's own solution first: most of what it finds holds for the cells, too.
void WallRadiosity::startNext() {
    if (m_tasks.busy(kRadiosityTag) || m_radiosity->solving() || m_radiosity->findingFactors())
        return;
    const auto next = std::ranges::find_if(m_solving, [](const Solving& solving) {
        return !solving.live && solving.failure.isEmpty();
    });
    if (next == m_solving.end())
        return;
    next->running = true;
    struct Solved {
        LiveRadiosityPtr live;
        ShownRadiosityPtr shown;
    };
    m_tasks.run(
        {.tag = kRadiosityTag, .priority = TaskPriority::Low, .name = "radiosity of a cell"},
        [inputs = next->inputs, settings = next->settings,
         before = closestTo(*next)](const JobContext& job) -> Result<Solved> {
            const Result<LiveRadiosityPtr> live =
                followRadiosity(inputs, settings, before, job, {}, {.factors = false});
            if (!live)
                return live.error();
            return Solved{*live, shownRadiosity(**live, (*live)->solution)};
        },
        [this, inputs = next->inputs, settings = next->settings](const Result<Solved>& solved) {
            if (Solving* entry = find(inputs, settings)) {
                entry->running = false;
                if (solved) {
                    entry->live = solved->live;
                    entry->shown = solved->shown;
                } else if (solved.error().kind != ErrorKind::Cancelled) {
                    entry->failure =
                        tr("Radiosity was not solved: %1").arg(toQString(solved.error().message));
                }
            }
            startNext();
            Q_EMIT changed();
        });
}

} // namespace patina::editor
