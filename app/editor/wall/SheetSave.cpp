#include "app/editor/wall/SheetSave.h"

#include "app/editor/document/DocumentController.h"
#include "app/editor/document/FileOnDisk.h"
#include "app/editor/document/QtText.h"
#include "app/editor/document/UserNotice.h"
#include "app/editor/job/JobManager.h"
#include "app/editor/viewport/ViewportWidget.h"
#include "app/editor/wall/SheetPdf.h"
#include "app/editor/wall/SheetTracing.h"
#include "app/editor/wall/WallState.h"
#include "core/base/AtomicFile.h"
#include "core/document/Snapshot.h"
#include "core/image/Channels.h"
#include "core/io/ImageIO.h"
#include "core/light/Light.h"
#include "core/material/Material.h"

#include <QFileInfo>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <utility>

namespace patina::editor {

struct SheetSave::Hand {
    std::mutex mutex;
    std::condition_variable changed;
    std::vector<sheet::DrawnCell> drawn;             // in the cells' order
    std::vector<std::optional<SheetTracing>> traced; // those of them that the job traces
    std::size_t count = 0;                           // of cells
    std::optional<Error> error;                      // drawing ended with it
    bool jobEnded = false;                           // nobody waits for pictures any more
    std::string common;                              // sheet::commonText()
};

namespace {

constexpr int kReadyMs = 50; // between looks whether the wall is complete
// Of the job's progress, when cells are drawn and when others are traced.
constexpr double kDrawnShare = 0.3, kTracedShare = 0.95;

Result<void> writeSheet(WorkerClient& worker, const SheetOrder& order, const Wall& wall,
                        std::vector<sheet::DrawnCell> drawn, const std::string& common,
                        const glm::ivec2& size) {
    const std::filesystem::path file = absolutePath(order.file);
    const std::vector<WallCell> cells = cellsOf(wall);
    if (order.format == SheetFormat::Exr) {
        ImageSaveOptions options;
        options.half = true; // as the viewport holds them
        const Result<Bytes> bytes =
            encodeImage(worker, sheet::partsOf(cells, drawn), ImageFileFormat::Exr, options);
        return bytes ? writeFileAtomically(file, *bytes) : Result<void>(bytes.error());
    }
    std::optional<sheet::WallSheetText> text;
    if (order.captions)
        text = {order.title.toStdString(), common};
    const Result<sheet::WallSheet> paper = sheet::WallSheet::create(wall, size.x, size.y, text);
    if (!paper)
        return paper.error();
    if (order.format == SheetFormat::Pdf)
        return writeFileAtomically(file, sheetPdf(*paper, wall, cells, drawn));
    return saveImage(worker, sheet::pictureOf(*paper, wall, cells, drawn), file);
}

} // namespace

SheetSave::SheetSave(SheetOrder order, const WallState& wall, ViewportWidget& viewport,
                     DocumentController& controller, JobManager& jobs)
    : QObject(&viewport)
    , m_order(std::move(order))
    , m_viewport(viewport)
    , m_controller(controller)
    , m_wall(wall.wall())
    , m_cells(wall.cells())
    , m_hand(std::make_shared<Hand>())
    , m_frame(viewport.schedule(), [this] { draw(); }) {
    m_hand->count = m_cells.size();
    if (m_cells.empty())
        m_hand->error = Error{ErrorKind::Cancelled, "there is no wall", {}, {}};
    else
        m_hand->common = sheet::commonText(m_wall, controller.document());
    connect(&wall, &WallState::changed, this, [this, &wall] {
        if (wall.wall() != m_wall) // else it is the same of an edited document
            wallWasChanged();
    });
    m_frame.want();

    const auto work = [hand = m_hand, order = m_order, shown = m_wall,
                       size = viewport.wallPainter().sheetCellSize(m_order.cellWidth),
                       worker = &controller.worker(),
                       target = &controller](const JobContext& job) -> JobOutcome {
        std::vector<sheet::DrawnCell> drawn;
        std::vector<std::optional<SheetTracing>> traced;
        {
            std::unique_lock lock(hand->mutex);
            while (!hand->error && hand->drawn.size() < hand->count && !job.cancelled()) {
                job.setActivity("drawing cells");
                job.setProgress(kDrawnShare * static_cast<double>(hand->drawn.size()) /
                                static_cast<double>(hand->count));
                hand->changed.wait_for(lock, std::chrono::milliseconds(kReadyMs));
            }
            hand->jobEnded = true;
            if (job.cancelled())
                return {Error{ErrorKind::Cancelled, "cancelled", {}, {}}, {}, {}};
            if (hand->error)
                return {hand->error, {}, {}};
            drawn = std::move(hand->drawn);
            traced = std::move(hand->traced);
        }
        const bool linear = order.format == SheetFormat::Exr;
        Result<std::vector<Image>> pictures =
            traceSheetCells(traced, linear, job.part(kDrawnShare, kTracedShare));
        if (!pictures)
            return {pictures.error(), {}, {}};
        for (std::size_t i = 0; i < traced.size(); ++i)
            if (traced[i])
                drawn[i].picture =
                    linear ? std::move((*pictures)[i]) : withoutAlpha((*pictures)[i]);
        const std::string how = tracingText(traced);
        job.setActivity("writing");
        if (auto written = writeSheet(*worker, order, shown, std::move(drawn),
                                      how.empty() ? hand->common : hand->common + "  ·  " + how,
                                      {size.width(), size.height()});
            !written)
            return {written.error(), {}, {}};
        return {std::nullopt, order.file, [target, file = order.file] {
                    UserNotice notice;
                    notice.text = SheetSave::tr("Saved the sheet to %1").arg(file);
                    Q_EMIT target->noticed(notice);
                }};
    };
    jobs.start(tr("Save sheet: %1").arg(shownFileName(m_order.file)), false, work);
}

SheetSave::~SheetSave() {
    const std::lock_guard lock(m_hand->mutex);
    if (m_hand->drawn.size() < m_hand->count && !m_hand->error)
        m_hand->error = Error{ErrorKind::Cancelled, "the window was closed", {}, {}};
    m_hand->changed.notify_all();
}

void SheetSave::fail(const Error& error) {
    {
        const std::lock_guard lock(m_hand->mutex);
        m_hand->error = error;
    }
    m_hand->changed.notify_all();
    m_frame.drop();
    m_viewport.endSheet();
    deleteLater();
}

// Nobody pressed Cancel: said aloud, as the file that was asked for is not there.
void SheetSave::wallWasChanged() {
    if (endsWithJob())
        return;
    UserNotice notice;
    notice.kind = NoticeKind::Warning;
    notice.text = tr("%1 was not saved: the wall was changed before all its cells were drawn. Show "
                     "the wall, and save it once more.")
                      .arg(shownFileName(m_order.file));
    Q_EMIT m_controller.noticed(notice);
    fail({ErrorKind::Cancelled, "the wall was changed before its sheet was drawn", {}, {}});
}

// Whether nobody waits for pictures any more: cancelled, which who did it knows.
bool SheetSave::endsWithJob() {
    const std::lock_guard lock(m_hand->mutex);
    if (!m_hand->jobEnded && !m_hand->error)
        return false;
    m_frame.drop();
    m_viewport.endSheet();
    deleteLater();
    return true;
}

void SheetSave::draw() {
    if (endsWithJob())
        return;
    if (m_views.empty()) {
        std::optional<std::vector<WallPainter::SheetCell>> views =
            m_viewport.wallPainter().sheetCells(m_order.cellWidth);
        if (!views) {
            m_frame.want(kReadyMs);
            return;
        }
        if (views->size() != m_cells.size())
            return wallWasChanged();
        m_views = std::move(*views);
    }
    sheet::DrawnCell cell;
    std::optional<SheetTracing> traced;
    const WallPainter::SheetCell& view = m_views[m_next];
    if (view.problem.isEmpty() && view.tracer) {
        const render::FrameSettings& frame = view.view.frame;
        traced = {
            TraceSubject::of(view.view.document, frame.camera, QSize(frame.width, frame.height)),
            *view.tracer, view.whitted};
    } else if (view.problem.isEmpty()) {
        Result<std::optional<Image>> drawn =
            m_viewport.drawSheetFrame(view.view, m_begins, m_order.format == SheetFormat::Exr);
        if (!drawn)
            return fail(drawn.error());
        m_begins = false;
        if (!*drawn) {
            m_frame.want();
            return;
        }
        cell.picture =
            m_order.format == SheetFormat::Exr ? std::move(**drawn) : withoutAlpha(**drawn);
    } else {
        cell.problem = view.problem.toStdString();
    }
    m_begins = true;
    ++m_next;
    {
        const std::lock_guard lock(m_hand->mutex);
        m_hand->drawn.push_back(std::move(cell));
        m_hand->traced.push_back(std::move(traced));
    }
    m_hand->changed.notify_all();
    if (m_next < m_views.size()) {
        m_frame.want();
        return;
    }
    m_viewport.endSheet();
    deleteLater();
}

} // namespace patina::editor
