#include "core/light/LobeTable.h"

#include "core/math/Shading.h"

#include <algorithm>
#include <array>

namespace patina {
namespace {

constexpr float kNumbers[] = {
#include "core/light/LobeTable.inc"
};
static_assert(std::size(kNumbers) == std::size_t{4} * kLobeTableSize * kLobeTableSize);

constexpr auto kTable = [] {
    std::array<glm::vec4, std::size_t{kLobeTableSize} * kLobeTableSize> table{};
    for (std::size_t i = 0; i < table.size(); ++i)
        table[i] = {kNumbers[4 * i], kNumbers[4 * i + 1], kNumbers[4 * i + 2], kNumbers[4 * i + 3]};
    return table;
}();

} // namespace

std::span<const glm::vec4> lobeTable() {
    return kTable;
}

glm::vec4 lobeFit(float perceptualRoughness, float NoV) {
    constexpr float kLast = kLobeTableSize - 1;
    const float x = std::clamp(shading::lobeAngle(NoV), 0.0f, 1.0f) * kLast;
    const float y = std::clamp(perceptualRoughness, 0.0f, 1.0f) * kLast;
    const int x0 = std::min(static_cast<int>(x), kLobeTableSize - 2);
    const int y0 = std::min(static_cast<int>(y), kLobeTableSize - 2);
    const auto at = [](int i, int j) {
        return kTable[static_cast<std::size_t>(j * kLobeTableSize + i)];
    };
    const float fx = x - static_cast<float>(x0), fy = y - static_cast<float>(y0);
    return glm::mix(glm::mix(at(x0, y0), at(x0 + 1, y0), fx),
                    glm::mix(at(x0, y0 + 1), at(x0 + 1, y0 + 1), fx), fy);
}

} // namespace patina
