#include "app/editor/trace/PathView.h"

#include "app/editor/document/DocumentController.h"
#include "core/document/Document.h"

#include <utility>

namespace patina::editor {
namespace {

constexpr const char* kTag = "path tracing";
// A pass takes about so long, so that the picture is seen to become finer; and between two of them
// what somebody waits for comes first.
constexpr double kPassSeconds = 0.25;

} // namespace

PathView::PathView(DocumentController& controller, QObject* parent)
    : QObject(parent)
    , m_controller(controller)
    , m_tasks(controller.runner()) {}

void PathView::setOn(bool on) {
    if (on == m_on)
        return;
    m_on = on;
    m_paused = m_tells = false;
    m_reference = {};
    m_tasks.cancel(kTag);
    m_work = nullptr;
    m_known = {};
    m_picture = nullptr;
    m_subject = {};
    m_stale = false;
    m_progress = {};
    Q_EMIT changed();
}

void PathView::setTracer(TracedBy tracer) {
    if (tracer == m_tracer)
        return;
    m_tracer = tracer;
    if (m_on && m_work)
        begin();
    Q_EMIT changed();
}

void PathView::setWhitted(const WhittedSettings& settings) {
    if (settings == m_whitted)
        return;
    const bool otherModel = settings.model != m_whitted.model;
    m_whitted = settings;
    if (isWhitted() && m_work)
        begin();
    Q_EMIT changed();
    if (otherModel)
        Q_EMIT modelChanged();
}

std::optional<PathView::Frame> PathView::frame() const {
    if (!m_on || !m_work || !m_known.scene || m_progress.samples == 0)
        return std::nullopt;
    return Frame{m_known.scene, m_work->view()};
}

bool PathView::isTracing() const {
    return m_tasks.busy(kTag);
}

void PathView::setPaused(bool paused) {
    if (!m_on || paused == m_paused)
        return;
    m_paused = paused;
    if (!paused)
        proceed();
    Q_EMIT changed();
}

void PathView::setTellsCertainty(bool tells) {
    if (!m_on || tells == m_tells)
        return;
    m_tells = tells;
    if (!tells)
        m_reference = {};
    else if (m_work && !m_tasks.busy(kTag) && m_work->samples() > 1)
        run(false); // it rests
}

void PathView::want(const Camera& camera, const QSize& size) {
    if (!m_on || size.isEmpty())
        return;
    TraceSubject subject = TraceSubject::of(m_controller.document(), camera, size);
    if (subject.sameAs(m_subject))
        return;
    m_subject = std::move(subject);
    m_stale = true;
    if (!m_work || m_hasFirst || !m_tasks.busy(kTag))
        begin();
}

void PathView::begin() {
    m_stale = false;
    m_tasks.cancel(kTag);
    m_work = std::make_shared<TraceWork>(m_subject, m_tracer, m_whitted, m_known);
    m_hasFirst = m_paused = false;
    m_reference = {};
    ++m_number;
    m_progress = {};
    proceed();
}

void PathView::proceed() {
    if (!m_work || m_progress.refined || m_tasks.busy(kTag) ||
        (m_paused && m_work->reduction() < TraceWork::kCoarsest))
        return;
    run(true);
}

void PathView::run(bool traces) {
    m_tasks.run(
        {.tag = kTag,
         .priority = m_work->samples() == 0 ? TaskPriority::Normal : TaskPriority::Low},
        [work = m_work, traces, tells = m_tells](const JobContext& job) {
            return traces ? work->trace(kPassSeconds, tells, job)
                          : Result<TraceWork::Pass>(work->tell(job));
        },
        [this, work = m_work](const Result<TraceWork::Pass>& pass) {
            if (work == m_work)
                take(pass);
        });
}

void PathView::take(const Result<TraceWork::Pass>& pass) {
    if (!pass) {
        if (pass.error().kind != ErrorKind::Cancelled) {
            m_progress.fail(pass.error());
            m_picture = nullptr;
        }
        Q_EMIT changed();
        return;
    }
    m_hasFirst = true;
    m_known = pass->known;
    if (pass->picture)
        m_picture = pass->picture;
    if (pass->reference.traced && m_tells)
        m_reference = pass->reference;
    m_progress.add(*pass, *m_work);
    const bool rests = m_progress.refined || m_paused;
    if (m_stale)
        begin();
    else if (rests && m_tells && !m_reference.traced && pass->traces && m_work->samples() > 1)
        run(false); // it was asked for in the last pass
    else
        proceed();
    Q_EMIT changed();
}

// The view is complete since the first picture: what is blurred behind the scene is part of it.
PathView::Subject PathView::subject() const {
    if (!m_work || !m_hasFirst || m_stale)
        return {};
    return {m_known.scene, m_work->view(), m_work->model()};
}

} // namespace patina::editor
