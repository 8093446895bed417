#include "app/editor/viewport/FramePacing.h"

#include <algorithm>
#include <array>

namespace patina::editor {
namespace {

constexpr std::array kScales = {1.0f, 0.8f, 0.65f, 0.5f, 0.4f, 1.0f / 3.0f, 0.25f};
// 24 frames per second leave 41 ms, of which Qt takes 16 to put the window together on two cores.
constexpr double kSlowMs = 25.0;
constexpr double kFastMs = 13.0; // room for the next finer scale (at most 1.8 times the pixels)
constexpr int kFastFramesBeforeFiner = 12; // so that the resolution does not flicker
constexpr double kAlwaysMs = 12.0;         // anti-aliased frames this fast need no pacing at all
constexpr double kAffordableMs = 170.0;    // slower ones would triple to a hitch of half a second
// Frames that are added up are drawn in slices: above kAffordableMs they are no hitch either. Eight
// slower ones than this would keep the processors busy for longer than 2 s.
constexpr double kAddedMs = 250.0;
constexpr double kPieceMs = 20.0;     // frames at rest this fast are drawn in one piece
constexpr double kAntialiasing = 3.0; // what it multiplies the cost of a frame by, about

} // namespace

float FramePacing::scale() const {
    return moving() ? kScales[static_cast<std::size_t>(m_level)] : 1.0f;
}

bool FramePacing::accumulating() const {
    if (moving())
        return false;
    return m_hasLens || (m_accumulates && (m_addsSlowFrames || m_adds));
}

double FramePacing::expectedMs() const {
    if (samples() == 1)
        return m_expectedMs;
    return m_antialiasedMs >= 0.0 ? m_antialiasedMs : kAntialiasing * m_expectedMs;
}

bool FramePacing::slices() const {
    return !moving() && expectedMs() > kPieceMs;
}

int FramePacing::samples() const {
    if (m_accumulates || m_hasLens)
        return 1;
    const bool fast = m_antialiasedMs >= 0.0 && m_antialiasedMs < kAlwaysMs && m_level == 0;
    return fast || m_stage == Stage::Antialiased ? 4 : 1;
}

void FramePacing::beginMoving() {
    if (moving())
        return;
    m_stage = Stage::Moving;
    // The cost of a frame goes with its pixels.
    const auto expectedMs = [this](int level) {
        const double scale = static_cast<double>(kScales[static_cast<std::size_t>(level)]);
        return m_fullMs * scale * scale;
    };
    const int coarsest = static_cast<int>(kScales.size()) - 1;
    while (m_level < coarsest && expectedMs(m_level) > kSlowMs)
        ++m_level;
}

bool FramePacing::refine() {
    if (m_stage == Stage::Moving) {
        m_stage = Stage::FullResolution;
        beginPicture();
        return true;
    }
    if (!refined()) {
        m_stage = Stage::Antialiased;
        return true;
    }
    return false;
}

bool FramePacing::refined() const {
    return m_stage == Stage::Antialiased ||
           (m_stage == Stage::FullResolution && (m_accumulates || m_fullMs >= kAffordableMs));
}

void FramePacing::beginPicture() {
    m_adds = m_fullMs < kAddedMs;
}

void FramePacing::pictureChanged() {
    beginPicture();
    if (m_stage == Stage::Antialiased)
        m_stage = Stage::FullResolution;
}

void FramePacing::frameTook(double milliseconds) {
    if (samples() > 1) {
        m_antialiasedMs = milliseconds;
    } else if (m_stage == Stage::FullResolution) {
        m_fullMs = milliseconds;
        m_adds = m_adds || m_fullMs < kAddedMs;
    }
    const auto side = static_cast<double>(scale());
    if (samples() == 1)
        m_expectedMs = milliseconds / (side * side);
    if (!moving())
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
