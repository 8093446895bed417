// The status bar: a message that is longer than its place ends in an ellipsis.
#pragma once

#include <QStatusBar>

namespace patina::editor {

class MessageBar : public QStatusBar {
    Q_OBJECT
  public:
    using QStatusBar::QStatusBar;
    // The message as far as it fits; empty without one.
    [[nodiscard]] QString shownMessage() const;

  protected:
    void paintEvent(QPaintEvent* event) override;

  private:
    [[nodiscard]] QRect messageRect() const; // left of the widgets
};

} // namespace patina::editor
