#include "app/editor/wall/TracedCells.h"

#include "app/editor/document/DocumentController.h"
#include "app/editor/trace/PassTurn.h"
#include "app/editor/trace/PathView.h"
#include "app/editor/wall/WallState.h"

#include <algorithm>
#include <numeric>

namespace patina::editor {
namespace {

constexpr const char* kCellsTag = "tracing cells";
// A pass takes about so long once a cell has its picture: many cells become finer one after the
// other, and none stands still for long.
constexpr double kCellPassSeconds = 0.1;
// Between pictures that are shown, each of which takes the viewport's time, too: while some cell is
// coarse, and then.
constexpr int kCoarseMs = 100, kFineMs = 250;

} // namespace

TracedCells::TracedCells(WallState& wall, DocumentController& controller, PathView& paths,
                         QObject* parent)
    : QObject(parent)
    , m_wall(wall)
    , m_paths(paths)
    , m_whitted(paths.whitted())
    , m_tasks(controller.runner()) {
    m_announce.setSingleShot(true);
    connect(&m_announce, &QTimer::timeout, this, &TracedCells::changed);
    connect(&wall, &WallState::changed, this, &TracedCells::follow);
    connect(&controller, &DocumentController::changed, this, [this](const Change& change) {
        if (!change.isAnotherDocument())
            return;
        m_all.reset(); // they were of the document before
        m_own.clear();
        choose();
    });
    connect(&paths, &PathView::changed, this, [this] {
        if (m_whitted == m_paths.whitted())
            return;
        m_whitted = m_paths.whitted();
        for (Traced& cell : m_cells)
            if (cell.by == TracedBy::Whitted && cell.subject)
                restart(cell);
        proceed();
    });
}

void TracedCells::setGate(std::shared_ptr<const WorkGate> gate) {
    m_gate = std::move(gate);
}

// --- Chosen --------------------------------------------------------------------------------------

std::optional<TracedBy> TracedCells::tracer(std::size_t cell) const {
    return cell < m_cells.size() ? m_cells[cell].by : std::nullopt;
}

std::vector<std::size_t> TracedCells::allCells() const {
    std::vector<std::size_t> all(m_cells.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    return all;
}

std::vector<std::size_t> TracedCells::meantCells() const {
    if (const std::optional<std::size_t> current = m_wall.current())
        return {*current};
    return allCells();
}

bool TracedCells::areTraced(const std::vector<std::size_t>& cells, TracedBy by) const {
    return !cells.empty() &&
           std::ranges::all_of(cells, [&](std::size_t cell) { return tracer(cell) == by; });
}

void TracedCells::toggle(const std::vector<std::size_t>& cells, TracedBy by) {
    const std::optional<TracedBy> wanted = areTraced(cells, by) ? std::nullopt : std::optional(by);
    for (const std::size_t index : cells) {
        if (index >= m_cells.size())
            continue;
        const Cell& of = m_cells[index].of;
        std::erase_if(m_own, [&](const auto& own) { return own.first == of; });
        if (wanted != m_all)
            m_own.emplace_back(of, wanted);
    }
    choose();
}

void TracedCells::toggleAll(TracedBy by) {
    m_all = areTraced(allCells(), by) ? std::nullopt : std::optional(by);
    m_own.clear();
    choose();
}

void TracedCells::choose() {
    bool differs = false;
    for (Traced& cell : m_cells) {
        const auto own = std::ranges::find(m_own, cell.of, &decltype(m_own)::value_type::first);
        const std::optional<TracedBy> by = own != m_own.end() ? own->second : m_all;
        if (by == cell.by)
            continue;
        differs = true;
        cell.by = by;
        if (!by)
            letGo(cell);
        else if (cell.subject)
            restart(cell);
    }
    if (!differs)
        return;
    proceed();
    Q_EMIT chosen();
}

void TracedCells::follow() {
    std::vector<Traced> before = std::exchange(m_cells, {});
    for (const WallCell& cell : m_wall.cells()) {
        const auto known = std::ranges::find_if(
            before, [&](const Traced& traced) { return traced.by && traced.of == cell.shared; });
        Traced& traced = m_cells.emplace_back();
        if (known != before.end())
            traced = std::exchange(*known, {});
        traced.of = cell.shared;
    }
    for (Traced& gone : before)
        letGo(gone);
    choose();
}

// --- Passes --------------------------------------------------------------------------------------

void TracedCells::letGo(Traced& cell) {
    if (cell.work && cell.work == m_running) {
        m_tasks.cancel(kCellsTag);
        m_running = nullptr;
    }
    Traced left;
    left.of = std::move(cell.of);
    left.by = cell.by;
    cell = std::move(left);
}

void TracedCells::restart(Traced& cell) {
    cell.stale = true;
    const bool runs = cell.work && cell.work == m_running;
    if (runs && !cell.hasFirst)
        return; // see take()
    if (runs) {
        m_tasks.cancel(kCellsTag);
        m_running = nullptr;
    }
    startOver(cell);
}

void TracedCells::startOver(Traced& cell) {
    cell.stale = cell.hasFirst = false;
    cell.work = nullptr;
    cell.picture = nullptr;
    cell.progress = {};
}

void TracedCells::want(const std::vector<Wanted>& cells) {
    for (std::size_t i = 0; i < std::min(cells.size(), m_cells.size()); ++i) {
        const Wanted& wanted = cells[i];
        Traced& cell = m_cells[i];
        cell.seen = cell.by && wanted.document != nullptr && !wanted.size.isEmpty();
        if (!cell.seen) {
            if (wanted.edited)
                cell.subject.reset(); // begins anew when it is seen
            continue;
        }
        if (cell.subject && !wanted.edited && cell.subject->camera == wanted.camera &&
            cell.subject->size == wanted.size)
            continue;
        TraceSubject subject = TraceSubject::of(*wanted.document, wanted.camera, wanted.size);
        if (cell.subject && subject.sameAs(*cell.subject))
            continue;
        cell.subject = std::move(subject);
        restart(cell);
    }
    limitMemory();
    proceed();
}

// Those that are not seen are kept for their return, as long as there is room for them.
void TracedCells::limitMemory() {
    const auto pixelsOf = [](const Traced& cell) {
        return cell.subject ? static_cast<std::size_t>(cell.subject->size.width()) *
                                  static_cast<std::size_t>(cell.subject->size.height())
                            : 0;
    };
    std::size_t seen = 0, hidden = 0;
    for (Traced& cell : m_cells) {
        if (!cell.seen) {
            hidden += pixelsOf(cell);
            continue;
        }
        const bool refused = seen + pixelsOf(cell) > kMostPixels;
        if (refused && !cell.refused)
            letGo(cell);
        cell.refused = refused;
        if (!refused)
            seen += pixelsOf(cell);
    }
    if (seen + hidden > kMostPixels)
        for (Traced& cell : m_cells)
            if (!cell.seen && cell.subject)
                letGo(cell);
}

// Hierarchy and samplers of another cell are used where they are of the same: cells of a wall
// mostly have their geometry in common, those of a column their environment.
TraceWork::Known TracedCells::knownFor(const Traced& cell) const {
    const TraceInputs& inputs = cell.subject->inputs;
    const auto fits = [&](const Traced& other) {
        if (!other.known.scene)
            return 0;
        const TraceInputs& has = other.known.scene->inputs();
        if (has.meshes != inputs.meshes)
            return 1;
        if (has.environments != inputs.environments)
            return 2;
        return has == inputs ? 4 : 3;
    };
    const Traced* best = &cell;
    for (const Traced& other : m_cells)
        if (fits(other) > fits(*best))
            best = &other;
    return {best->known.scene, cell.known.blurred};
}

void TracedCells::proceed() {
    if (m_running)
        return;
    std::vector<PassTurn> turns;
    for (const Traced& cell : m_cells) {
        const bool finer = cell.work && cell.work->samples() > 0;
        turns.push_back({cell.wantsPass(),
                         finer        ? 0
                         : !cell.work ? TraceWork::kCoarsest
                                      : cell.work->reduction(),
                         cell.turn});
    }
    const std::optional<std::size_t> next = nextTurn(turns);
    if (!next)
        return;
    Traced& cell = m_cells[*next];
    if (!cell.work)
        cell.work = std::make_shared<TraceWork>(*cell.subject, *cell.by, m_whitted, knownFor(cell));
    cell.turn = ++m_turn;
    m_running = cell.work;
    m_tasks.run(
        {.tag = kCellsTag,
         .priority = cell.work->samples() == 0 ? TaskPriority::Normal : TaskPriority::Low,
         .gate = m_gate},
        [work = cell.work](const JobContext& job) {
            return work->trace(kCellPassSeconds, false, job);
        },
        [this, work = cell.work](const Result<TraceWork::Pass>& pass) {
            if (work == m_running)
                take(work, pass);
        });
}

void TracedCells::take(const std::shared_ptr<TraceWork>& work,
                       const Result<TraceWork::Pass>& pass) {
    m_running = nullptr;
    const auto found = std::ranges::find(m_cells, work, &Traced::work);
    if (found != m_cells.end()) {
        Traced& cell = *found;
        if (pass) {
            cell.hasFirst = true;
            cell.known = pass->known;
            cell.picture = pass->picture;
            cell.progress.add(*pass, *work);
        } else if (pass.error().kind == ErrorKind::Cancelled) {
            return; // the editor ends
        } else {
            cell.picture = nullptr;
            cell.progress.fail(pass.error());
        }
        if (cell.stale)
            startOver(cell);
        const bool coarse = std::ranges::any_of(m_cells, [](const Traced& traced) {
            return traced.wantsPass() && traced.progress.samples == 0;
        });
        if (!m_announce.isActive())
            m_announce.start(coarse ? kCoarseMs : kFineMs);
    }
    proceed();
}

ImagePtr TracedCells::picture(std::size_t cell) const {
    return cell < m_cells.size() ? m_cells[cell].picture : nullptr;
}

TraceProgress TracedCells::progress(std::size_t cell) const {
    return cell < m_cells.size() ? m_cells[cell].progress : TraceProgress();
}

bool TracedCells::isRefused(std::size_t cell) const {
    return cell < m_cells.size() && m_cells[cell].refused;
}

bool TracedCells::isBusy() const {
    return m_announce.isActive() || std::ranges::any_of(m_cells, &Traced::wantsPass);
}

} // namespace patina::editor
