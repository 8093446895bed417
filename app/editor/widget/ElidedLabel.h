// A line of text that gives way: what does not fit is left out in the middle.
#pragma once

#include <QLabel>

namespace patina::editor {

class ElidedLabel : public QLabel {
    Q_OBJECT
  public:
    explicit ElidedLabel(QWidget* parent = nullptr);
    [[nodiscard]] QSize minimumSizeHint() const override;

  protected:
    void paintEvent(QPaintEvent* event) override;
};

} // namespace patina::editor
