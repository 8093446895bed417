// A turning arc beside what is going on; invisible when nothing is.
#pragma once

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

  Q_SIGNALS:
    void clicked();

  protected:
    void mouseReleaseEvent(QMouseEvent* event) override;
    void paintEvent(QPaintEvent* event) override;

  private:
    QLabel* m_text;
    QTimer m_timer;
    int m_angleDeg = 0;
};

} // namespace patina::editor
