#include "app/editor/trace/PathBlame.h"

#include "app/editor/document/DocumentController.h"
#include "app/editor/document/QtText.h"
#include "app/editor/trace/PathError.h"
#include "app/editor/trace/PathView.h"
#include "core/document/Document.h"
#include "core/document/ViewChoices.h"
#include "core/trace/error/SeenMaterials.h"

#include <QPoint>
#include <QRect>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace patina::editor {
namespace {

constexpr const char* kBlameTag = "causes of the error";
// Pictures are no wider: shares of a material need no more.
constexpr int kWidest = 400;
// Paths per pixel, one after the other, so that there is soon something to be seen.
constexpr std::array<std::uint32_t, 3> kBlamePasses{8, 32, 128};

} // namespace

struct PathBlame::Work {
    DrawnTerms terms;
    PathView::Subject subject; // of reduced size
    View look;
    Film film;
    std::uint32_t samples = 0;                        // of the film
    std::shared_ptr<const std::vector<Id>> materials; // null: not looked for yet
};

PathBlame::PathBlame(DocumentController& controller, PathView& paths, PathError& error,
                     QObject* parent)
    : QObject(parent)
    , m_controller(controller)
    , m_paths(paths)
    , m_error(error)
    , m_tasks(controller.runner()) {
    connect(&error, &PathError::changed, this, &PathBlame::follow);
    connect(&paths, &PathView::changed, this, &PathBlame::follow);
}

bool PathBlame::isOn() const {
    return m_error.isOn();
}

bool PathBlame::wantsTerms() const {
    return isOn() && m_problem.isEmpty() && m_work == nullptr && !m_size.isEmpty() &&
           m_of == Wanted(m_paths.number(), m_error.wantedDrawn());
}

void PathBlame::reset() {
    m_tasks.cancelAll();
    m_work = nullptr;
    m_size = {};
    m_pass = 0;
    m_problem.clear();
    if (std::exchange(m_found, nullptr))
        Q_EMIT changed();
}

void PathBlame::follow() {
    const Wanted of = isOn() ? Wanted(m_paths.number(), m_error.wantedDrawn()) : Wanted(0, 0);
    if (of != m_of) {
        m_of = of;
        reset();
    }
    // Only once there is a traced picture, so that this does not wait for it.
    if (!isOn() || m_work || !m_size.isEmpty() || !m_problem.isEmpty() ||
        !m_paths.reference().traced)
        return;
    const View& look = m_controller.document().view;
    if (look.lighting != LightingMode::Ibl)
        m_problem = tr("Causes are available with image-based lighting only");
    else if (look.reflectionMix != View().reflectionMix)
        m_problem = tr("Known only while the reflection mix is even");
    if (!m_problem.isEmpty()) {
        Q_EMIT changed();
        return;
    }
    const PathView::Subject subject = m_paths.subject();
    if (!subject.scene)
        return;
    const int reduction = (subject.view.width + kWidest - 1) / kWidest;
    m_size = QSize(std::max(subject.view.width / reduction, 1),
                   std::max(subject.view.height / reduction, 1));
    Q_EMIT termsWanted();
}

void PathBlame::setTerms(DrawnTerms terms) {
    if (!wantsTerms())
        return;
    m_work = std::make_shared<Work>();
    m_work->terms = std::move(terms);
    m_work->subject = m_paths.subject();
    m_work->subject.view.width = m_size.width();
    m_work->subject.view.height = m_size.height();
    m_work->look = m_controller.document().view;
    m_work->film = Film(m_size.width(), m_size.height());
    m_pass = 0;
    trace();
}

void PathBlame::trace() {
    m_tasks.run(
        {.tag = kBlameTag, .priority = TaskPriority::Low},
        [work = m_work, samples = kBlamePasses[m_pass]](const JobContext& job) {
            return PathBlame::work(*work, samples, job);
        },
        [this, work = m_work](const Result<std::shared_ptr<const Found>>& found) {
            if (work != m_work)
                return;
            if (found) {
                m_found = *found;
                if (++m_pass < kBlamePasses.size())
                    trace();
            } else if (found.error().kind != ErrorKind::Cancelled) {
                m_problem = toQString(found.error().message);
            }
            Q_EMIT changed();
        });
}

Result<std::shared_ptr<const PathBlame::Found>> PathBlame::work(Work& work, std::uint32_t samples,
                                                                const JobContext& job) {
    const TraceScene& scene = *work.subject.scene;
    const TraceView& view = work.subject.view;
    if (!work.materials) {
        std::vector<Id> seen = seenMaterials(scene, view, job);
        if (job.stopping())
            return Error{ErrorKind::Cancelled, "cancelled", {}, {}};
        work.materials = std::make_shared<const std::vector<Id>>(std::move(seen));
    }
    if (Result<void> traced =
            tracePaths(scene, view, {}, work.film, work.samples, samples - work.samples, job);
        !traced)
        return traced.error();
    work.samples = samples;
    const Result<BlameFilm> truths = traceBlame(scene, view, work.subject.model, 0, samples, job);
    if (!truths)
        return truths.error();
    Result<Blame> made =
        blame(work.terms, *truths, work.film, work.look, *work.materials, job, true);
    if (!made)
        return made.error();
    return std::make_shared<const Found>(Found{*std::move(made), work.materials, samples});
}

std::optional<QPoint> PathBlame::pixelAt(const std::optional<QPointF>& position) const {
    if (!position)
        return std::nullopt;
    const QPoint pixel(static_cast<int>(std::floor(position->x() * m_size.width())),
                       static_cast<int>(std::floor(position->y() * m_size.height())));
    return QRect({}, m_size).contains(pixel) ? std::optional(pixel) : std::nullopt;
}

Id PathBlame::materialAt(const QPoint& pixel) const {
    return (*m_found->materials)[static_cast<std::size_t>(pixel.y()) *
                                     static_cast<std::size_t>(m_size.width()) +
                                 static_cast<std::size_t>(pixel.x())];
}

const BlameScore& PathBlame::scoreAt(const std::optional<QPointF>& position) const {
    const Blame& blame = m_found->blame;
    const std::optional<QPoint> pixel = pixelAt(position);
    if (!pixel)
        return blame.whole;
    const auto found =
        std::ranges::find(blame.materials, materialAt(*pixel), &BlameScore::material);
    return found != blame.materials.end() ? *found : blame.whole;
}

std::optional<BlameScore> PathBlame::hereAt(const std::optional<QPointF>& position) const {
    const std::optional<QPoint> pixel = pixelAt(position);
    if (!pixel || materialAt(*pixel) == 0)
        return std::nullopt;
    return m_found->blame.around(pixel->x(), pixel->y(), kAround, *m_found->materials);
}

} // namespace patina::editor
