#include "app/editor/viewport/FramePacing.h"

#include <algorithm>
#include <array>

namespace patina::editor {
namespace {

constexpr std::array kScales = {1.0f, 0.75f, 0.5f, 0.375f};
constexpr double kSlowMs = 38.0; // under 26 frames per second a drag feels sticky
constexpr double kFastMs = 14.0; // room for the next finer scale (at most 1.8 times the pixels)
constexpr int kFastFramesBeforeFiner = 12; // so that the resolution does not flicker

} // namespace

float FramePacing::scale() const {
    return m_moving ? kScales[static_cast<std::size_t>(m_level)] : 1.0f;
}

void FramePacing::frameTook(double milliseconds) {
    if (!m_moving)
        return;
    const int coarsest = static_cast<int>(kScales.size()) - 1;
    if (milliseconds > kSlowMs) {
        // Far too slow: skip a level.
        m_level = std::min(m_level + (milliseconds > 2.0 * kSlowMs ? 2 : 1), coarsest);
        m_fastFrames = 0;
    } else if (milliseconds < kFastMs && m_level > 0) {
        if (++m_fastFrames >= kFastFramesBeforeFiner) {
            --m_level;
            m_fastFrames = 0;
        }
    } else {
        m_fastFrames = 0;
    }
}

} // namespace patina::editor
