#include "core/light/DfgLookup.h"

#include <algorithm>
#include <glm/common.hpp>
#include <utility>

namespace patina {

glm::vec3 lookUpDfg(const Image& table, float NoV, float perceptualRoughness) {
    const auto axis = [](float at, int size) {
        const float texel =
            std::clamp(at * static_cast<float>(size) - 0.5f, 0.0f, static_cast<float>(size - 1));
        const int first = std::min(static_cast<int>(texel), std::max(0, size - 2));
        return std::pair(first, texel - static_cast<float>(first));
    };
    const auto [x, fx] = axis(NoV, table.width());
    const auto [y, fy] = axis(perceptualRoughness, table.height());
    const auto at = [&, x = x, y = y](int i, int j) {
        return glm::vec3(table.sample(x + i, y + j, 0), table.sample(x + i, y + j, 1),
                         table.sample(x + i, y + j, 2));
    };
    return glm::mix(glm::mix(at(0, 0), at(1, 0), fx), glm::mix(at(0, 1), at(1, 1), fx), fy);
}

} // namespace patina
