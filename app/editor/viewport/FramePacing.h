// Keeps the viewport fluid on a slow GPU: while the hand moves, frames are drawn at a reduced
// resolution chosen from the measured frame time; when it rests, once at full quality.
#pragma once

namespace patina::editor {

class FramePacing {
  public:
    // Side length relative to the widget's: 1, ¾, ½ or 3⁄8.
    [[nodiscard]] float scale() const;
    [[nodiscard]] int samples() const { return m_moving ? 1 : 4; } // MSAA
    [[nodiscard]] bool moving() const { return m_moving; }

    void beginMoving() { m_moving = true; }
    void rest() { m_moving = false; }
    // Milliseconds of the last frame, GPU included. Only moving frames steer the resolution.
    void frameTook(double milliseconds);

  private:
    bool m_moving = false;
    int m_level = 0; // index into the scales
    int m_fastFrames = 0;
};

} // namespace patina::editor
