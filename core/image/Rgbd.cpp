#include "core/image/Rgbd.h"

#include <algorithm>
#include <cmath>

namespace patina {
namespace {

constexpr float kGamma = 2.2f;

}

std::array<std::uint8_t, 4> rgbdFromColor(const glm::vec3& color) {
    glm::vec3 c;
    for (int i = 0; i < 3; ++i)
        c[i] = color[i] > 0.0f ? std::min(color[i], kLargestRgbd) : 0.0f; // NaN too
    const float brightest = std::max({c.x, c.y, c.z, 1.0f});
    // Rounded down, so that no component passes 1.
    const float divisor = std::floor(255.0f / brightest);
    std::array<std::uint8_t, 4> rgbd{};
    for (int i = 0; i < 3; ++i) {
        const float encoded = std::pow(c[i] * divisor / 255.0f, 1.0f / kGamma);
        rgbd[static_cast<std::size_t>(i)] =
            static_cast<std::uint8_t>(std::lround(255.0f * std::min(encoded, 1.0f)));
    }
    rgbd[3] = static_cast<std::uint8_t>(divisor);
    return rgbd;
}

glm::vec3 colorFromRgbd(const std::array<std::uint8_t, 4>& rgbd) {
    glm::vec3 color;
    for (int i = 0; i < 3; ++i)
        color[i] =
            std::pow(static_cast<float>(rgbd[static_cast<std::size_t>(i)]) / 255.0f, kGamma) *
            255.0f / static_cast<float>(std::max<int>(rgbd[3], 1));
    return color;
}

} // namespace patina
