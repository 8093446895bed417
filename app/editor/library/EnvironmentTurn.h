// Rotates the environment that lights the scene, as a drag in its thumbnail does: one undo step,
// and none where it is taken back.
#pragma once

#include "core/edit/EditStep.h"

#include <QCoreApplication>

class QWidget;

namespace patina::editor {

class DocumentController;

class EnvironmentTurn {
    Q_DECLARE_TR_FUNCTIONS(EnvironmentTurn)
  public:
    // Says in the status bar of `where`'s window how far it is rotated.
    EnvironmentTurn(DocumentController& controller, QWidget& where)
        : m_controller(controller)
        , m_where(where) {}

    void begin();                // another undo step
    void turnBy(double degrees); // from where it is; positive: the picture moves to its left
    void cancel();               // to where it began

  private:
    void set(float degrees);

    DocumentController& m_controller;
    QWidget& m_where;
    DragSession m_session = 0;
    float m_beforeDeg = 0.0f;
};

} // namespace patina::editor
