// A thin slider beside a number: a press on the handle takes it along, a press elsewhere jumps.
// The number field is the way for the keyboard.
#pragma once

#include "app/editor/widget/EditControl.h"

#include <QWidget>

namespace patina::editor {

class Slider : public QWidget, public EditControl {
    Q_OBJECT
  public:
    // `origin`: where the filled part begins.
    Slider(double min, double max, double origin, QWidget* parent = nullptr);

    void setValue(double value);          // shows, emits nothing; values outside stand at the end
    void setEnds(double min, double max); // min < max; it fills from `min`
    [[nodiscard]] QSize sizeHint() const override;
    [[nodiscard]] QSize minimumSizeHint() const override;
    [[nodiscard]] int handleX() const; // centre of the handle
    void abandonEdit() override;

  Q_SIGNALS:
    void dragStarted();
    void dragged(double value);
    void dragFinished();

  protected:
    void paintEvent(QPaintEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;
    void mouseMoveEvent(QMouseEvent* event) override;
    void mouseReleaseEvent(QMouseEvent* event) override;
    void enterEvent(QEnterEvent* event) override;
    void leaveEvent(QEvent* event) override;

  private:
    [[nodiscard]] double position(double value) const; // x of a value
    void moveTo(double x);

    double m_min, m_max, m_origin, m_value;
    bool m_dragging = false;
    double m_pressX = 0, m_grab = 0, m_startValue = 0;
};

} // namespace patina::editor
