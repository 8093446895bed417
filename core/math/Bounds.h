// An axis-aligned box.
#pragma once

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <limits>

namespace patina {

struct Bounds {
    glm::vec3 min{std::numeric_limits<float>::max()};
    glm::vec3 max{std::numeric_limits<float>::lowest()};

    [[nodiscard]] bool empty() const { return min.x > max.x; }
    void add(const glm::vec3& point) {
        min = glm::min(min, point);
        max = glm::max(max, point);
    }
    void add(const Bounds& other) {
        min = glm::min(min, other.min);
        max = glm::max(max, other.max);
    }
    [[nodiscard]] glm::vec3 center() const { return empty() ? glm::vec3(0) : 0.5f * (min + max); }
    [[nodiscard]] glm::vec3 size() const { return empty() ? glm::vec3(0) : max - min; }
    // Radius of the sphere around center() that holds the box.
    [[nodiscard]] float radius() const { return 0.5f * glm::length(size()); }

    [[nodiscard]] Bounds transformed(const glm::mat4& m) const {
        Bounds result;
        if (empty())
            return result;
        for (int corner = 0; corner < 8; ++corner)
            result.add(
                glm::vec3(m * glm::vec4(corner & 1 ? max.x : min.x, corner & 2 ? max.y : min.y,
                                        corner & 4 ? max.z : min.z, 1.0f)));
        return result;
    }
    friend bool operator==(const Bounds&, const Bounds&) = default;
};

} // namespace patina
