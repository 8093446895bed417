// The keys that fly the camera while they are held: W A S D Q E, sixty steps a second.
#pragma once

#include "app/editor/viewport/FrameSchedule.h"

#include <QObject>
#include <glm/vec3.hpp>
#include <set>

namespace patina::editor {

class FlyKeys : public QObject {
    Q_OBJECT
  public:
    explicit FlyKeys(FrameSchedule& schedule, QObject* parent = nullptr);

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

    FrameSchedule& m_schedule;
    FrameSchedule::Animation m_flight;
    double m_since = 0.0; // of the schedule's clock: the last step
    std::set<int> m_keys;
    float m_speed = 1.0f; // scene radii per second
};

} // namespace patina::editor
