#include "app/editor/viewport/FlyKeys.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace patina::editor {
namespace {

constexpr double kStepMs = 16.0; // a flying camera moves 60 times a second

} // namespace

FlyKeys::FlyKeys(FrameSchedule& schedule, QObject* parent)
    : QObject(parent)
    , m_schedule(schedule)
    , m_flight(schedule, kStepMs, [this] {
        step();
        return false; // the next one is due whether or not this is painted
    }) {}

bool FlyKeys::fliesWith(int key) {
    return key == Qt::Key_W || key == Qt::Key_A || key == Qt::Key_S || key == Qt::Key_D ||
           key == Qt::Key_Q || key == Qt::Key_E;
}

void FlyKeys::press(int key) {
    if (m_keys.empty()) {
        m_since = m_schedule.now();
        m_flight.start();
    }
    m_keys.insert(key);
}

void FlyKeys::release(int key) {
    m_keys.erase(key);
    if (m_keys.empty())
        m_flight.stop();
}

void FlyKeys::releaseAll() {
    m_keys.clear();
    m_flight.stop();
}

void FlyKeys::changeSpeed(float steps) {
    m_speed = std::clamp(m_speed * std::pow(1.25f, steps), 0.02f, 50.0f);
}

void FlyKeys::step() {
    const double now = m_schedule.now();
    const double seconds = (now - std::exchange(m_since, now)) * 1e-3;
    const auto held = [this](int key) { return m_keys.count(key) ? 1.0f : 0.0f; };
    const glm::vec3 direction(held(Qt::Key_D) - held(Qt::Key_A), held(Qt::Key_E) - held(Qt::Key_Q),
                              held(Qt::Key_W) - held(Qt::Key_S));
    // A stalled event loop must not catapult the camera.
    Q_EMIT flown(m_speed * static_cast<float>(std::min(seconds, 0.1)) * direction);
}

} // namespace patina::editor
