// Lights in the hand: finds their marks and handles in the viewport; moves, aims and turns the one
// that was taken hold of, as one undo step, and takes it back.
#pragma once

#include "core/document/Document.h"
#include "render/scene/LightGizmo.h"

#include <QCoreApplication>
#include <QPointF>

class QWidget;

namespace patina::editor {

class DocumentController;
class SelectionModel;

class LightDrag {
    Q_DECLARE_TR_FUNCTIONS(LightDrag)
  public:
    // Positions are in `viewport`'s pixels, y down.
    LightDrag(DocumentController& controller, SelectionModel& selection, QWidget& viewport);

    void setVisible(bool visible) { m_visible = visible; } // hidden handles cannot be taken

    [[nodiscard]] bool isOver(const QPointF& position) const; // a mark or a handle
    bool takeAt(const QPointF& position); // selects the light whose mark or handle is there
    bool takeSelected();                  // to turn it; false when no light is selected

    // By the movement since the last call, of the mark or handle that was taken.
    void drag(const QPointF& pixels);
    void turn(const QPointF& pixels); // about the scene
    void cancel();                    // back to where the drag began
    void letGo();

  private:
    [[nodiscard]] render::GizmoHit hitAt(const QPointF& position) const;
    void take(const Light& light, render::GizmoHandle handle);

    DocumentController& m_controller;
    SelectionModel& m_selection;
    QWidget& m_viewport;
    bool m_visible = true;
    render::GizmoHandle m_handle = render::GizmoHandle::None;
    Light m_before;        // the light when it was taken
    quint64 m_session = 0; // its undo step
};

} // namespace patina::editor
