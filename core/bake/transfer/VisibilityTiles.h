// Points that see much the same: neighbours on a surface whose normals point the same way, within
// which a ray that meets something at every rim may be taken to do so in between, too.
#pragma once

#include "core/bake/transfer/Passes.h"

#include <cstdint>
#include <span>
#include <vector>

namespace patina {

class VisibilityTiles {
  public:
    static constexpr std::size_t kMaxPoints = 32; // of a tile

    // Depends on the points alone.
    VisibilityTiles(std::span<const BakePoint> points, std::uint32_t seed);

    [[nodiscard]] std::size_t count() const { return m_begin.size() - 1; }
    // The numbers of the points of a tile; every point is in one tile.
    [[nodiscard]] std::span<const std::uint32_t> points(std::size_t tile) const {
        return std::span(m_points).subspan(m_begin[tile], m_begin[tile + 1] - m_begin[tile]);
    }
    // The seed of the directions that a point shares with its tile.
    [[nodiscard]] std::uint32_t seedOf(std::size_t point) const { return m_seeds[point]; }

  private:
    std::vector<std::uint32_t> m_points, m_begin, m_seeds;
};

// Which of a few points lie at the rim: those farthest out in sixteen directions along the surface.
void findRim(std::span<const BakePoint> points, std::span<const std::uint32_t> tile,
             std::vector<std::uint8_t>& isRim);

} // namespace patina
