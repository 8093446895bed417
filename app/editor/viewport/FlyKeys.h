// The keys that fly the camera while they are held: W A S D Q E, sixty steps a second.
#pragma once

#include <QElapsedTimer>
#include <QObject>
#include <QTimer>
#include <glm/vec3.hpp>
#include <set>

namespace patina::editor {

class FlyKeys : public QObject {
    Q_OBJECT
  public:
    explicit FlyKeys(QObject* parent = nullptr);

    [[nodiscard]] static bool fliesWith(int key);
    [[nodiscard]] bool held() const { return !m_keys.empty(); } // any of them

    void press(int key);
    void release(int key);
    void releaseAll();
    void changeSpeed(float steps); // a quarter faster per step

  Q_SIGNALS:
    // Since the last one: x right, y up, z forward, in scene radii.
    void flown(const glm::vec3& radii);

  private:
    void step();

    QTimer m_timer;
    QElapsedTimer m_clock;
    std::set<int> m_keys;
    float m_speed = 1.0f; // scene radii per second
};

} // namespace patina::editor
