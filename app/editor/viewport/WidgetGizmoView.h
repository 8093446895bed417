// How the handles in the viewport are seen, in the pixels of its widget: those of a dense screen
// have the same size.
#pragma once

#include "core/document/Document.h"
#include "render/scene/Gizmo.h"

#include <QWidget>
#include <algorithm>

namespace patina::editor {

[[nodiscard]] inline render::GizmoView gizmoViewOf(const QWidget& viewport,
                                                   const Document& document) {
    const Camera& camera = document.view.camera;
    render::GizmoView view;
    view.viewport = {static_cast<float>(viewport.width()),
                     static_cast<float>(std::max(viewport.height(), 1))};
    view.worldToClip =
        camera.projectionMatrix(view.viewport.x / view.viewport.y, document.bounds()) *
        camera.viewMatrix();
    view.scale = std::max(1.0f, view.viewport.y / 1000.0f);
    return view;
}

} // namespace patina::editor
