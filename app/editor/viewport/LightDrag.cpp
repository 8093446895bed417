#include "app/editor/viewport/LightDrag.h"

#include "app/editor/document/DocumentController.h"
#include "app/editor/document/SelectionModel.h"
#include "app/editor/viewport/Navigator.h"
#include "app/editor/viewport/WidgetGizmoView.h"
#include "app/editor/widget/StatusHint.h"
#include "core/light/Light.h"
#include "core/light/Lights.h"

#include <QWidget>

namespace patina::editor {

LightDrag::LightDrag(DocumentController& controller, SelectionModel& selection, QWidget& viewport)
    : m_controller(controller)
    , m_selection(selection)
    , m_viewport(viewport) {}

bool LightDrag::isOver(const QPointF& position) const {
    return hitAt(position).light != 0;
}

bool LightDrag::takeAt(const QPointF& position) {
    const render::GizmoHit hit = hitAt(position);
    if (hit.light == 0)
        return false;
    m_selection.selectLight(hit.light);
    take(*m_controller.document().light(hit.light), hit.handle);
    return true;
}

bool LightDrag::takeSelected() {
    const Light* light = m_controller.document().light(m_selection.light());
    if (light)
        take(*light, render::GizmoHandle::None);
    return light != nullptr;
}

void LightDrag::take(const Light& light, render::GizmoHandle handle) {
    m_before = light;
    m_handle = handle;
    m_session = m_controller.newDragSession();
}

void LightDrag::drag(const QPointF& pixels) {
    m_viewport.setCursor(Qt::ClosedHandCursor);
    const Document& document = m_controller.document();
    const Light* light = document.light(m_before.id);
    if (!light)
        return;
    const Camera& camera = document.view.camera;
    const Light dragged = render::draggedLight(
        *light, m_handle, document.bounds(), gizmoViewOf(m_viewport, document), camera.right(),
        camera.up(), {static_cast<float>(pixels.x()), static_cast<float>(-pixels.y())});
    const bool turns = m_handle == render::GizmoHandle::Aim || !hasPosition(light->type);
    m_controller.changeLight(
        dragged, m_session,
        (turns ? tr("Turn %1") : tr("Move %1")).arg(QString::fromStdString(light->name)));
    if (turns)
        showHint(m_viewport, tr("Azimuth %1°, elevation %2° (Esc takes it back)")
                                 .arg(static_cast<double>(dragged.azimuthDeg), 0, 'f', 1)
                                 .arg(static_cast<double>(dragged.elevationDeg), 0, 'f', 1));
    else
        showHint(m_viewport, tr("X %1 m, Y %2 m, Z %3 m (Esc takes it back)")
                                 .arg(static_cast<double>(dragged.position.x), 0, 'f', 3)
                                 .arg(static_cast<double>(dragged.position.y), 0, 'f', 3)
                                 .arg(static_cast<double>(dragged.position.z), 0, 'f', 3));
}

void LightDrag::turn(const QPointF& pixels) {
    const Document& document = m_controller.document();
    const Light* light = document.light(m_before.id);
    if (!light)
        return;
    // The side that faces the camera follows the pointer: dragging right takes the light to the
    // right, dragging up takes it up.
    const Light turned = turnedLight(*light, document.bounds().center(),
                                     kTurnDegrees * static_cast<float>(pixels.x()),
                                     -kTurnDegrees * static_cast<float>(pixels.y()));
    const QString name = QString::fromStdString(light->name);
    m_controller.changeLight(turned, m_session, tr("Turn %1").arg(name));
    showHint(m_viewport, tr("%1 turns about the scene (Esc takes it back)").arg(name));
}

// A session that returns to its start leaves no step behind.
void LightDrag::cancel() {
    m_controller.changeLight(m_before, m_session, {});
    showHint(m_viewport, {});
}

void LightDrag::letGo() {
    m_viewport.unsetCursor();
    showHint(m_viewport, {});
}

render::GizmoHit LightDrag::hitAt(const QPointF& position) const {
    if (!m_visible)
        return {};
    const Document& document = m_controller.document();
    const glm::vec2 pixel(static_cast<float>(position.x()),
                          static_cast<float>(m_viewport.height() - position.y()));
    return render::pickGizmo(document, document.bounds(), gizmoViewOf(m_viewport, document),
                             m_selection.light(), pixel);
}

} // namespace patina::editor
