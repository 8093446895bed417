#include "app/editor/job/NearShadowUpdater.h"

#include "app/editor/document/DocumentController.h"
#include "core/base/ProcessMemory.h"
#include "core/edit/Change.h"
#include "core/edit/Edit.h"
#include "core/light/Light.h"

namespace patina::editor {
namespace {

constexpr int kShadowPauseMs = 150; // without an edit until a hierarchy is worth its time
constexpr int kPatienceMs = 300;    // what is done sooner is not worth a word

} // namespace

NearShadowUpdater::NearShadowUpdater(DocumentController& controller, QObject* parent)
    : QObject(parent)
    , m_controller(controller)
    , m_memory(std::make_shared<NearShadowsPtr>())
    , m_tasks(controller.runner()) {
    m_pause.setSingleShot(true);
    m_pause.setInterval(kShadowPauseMs);
    connect(&m_pause, &QTimer::timeout, this, &NearShadowUpdater::trace);
    m_patience.setSingleShot(true);
    m_patience.setInterval(kPatienceMs);
    connect(&m_patience, &QTimer::timeout, this, &NearShadowUpdater::activityChanged);
    connect(&controller, &DocumentController::changed, this, &NearShadowUpdater::follow);
}

QString NearShadowUpdater::activity() const {
    return m_traced && !m_patience.isActive() ? tr("Tracing shadows of local lights") : QString();
}

bool NearShadowUpdater::refused() const {
    // Where the lights stand is of no concern for memory.
    return m_refused && sameScene(*m_refused, m_request) &&
           m_refused->lights.size() == m_request.lights.size();
}

bool NearShadowUpdater::upToDate() const {
    if (m_outdated || m_pause.isActive() || m_traced)
        return false;
    return m_request.empty() || refused() || (m_shown && m_shown->request == m_request);
}

void NearShadowUpdater::setWanted(bool wanted) {
    m_wanted = wanted;
    if (m_wanted && m_outdated)
        update();
}

void NearShadowUpdater::follow(const Change& change) {
    if (change.affects == Affects::Nothing)
        return;
    const Scope scope = change.target ? change.target->scope : Scope::Mesh;
    if (scope == Scope::View || scope == Scope::Model || scope == Scope::Softbox)
        return;
    const Document& document = m_controller.document();
    // Another scene, in which nothing is known, or one where nobody asks for shadows.
    if (change.isAnotherDocument() || !hasTransfer(document))
        forget();
    // A drag: the scene is as it was. An environment alone may be heard, which turns lights off.
    if (change.target && (scope == Scope::Light || scope == Scope::Environment)) {
        if (m_wanted && !m_outdated && !m_request.parts.empty()) {
            m_request.lights = nearLights(document);
            if (!m_pause.isActive())
                trace();
            return;
        }
    }
    m_outdated = true;
    if (m_wanted)
        update();
}

void NearShadowUpdater::forget() {
    m_tasks.cancelAll();
    m_pause.stop();
    m_patience.stop();
    m_traced.reset();
    m_refused.reset();
    m_memory = std::make_shared<NearShadowsPtr>();
    show(nullptr);
    Q_EMIT activityChanged();
}

void NearShadowUpdater::update() {
    m_outdated = false;
    m_request = nearShadowRequest(m_controller.document());
    // Rays through geometry that is being moved are in vain.
    if (!m_request.empty() && m_shown && !sameScene(m_request, m_shown->request)) {
        if (m_traced && !sameScene(m_request, *m_traced)) {
            m_tasks.cancelAll();
            m_traced.reset();
        }
        m_pause.start();
        return;
    }
    trace();
}

void NearShadowUpdater::trace() {
    m_pause.stop();
    if (m_request.empty() || refused() || (m_shown && m_shown->request == m_request)) {
        m_tasks.cancelAll();
        m_traced.reset();
        if (m_request.empty() || refused())
            show(nullptr);
        m_patience.stop();
        Q_EMIT activityChanged();
        return;
    }
    if (m_traced && *m_traced == m_request)
        return;
    if (!m_traced)
        m_patience.start();
    m_traced = m_request;
    m_tasks.run(
        {.tag = "shadows of local lights",
         .policy = TaskPolicy::Follow,
         .priority = TaskPriority::Low},
        [request = m_request, memory = m_memory, maxBytes = m_maxBytes](const JobContext& job) {
            Result<NearShadowsPtr> traced = traceNearShadows(
                request, *memory, maxBytes > 0 ? maxBytes : availableMemory(), job);
            if (traced)
                *memory = *traced;
            return traced;
        },
        [this, request = m_request](const Result<NearShadowsPtr>& traced) {
            if (m_traced && *m_traced == request)
                m_traced.reset();
            if (traced)
                show(*traced);
            else
                refuse(request, traced.error());
            if (!m_traced) {
                m_patience.stop();
                Q_EMIT activityChanged();
            }
        });
}

void NearShadowUpdater::refuse(const NearShadowRequest& request, const Error& error) {
    m_refused = request;
    show(nullptr);
    UserNotice notice = UserNotice::fromError(error);
    notice.kind = NoticeKind::Warning;
    notice.text =
        tr("Shadows of local lights stay soft, and let some light through: %1").arg(notice.text);
    Q_EMIT m_controller.noticed(notice);
}

void NearShadowUpdater::show(NearShadowsPtr shadows) {
    if (shadows == m_shown)
        return;
    if (shadows && !shadows->note.empty() && !(m_shown && m_shown->note == shadows->note)) {
        UserNotice notice;
        notice.kind = NoticeKind::Warning;
        notice.text = QString::fromStdString(shadows->note);
        Q_EMIT m_controller.noticed(notice);
    }
    m_shown = std::move(shadows);
    Q_EMIT shownChanged();
}

} // namespace patina::editor
