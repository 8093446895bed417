// The part of ViewportWidget that brings the scene into view and selects what is clicked.
#include "app/editor/document/DocumentController.h"
#include "app/editor/document/SelectionModel.h"
#include "app/editor/viewport/ViewportWidget.h"
#include "app/editor/wall/WallState.h"

#include <QGuiApplication>
#include <algorithm>

namespace patina::editor {

void ViewportWidget::setCamera(const Camera& camera) {
    m_controller.setCamera(camera);
    touch();
}

void ViewportWidget::frameSelection() {
    const Document& document = m_controller.document();
    Bounds bounds = document.bounds();
    if (const MeshInstance* mesh = document.mesh(m_selection.mesh()); mesh && mesh->mesh)
        bounds = mesh->mesh->bounds().transformed(mesh->placement.matrix());
    setCamera(frameBounds(document.view.camera, bounds, viewAspect()));
}

void ViewportWidget::resetCamera() {
    const Document& document = m_controller.document();
    Camera camera; // default yaw and pitch; field of view and lens are the user's
    camera.fovDeg = document.view.camera.fovDeg;
    camera.lens = document.view.camera.lens;
    setCamera(frameBounds(camera, document.bounds(), viewAspect()));
}

Id ViewportWidget::meshAt(const QPointF& position) {
    if (!m_renderer || m_lastFrameSize.isEmpty())
        return 0;
    makeCurrent();
    const Id mesh = m_renderer->pick(
        static_cast<int>(position.x() * m_lastFrameSize.width() / std::max(width(), 1)),
        static_cast<int>(position.y() * m_lastFrameSize.height() / std::max(height(), 1)));
    doneCurrent();
    return mesh;
}

Result<std::optional<glm::vec3>> ViewportWidget::surfaceAt(const QPointF& position) {
    if (m_lastFrameSize.isEmpty() || !QRectF(rect()).contains(position))
        return std::optional<glm::vec3>();
    const Result<render::Inspection> there =
        inspect({std::min(static_cast<int>(position.x() * m_lastFrameSize.width() / width()),
                          m_lastFrameSize.width() - 1),
                 std::min(static_cast<int>(position.y() * m_lastFrameSize.height() / height()),
                          m_lastFrameSize.height() - 1)});
    if (!there)
        return there.error();
    if (!there->onSurface())
        return std::optional<glm::vec3>();
    return std::optional(glm::vec3(there->value(shading::kRecordPosition)));
}

void ViewportWidget::pickAt(const QPointF& position) {
    if (m_wall.isOn()) {
        const std::optional<std::size_t> cell = m_wallLayout.cellAt(position);
        if (QGuiApplication::keyboardModifiers().testFlag(Qt::ControlModifier))
            m_wallState->compareWith(cell);
        else if (!m_wallState->enlarged())
            m_wallState->setCurrent(cell);
        return;
    }
    if (!m_renderer || m_lastFrameSize.isEmpty())
        return;
    const Id mesh = meshAt(position);
    m_selection.selectMesh(mesh);
    if (mesh == 0) // nothing at all: the light's handles go, too
        m_selection.selectLight(0);
}

} // namespace patina::editor
