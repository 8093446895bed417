// Focus Here: while the action is checked, a click in the viewport puts the plane in focus through
// what is there; one undo step.
#pragma once

#include <QObject>

class QAction;
class QPointF;

namespace patina::editor {

class DocumentController;
class ViewportWidget;

class FocusPicker : public QObject {
    Q_OBJECT
  public:
    // Owned by the viewport.
    FocusPicker(DocumentController& controller, ViewportWidget& viewport, QAction& action);

  protected:
    bool eventFilter(QObject* viewport, QEvent* event) override;

  private:
    void focusAt(const QPointF& position);

    DocumentController& m_controller;
    ViewportWidget& m_viewport;
    QAction& m_action;
};

} // namespace patina::editor
