// A mixing desk's fader: upright, in EV, with a scale and, beside it, the meter of what comes out.
#pragma once

#include "app/editor/widget/EditControl.h"

#include <QAbstractSlider>

namespace patina::editor {

// Up and down are a tenth of an EV, page up and page down one, Home and a double-click go to 0.
class Fader : public QAbstractSlider, public EditControl {
    Q_OBJECT
  public:
    static constexpr double kMaxEv = 6.0; // the scale's ends; values beyond stand there

    explicit Fader(QWidget* parent = nullptr);

    void setEv(double ev);       // shows, emits nothing
    void setLevel(double share); // of the meter, 0…1
    [[nodiscard]] QSize sizeHint() const override;
    [[nodiscard]] QSize minimumSizeHint() const override;
    [[nodiscard]] QPoint handle() const; // its centre
    void abandonEdit() override;

  Q_SIGNALS:
    void dragStarted();
    void dragged(double ev);
    void dragFinished();
    void stepped(double ev); // keys and wheel
    void edited(double ev);  // Home, double-click

  protected:
    void paintEvent(QPaintEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;
    void mouseMoveEvent(QMouseEvent* event) override;
    void mouseReleaseEvent(QMouseEvent* event) override;
    void mouseDoubleClickEvent(QMouseEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;
    void wheelEvent(QWheelEvent* event) override;
    void enterEvent(QEnterEvent* event) override;
    void leaveEvent(QEvent* event) override;

  private:
    [[nodiscard]] double position(double ev) const; // y of a value
    void dragTo(double y);
    void stepBy(int units);

    double m_ev = 0.0, m_level = 0.0;
    double m_grab = 0.0, m_pressY = 0.0, m_startEv = 0.0;
};

} // namespace patina::editor
