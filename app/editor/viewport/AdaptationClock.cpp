#include "app/editor/viewport/AdaptationClock.h"

#include <algorithm>

namespace patina::editor {

float AdaptationClock::beginFrame(double now) {
    const double seconds = m_running ? std::max(now - m_lastFrame, 0.0) : 0.0;
    m_lastFrame = now;
    return static_cast<float>(seconds);
}

bool AdaptationClock::endFrame(const std::optional<Luminance>& luminance, bool automatic) {
    m_running = automatic && luminance && luminance->adapting();
    return m_running;
}

} // namespace patina::editor
