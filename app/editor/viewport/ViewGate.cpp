#include "app/editor/viewport/ViewGate.h"

#include "app/editor/document/DocumentController.h"

namespace patina::editor {
namespace {

using render::SurfaceOutput;
using render::ViewSettings;

// A driver that takes longer may as well do so in the viewport.
constexpr int kLongestWaitMs = 10'000;

bool recordsTerms(const ViewSettings& view) {
    return !view.isOrdinary(view.shown) || (view.split && !view.isOrdinary(view.split->other));
}

} // namespace

ViewGate::ViewGate(DocumentController& controller, QObject* parent)
    : QObject(parent)
    , m_controller(controller) {
    connect(&m_warmer, &ProgramWarmer::progressed, this, &ViewGate::opened);
    connect(&m_warmer, &ProgramWarmer::finished, this, &ViewGate::opened);
    m_limit.setSingleShot(true);
    m_limit.setInterval(kLongestWaitMs);
    connect(&m_limit, &QTimer::timeout, this, [this] {
        m_passes = true;
        Q_EMIT opened();
    });
}

ViewSettings ViewGate::choose(const ViewSettings& wanted) {
    // Who looks at a term already sees it follow edits at once, as the picture does.
    const bool opens = recordsTerms(wanted) && !recordsTerms(m_view);
    const Document& document = m_controller.document();
    if (opens && !m_passes && !m_warmer.knows(document, SurfaceOutput::OneView)) {
        m_warmer.request(document, {SurfaceOutput::OneView}, ProgramWarmer::Urgency::Awaited);
        setWaiting(true);
        return m_view;
    }
    if (recordsTerms(wanted))
        m_warmer.learn(document, SurfaceOutput::OneView);
    m_view = wanted;
    m_passes = false;
    setWaiting(false);
    return m_view;
}

void ViewGate::setWaiting(bool waiting) {
    if (waiting == m_waiting)
        return;
    m_waiting = waiting;
    if (waiting)
        m_limit.start();
    else
        m_limit.stop();
    Q_EMIT waitingChanged();
}

bool ViewGate::isOpen(SurfaceOutput output) const {
    return m_warmer.knows(m_controller.document(), output);
}

void ViewGate::prepare(SurfaceOutput output) {
    if (!m_waiting)
        m_warmer.request(m_controller.document(), {output}, ProgramWarmer::Urgency::Awaited);
}

void ViewGate::rest() {
    if (!m_waiting && !m_warmer.busy())
        m_warmer.request(
            m_controller.document(),
            {SurfaceOutput::OneView, SurfaceOutput::EightViews, SurfaceOutput::Inspection},
            ProgramWarmer::Urgency::Idle);
}

} // namespace patina::editor
