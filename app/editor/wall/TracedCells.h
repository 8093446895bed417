// Cells of the wall traced by rays in place of drawn ones: which, by what, and their pictures, made
// in the background. They have passes in turn (PassTurn.h), one at a time on all cores. Like the
// wall no part of the document: never undone, never saved.
#pragma once

#include "app/editor/trace/TraceWork.h"
#include "core/cells/Cell.h"
#include "core/job/TaskRunner.h"

#include <QObject>
#include <QTimer>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace patina {
class WorkGate;
}

namespace patina::editor {

class DocumentController;
class PathView;
class WallState;

class TracedCells : public QObject {
    Q_OBJECT
  public:
    // Of all traced cells that are seen at a time, some 1 GiB; those beyond it are drawn.
    static constexpr std::size_t kMostPixels = std::size_t{1} << 24;

    // `paths`: whose settings of the classical ray tracer these have, too.
    TracedCells(WallState& wall, DocumentController& controller, PathView& paths,
                QObject* parent = nullptr);

    void setGate(std::shared_ptr<const WorkGate> gate); // where passes wait for frames

    // --- Chosen, by index into WallState::cells()
    [[nodiscard]] std::optional<TracedBy> tracer(std::size_t cell) const; // nothing: it is drawn
    // These cells are traced so, or, where all of them are already, drawn again. A cell stays what
    // it is wherever it comes to stand.
    void toggle(const std::vector<std::size_t>& cells, TracedBy tracer);
    // All cells, those that come to the wall later included.
    void toggleAll(TracedBy tracer);
    [[nodiscard]] bool areTraced(const std::vector<std::size_t>& cells, TracedBy tracer) const;
    [[nodiscard]] std::vector<std::size_t> allCells() const;
    // What a key means that was pressed away from the cells: the current one, else all of them.
    [[nodiscard]] std::vector<std::size_t> meantCells() const;

    // --- Shown
    struct Wanted {
        // As the cell shows it, with the pictures of its environments; null: that is not known yet,
        // or the cell is not to be traced now.
        const Document* document = nullptr;
        bool edited = false; // since the last call
        Camera camera;
        QSize size; // pixels; empty: the cell is not seen, and waits
    };
    // Of all cells. Where that is something else, a cell begins anew.
    void want(const std::vector<Wanted>& cells);
    // The newest picture of what is wanted, of full or, at first, of reduced size: F32, 4 channels,
    // premultiplied. Null: there is none yet, and the cell is drawn: input is seen at once.
    [[nodiscard]] ImagePtr picture(std::size_t cell) const;
    [[nodiscard]] TraceProgress progress(std::size_t cell) const; // of what is wanted
    [[nodiscard]] bool isRefused(std::size_t cell) const;         // kMostPixels
    [[nodiscard]] const WhittedSettings& whitted() const { return m_whitted; }
    [[nodiscard]] bool isBusy() const; // a cell that is seen is not as fine as it gets

  Q_SIGNALS:
    void chosen();  // tracer()
    void changed(); // pictures or how far they are, a few times per second

  private:
    struct Traced {
        Cell of; // as the axes make it
        std::optional<TracedBy> by;
        std::optional<TraceSubject> subject;
        bool seen = false, refused = false;
        bool stale = false;              // something else is wanted than what is under way
        bool hasFirst = false;           // a picture of what is under way has come
        std::shared_ptr<TraceWork> work; // null: begins with its next pass
        TraceWork::Known known;
        ImagePtr picture;
        TraceProgress progress;
        std::uint64_t turn = 0; // of its last pass
        [[nodiscard]] bool wantsPass() const { return by && seen && !refused && !progress.refined; }
    };
    void follow(); // the wall
    void choose();
    void restart(Traced& cell);
    void startOver(Traced& cell);
    void limitMemory();
    void proceed();
    void take(const std::shared_ptr<TraceWork>& work, const Result<TraceWork::Pass>& pass);
    void letGo(Traced& cell); // all that it has
    [[nodiscard]] TraceWork::Known knownFor(const Traced& cell) const;

    WallState& m_wall;
    PathView& m_paths;
    WhittedSettings m_whitted; // that the pictures have
    std::shared_ptr<const WorkGate> m_gate;
    std::optional<TracedBy> m_all;                               // of cells that …
    std::vector<std::pair<Cell, std::optional<TracedBy>>> m_own; // … have no choice of their own
    std::vector<Traced> m_cells;                                 // as the wall's
    std::shared_ptr<TraceWork> m_running;                        // null: no pass is under way
    std::uint64_t m_turn = 0;
    QTimer m_announce;
    TaskGroup m_tasks; // last: it ends before the rest
};

} // namespace patina::editor
