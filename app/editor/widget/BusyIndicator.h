// A turning arc beside what is going on; invisible when nothing is.
#pragma once

#include <QElapsedTimer>
#include <QTimer>
#include <QWidget>

class QLabel;

namespace patina::editor {

class BusyIndicator : public QWidget {
    Q_OBJECT
  public:
    explicit BusyIndicator(QWidget* parent = nullptr);
    // `activity` as it is shown; empty: idle. `action`: what a click does; empty: nothing.
    void setActivity(const QString& activity, const QString& action = {});
    [[nodiscard]] QString activity() const;
    // Milliseconds between two steps of the arc, when the window takes `frameMs` to show one: with
    // software OpenGL all of it is put together anew, which would take the time of what goes on.
    [[nodiscard]] static int stepMs(double frameMs);

  Q_SIGNALS:
    void clicked();

  protected:
    void mouseReleaseEvent(QMouseEvent* event) override;
    void paintEvent(QPaintEvent* event) override;

  private:
    void turn();
    void shown();

    QLabel* m_text;
    QTimer m_timer;
    QElapsedTimer m_frame; // since the arc was painted, until that is shown
    bool m_turned = false; // and not painted yet
    int m_angleDeg = 0;
};

} // namespace patina::editor
