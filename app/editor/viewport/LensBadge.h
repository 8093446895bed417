// Says over the viewport that its picture is a pinhole's although the camera has depth of field:
// while it moves, and in views of numbers.
#pragma once

#include "app/editor/viewport/ViewportWidget.h"

#include <QFrame>

class QLabel;

namespace patina::editor {

class DocumentController;
class PathView;
class TracedSide;
class ViewState;

class LensBadge : public QFrame {
    Q_OBJECT
  public:
    LensBadge(DocumentController& controller, const TracedSide& traced, ViewportWidget& viewport);

    [[nodiscard]] QString text() const; // empty: nothing to say

  protected:
    bool eventFilter(QObject* viewport, QEvent* event) override;

  private:
    void refresh();
    void place();

    DocumentController& m_controller;
    const TracedSide& m_traced;
    ViewportWidget& m_viewport;
    QLabel* m_text;
    PictureState m_state = PictureState::Moving; // of the last frame
};

} // namespace patina::editor
