#include "app/editor/viewport/ViewportHand.h"

#include "app/editor/document/DocumentController.h"
#include "app/editor/viewport/Navigator.h"
#include "app/editor/widget/StatusHint.h"

#include <QMouseEvent>
#include <QWidget>
#include <algorithm>
#include <cmath>

namespace patina::editor {
namespace {

constexpr double kClickPixels = 4.0; // a press that moves less selects

glm::vec2 toGlm(const QPointF& point) {
    return {static_cast<float>(point.x()), static_cast<float>(point.y())};
}

} // namespace

ViewportHand::ViewportHand(DocumentController& controller, SelectionModel& selection,
                           QWidget& viewport, FrameSchedule& schedule)
    : m_controller(controller)
    , m_viewport(viewport)
    , m_lights(controller, selection, viewport)
    , m_meshes(controller, selection, viewport)
    , m_fly(schedule) {
    viewport.installEventFilter(this);
    connect(&m_fly, &FlyKeys::flown, this, [this](const glm::vec3& radii) {
        const Document& document = m_controller.document();
        const float radius = std::max(document.bounds().radius(), 1e-3f);
        setCamera(fly(document.view.camera, radius * radii));
    });
}

bool ViewportHand::holding() const {
    return m_drag != Drag::None || m_fly.held();
}

bool ViewportHand::eventFilter(QObject*, QEvent* event) {
    switch (event->type()) {
    case QEvent::MouseButtonDblClick: // the second press of two quick ones
        if (static_cast<QMouseEvent*>(event)->button() == Qt::LeftButton)
            Q_EMIT doubleClicked(static_cast<QMouseEvent*>(event)->position());
        [[fallthrough]];
    case QEvent::MouseButtonPress:
        press(*static_cast<QMouseEvent*>(event));
        return true;
    case QEvent::MouseMove:
        move(*static_cast<QMouseEvent*>(event));
        return true;
    case QEvent::MouseButtonRelease:
        release(*static_cast<QMouseEvent*>(event));
        return true;
    case QEvent::Wheel:
        wheel(*static_cast<QWheelEvent*>(event));
        event->accept();
        return true;
    case QEvent::ShortcutOverride:
        if (ownsKeys())
            event->accept();
        return ownsKeys();
    case QEvent::KeyPress:
        return pressKey(*static_cast<QKeyEvent*>(event));
    case QEvent::KeyRelease: {
        const auto* key = static_cast<QKeyEvent*>(event);
        if (!key->isAutoRepeat())
            m_fly.release(key->key());
        return false;
    }
    case QEvent::FocusOut:
        m_fly.releaseAll();
        return false;
    default:
        return false;
    }
}

// While flying, letters belong to the camera, not to shortcuts; so does Esc to a drag.
bool ViewportHand::ownsKeys() const {
    return m_drag == Drag::Look || dragsThing();
}

bool ViewportHand::dragsThing() const {
    return m_drag == Drag::LightHandle || m_drag == Drag::TurnLight || m_drag == Drag::MeshHandle;
}

void ViewportHand::setCamera(const Camera& camera) {
    m_controller.setCamera(camera);
    Q_EMIT cameraMoved();
}

void ViewportHand::turnEnvironment(float pixels) {
    const ParameterInfo* rotation = findParameter("environment.rotationDeg");
    const float now = m_controller.document().environment().rotationDeg;
    // The environment follows the pointer: dragging right rotates it right.
    const float next = std::remainder(now + kTurnDegrees * pixels, 360.0f);
    m_controller.setParameter(*rotation, Target{Scope::Environment, 0}, next, m_turnSession);
}

void ViewportHand::press(const QMouseEvent& event) {
    if (m_drag != Drag::None)
        return; // a second button changes nothing
    const bool shift = event.modifiers() & Qt::ShiftModifier;
    const bool ctrl = event.modifiers() & Qt::ControlModifier;
    switch (event.button()) {
    case Qt::LeftButton:
        if (shift)
            m_drag = Drag::Pan;
        else
            m_drag = m_meshes.takeAt(event.position())   ? Drag::MeshHandle
                     : m_lights.takeAt(event.position()) ? Drag::LightHandle
                                                         : Drag::Orbit;
        break;
    case Qt::MiddleButton:
        m_drag = Drag::Pan;
        break;
    case Qt::RightButton:
        m_drag = shift ? Drag::TurnEnvironment : Drag::Look;
        if (ctrl) {
            m_drag = m_lights.takeSelected() ? Drag::TurnLight : Drag::TurnEnvironment;
            if (m_drag == Drag::TurnEnvironment)
                showHint(m_viewport, tr("No light is selected: turning the environment"));
        }
        m_turnSession = m_controller.newDragSession();
        break;
    default:
        return;
    }
    m_pressPosition = m_lastPosition = event.position();
    m_pressIsClick = true;
}

void ViewportHand::move(const QMouseEvent& event) {
    if (m_drag == Drag::None) {
        // The hand says what can be taken hold of.
        if (m_meshes.isOver(event.position()) || m_lights.isOver(event.position()))
            m_viewport.setCursor(Qt::OpenHandCursor);
        else
            m_viewport.unsetCursor();
        return;
    }
    const QPointF moved = event.position() - m_lastPosition;
    if (m_pressIsClick) {
        const QPointF total = event.position() - m_pressPosition;
        if (std::hypot(total.x(), total.y()) < kClickPixels)
            return;
        m_pressIsClick = false;
    }
    m_lastPosition = event.position();
    const Camera& camera = m_controller.document().view.camera;
    switch (m_drag) {
    case Drag::Orbit:
        setCamera(orbit(camera, toGlm(moved)));
        break;
    case Drag::Pan:
        setCamera(
            pan(camera, toGlm(moved),
                static_cast<float>(m_pictureHeight > 0 ? m_pictureHeight : m_viewport.height())));
        break;
    case Drag::Look:
        setCamera(look(camera, toGlm(moved)));
        break;
    case Drag::TurnEnvironment:
        turnEnvironment(static_cast<float>(moved.x()));
        break;
    case Drag::TurnLight:
        m_lights.turn(moved);
        break;
    case Drag::LightHandle:
        m_lights.drag(moved);
        break;
    case Drag::MeshHandle:
        m_meshes.drag(event.position(), event.modifiers() & Qt::ControlModifier);
        break;
    case Drag::None:
        break;
    }
}

void ViewportHand::release(const QMouseEvent& event) {
    if (m_pressIsClick && event.button() == Qt::LeftButton && m_drag == Drag::Orbit)
        Q_EMIT clicked(event.position());
    if (m_drag == Drag::MeshHandle)
        m_meshes.letGo();
    else if (dragsThing())
        m_lights.letGo();
    m_drag = Drag::None;
    m_pressIsClick = false;
    m_fly.releaseAll();
}

void ViewportHand::wheel(const QWheelEvent& event) {
    const float steps = static_cast<float>(event.angleDelta().y()) / 120.0f;
    const Document& document = m_controller.document();
    if (m_drag == Drag::Look)
        m_fly.changeSpeed(steps);
    else
        setCamera(dolly(document.view.camera, steps, document.bounds().radius()));
}

bool ViewportHand::pressKey(const QKeyEvent& event) {
    if (event.key() == Qt::Key_Escape && dragsThing()) {
        if (m_drag == Drag::MeshHandle)
            m_meshes.cancel();
        else
            m_lights.cancel();
        m_drag = Drag::None;
        m_pressIsClick = false;
        return true;
    }
    if (m_drag != Drag::Look || !FlyKeys::fliesWith(event.key()))
        return false;
    m_pressIsClick = false;
    m_fly.press(event.key());
    return true;
}

} // namespace patina::editor
