#include "core/material/MapUv.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace patina {

glm::vec4 uvMatrix(const MapSlot& map) {
    const float angle = glm::radians(map.uvRotationDeg);
    const float c = std::cos(angle), s = std::sin(angle);
    return {c * map.uvScale.x, s * map.uvScale.y, -s * map.uvScale.x, c * map.uvScale.y};
}

glm::vec2 mapUv(const MapSlot& map, const glm::vec2& uv) {
    const glm::vec4 m = uvMatrix(map);
    return glm::vec2(m.x * uv.x + m.y * uv.y, m.z * uv.x + m.w * uv.y) + map.uvOffset;
}

glm::vec4 normalBasis(const MapSlot& map) {
    const glm::vec4 m = uvMatrix(map);
    const auto unit = [](glm::vec2 d, glm::vec2 fallback) {
        const float length = glm::length(d);
        return length > 0.0f ? d / length : fallback;
    };
    const glm::vec2 x = unit({m.x, -m.y}, {1, 0});
    const glm::vec2 y = unit({-m.z, m.w}, {0, 1});
    return {x.x, y.x, x.y, y.y};
}

} // namespace patina
