// Marks that must not be missed appear and fade, twice a second.
#pragma once

namespace patina::editor {

class Blink {
  public:
    static constexpr double kTurnMs = 350.0;

    void setActive(bool active) { // at rest the marks are at full strength
        m_faded = m_faded && active;
        m_active = active;
    }
    [[nodiscard]] bool isActive() const { return m_active; }
    void turn() { m_faded = m_active && !m_faded; } // every kTurnMs
    [[nodiscard]] float strength() const { return m_faded ? 0.15f : 1.0f; }

  private:
    bool m_active = false, m_faded = false;
};

} // namespace patina::editor
