// Which of many lights reach where: the scene's box in cells, each with the lights whose range
// touches it.
#pragma once

#include "core/math/Bounds.h"
#include "render/scene/Blocks.h"

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace patina::render {

struct LightCells {
    glm::ivec3 size{1};     // cells along x, y, z
    glm::vec3 corner{0.0f}; // metres
    float cellsPerMetre = 0.0f;
    // The beginning of each cell's list in this vector and of what follows the last; then the
    // lists, ascending. Cell (x, y, z) is number (z size.y + y) size.x + x. What lies outside of
    // the box counts to the cell that is nearest.
    std::vector<std::uint32_t> lists;

    // By the formula of surface.frag.
    [[nodiscard]] std::size_t cellAt(const glm::vec3& position) const;
    [[nodiscard]] std::span<const std::uint32_t> lightsAt(const glm::vec3& position) const;
};

// The lights `first` … `end` - 1, which have a range (LightBlock::color.w), in the box. So many
// cells that the lists stay within some 4 MB, fewer where ranges are large.
[[nodiscard]] LightCells makeLightCells(std::span<const LightBlock> lights, int first, int end,
                                        const Bounds& box);

} // namespace patina::render
