// Marks that must not be missed appear and fade, twice a second.
#pragma once

#include <QObject>
#include <QTimer>

namespace patina::editor {

class Blink : public QObject {
    Q_OBJECT
  public:
    explicit Blink(QObject* parent = nullptr);

    void setActive(bool active); // at rest the marks are at full strength
    [[nodiscard]] bool isActive() const { return m_timer.isActive(); }
    [[nodiscard]] float strength() const { return m_faded ? 0.15f : 1.0f; }

  Q_SIGNALS:
    void turned();

  private:
    QTimer m_timer;
    bool m_faded = false;
};

} // namespace patina::editor
