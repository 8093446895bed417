// Points of a scene by number, whoever asks for them: two that are nearer than kSamePoint are one.
#pragma once

#include "core/radiosity/ElementMesh.h"

#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <unordered_map>
#include <vector>

namespace patina::radiosity {

class PointIndex {
  public:
    static constexpr double kSamePoint = 2e-6; // scene units

    [[nodiscard]] const glm::dvec3& position(std::uint32_t point) const {
        return m_positions[point];
    }
    [[nodiscard]] std::uint32_t find(const glm::dvec3& position) const { // or kNone
        // Cells are twice as large as the distance, so that eight of them have all that is near.
        const glm::dvec3 scaled = position / (2.0 * kSamePoint);
        const glm::dvec3 low(std::floor(scaled.x - 0.5), std::floor(scaled.y - 0.5),
                             std::floor(scaled.z - 0.5));
        for (int k = 0; k < 8; ++k) {
            const auto cell = m_cells.find(hash(low + glm::dvec3(k & 1, k >> 1 & 1, k >> 2 & 1)));
            if (cell == m_cells.end())
                continue;
            for (const std::uint32_t point : cell->second)
                if (glm::length(m_positions[point] - position) < kSamePoint)
                    return point;
        }
        return kNone;
    }
    std::uint32_t add(const glm::dvec3& position) {
        const std::uint32_t known = find(position);
        if (known != kNone)
            return known;
        const glm::dvec3 scaled = position / (2.0 * kSamePoint);
        const auto point = static_cast<std::uint32_t>(m_positions.size());
        m_positions.push_back(position);
        m_cells[hash({std::floor(scaled.x), std::floor(scaled.y), std::floor(scaled.z)})].push_back(
            point);
        return point;
    }

  private:
    static std::uint64_t hash(const glm::dvec3& cell) {
        std::uint64_t h = 0;
        for (int c = 0; c < 3; ++c) {
            h ^= static_cast<std::uint64_t>(static_cast<std::int64_t>(cell[c]));
            h *= 0x9e3779b97f4a7c15ull;
            h ^= h >> 29;
        }
        return h;
    }

    std::vector<glm::dvec3> m_positions;
    std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> m_cells;
};

} // namespace patina::radiosity
