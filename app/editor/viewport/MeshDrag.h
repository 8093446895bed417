// Meshes in the hand: finds the handles of what is selected in the viewport; moves, rotates and
// scales it, as one undo step, and takes it back.
#pragma once

#include "core/edit/Placing.h"
#include "render/scene/MeshGizmo.h"

#include <QCoreApplication>
#include <QPointF>
#include <optional>

class QWidget;

namespace patina::editor {

class DocumentController;
class SelectionModel;

class MeshDrag {
    Q_DECLARE_TR_FUNCTIONS(MeshDrag)
  public:
    // Positions are in `viewport`'s pixels, y down.
    MeshDrag(DocumentController& controller, SelectionModel& selection, QWidget& viewport);

    void setOn(bool on) { m_on = on; } // the tool
    [[nodiscard]] bool isOn() const { return m_on; }
    // Hidden handles cannot be taken.
    void setVisible(bool visible) { m_visible = visible; }

    // What is drawn; nothing while the tool is off, or no mesh is selected.
    [[nodiscard]] std::optional<render::MeshHandles> handles() const;
    [[nodiscard]] bool isOver(const QPointF& position) const;
    bool takeAt(const QPointF& position); // false: no handle is there

    // To `position`, from where it was taken.
    void drag(const QPointF& position, bool snap);
    void cancel(); // back to where the drag began
    void letGo();

  private:
    [[nodiscard]] render::GizmoHandle handleAt(const QPointF& position) const;
    [[nodiscard]] glm::vec2 pixelOf(const QPointF& position) const;

    DocumentController& m_controller;
    SelectionModel& m_selection;
    QWidget& m_viewport;
    bool m_on = false, m_visible = true;
    std::optional<render::MeshHandles> m_held; // as they were when taken, while they are
    QPointF m_from;
    glm::vec3 m_moved{0.0f}; // since
    Placements m_before;     // when they were taken
    quint64 m_session = 0;   // its undo step
};

} // namespace patina::editor
