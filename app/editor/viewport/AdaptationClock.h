// The time that an eye has had to get used to the picture: it runs from frame to frame while there
// is something to get used to, and stands still while the viewport rests.
#pragma once

#include "core/document/ToneResponse.h"

#include <optional>

namespace patina::editor {

class AdaptationClock {
  public:
    // `now` in seconds on any steady clock. Seconds since the last frame; 0 when it was at rest, so
    // that what changed after a long rest is seen coming.
    [[nodiscard]] float beginFrame(double now);
    // What the renderer knows after the frame. Returns whether another frame is due.
    bool endFrame(const std::optional<Luminance>& luminance, bool automatic);

    [[nodiscard]] bool running() const { return m_running; }

  private:
    double m_lastFrame = 0.0;
    bool m_running = false;
};

} // namespace patina::editor
