#include "render/scene/LightCells.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

namespace patina::render {
namespace {

constexpr int kMostCells = 48; // along an axis
constexpr double kMostEntries = 1 << 20;
// Ranges are taken this much larger, in shares of a cell: the shader rounds, too.
constexpr float kMargin = 1e-2f;

struct CellRange {
    glm::ivec3 min, max; // inclusive
};

// Those that a sphere's box touches.
CellRange cellsOf(const LightCells& cells, const glm::vec3& center, float radius) {
    const glm::vec3 top = glm::vec3(cells.size) - 0.5f;
    const auto at = [&](const glm::vec3& p) {
        return glm::ivec3(
            glm::clamp((p - cells.corner) * cells.cellsPerMetre, glm::vec3(0.0f), top));
    };
    return {at(center - radius), at(center + radius)};
}

// Cells at the border reach without end.
bool touches(const LightCells& cells, const glm::ivec3& cell, const glm::vec3& center,
             float radius) {
    constexpr float kEndless = std::numeric_limits<float>::infinity();
    glm::vec3 away(0.0f);
    for (int axis = 0; axis < 3; ++axis) {
        const float side = 1.0f / cells.cellsPerMetre;
        const float low = cells.corner[axis] + static_cast<float>(cell[axis]) * side;
        const float from = cell[axis] == 0 ? -kEndless : low;
        const float to = cell[axis] == cells.size[axis] - 1 ? kEndless : low + side;
        away[axis] = std::max({from - center[axis], center[axis] - to, 0.0f});
    }
    return glm::dot(away, away) <= radius * radius;
}

float rangeOf(const LightBlock& light) {
    return 1.0f / std::sqrt(light.color.w);
}

void setResolution(LightCells& cells, const glm::vec3& extent, int most) {
    const float longest = std::max({extent.x, extent.y, extent.z});
    cells.size = glm::ivec3(1);
    cells.cellsPerMetre = 0.0f; // one cell for everything
    if (most == 1 || !(longest > 0.0f) || !std::isfinite(longest))
        return;
    cells.cellsPerMetre = static_cast<float>(most) / longest;
    if (!std::isfinite(cells.cellsPerMetre)) {
        cells.cellsPerMetre = 0.0f;
        return;
    }
    for (int axis = 0; axis < 3; ++axis)
        cells.size[axis] =
            std::clamp(static_cast<int>(std::ceil(extent[axis] * cells.cellsPerMetre)), 1, most);
}

} // namespace

std::size_t LightCells::cellAt(const glm::vec3& position) const {
    const glm::ivec3 at(
        glm::clamp((position - corner) * cellsPerMetre, glm::vec3(0.0f), glm::vec3(size) - 0.5f));
    return (static_cast<std::size_t>(at.z) * static_cast<std::size_t>(size.y) +
            static_cast<std::size_t>(at.y)) *
               static_cast<std::size_t>(size.x) +
           static_cast<std::size_t>(at.x);
}

std::span<const std::uint32_t> LightCells::lightsAt(const glm::vec3& position) const {
    const std::size_t cell = cellAt(position);
    return std::span(lists).subspan(lists[cell], lists[cell + 1] - lists[cell]);
}

LightCells makeLightCells(std::span<const LightBlock> lights, int first, int end,
                          const Bounds& box) {
    LightCells cells;
    if (box.empty())
        return makeLightCells(lights, first, end, {glm::vec3(0.0f), glm::vec3(0.0f)});
    cells.corner = box.min;
    const std::span<const LightBlock> ranged =
        lights.subspan(static_cast<std::size_t>(first), static_cast<std::size_t>(end - first));
    const auto radiusOf = [&](const LightBlock& light) {
        const float margin = cells.cellsPerMetre > 0.0f ? kMargin / cells.cellsPerMetre : 0.0f;
        return rangeOf(light) * (1.0f + 1e-4f) + margin;
    };
    for (int most = kMostCells;; most /= 2) {
        setResolution(cells, box.size(), most);
        double entries = 0.0;
        for (const LightBlock& light : ranged) {
            const CellRange range = cellsOf(cells, glm::vec3(light.place), radiusOf(light));
            const glm::vec3 count(range.max - range.min + 1);
            entries += static_cast<double>(count.x) * count.y * count.z;
        }
        if (entries <= kMostEntries || most == 1)
            break;
    }

    // The cells of each light: counted, then listed.
    const std::size_t count = static_cast<std::size_t>(cells.size.x) *
                              static_cast<std::size_t>(cells.size.y) *
                              static_cast<std::size_t>(cells.size.z);
    const auto forEachCell = [&](const LightBlock& light, auto visit) {
        const glm::vec3 center(light.place);
        const float radius = radiusOf(light);
        const CellRange range = cellsOf(cells, center, radius);
        for (int z = range.min.z; z <= range.max.z; ++z)
            for (int y = range.min.y; y <= range.max.y; ++y)
                for (int x = range.min.x; x <= range.max.x; ++x)
                    if (cells.cellsPerMetre == 0.0f || touches(cells, {x, y, z}, center, radius))
                        visit(static_cast<std::size_t>((z * cells.size.y + y) * cells.size.x + x));
    };
    std::vector<std::uint32_t> sizes(count, 0);
    for (const LightBlock& light : ranged)
        forEachCell(light, [&](std::size_t cell) { ++sizes[cell]; });
    cells.lists.assign(count + 1, 0);
    auto begin = static_cast<std::uint32_t>(count + 1);
    for (std::size_t cell = 0; cell <= count; ++cell) {
        cells.lists[cell] = begin;
        begin += cell < count ? sizes[cell] : 0;
    }
    cells.lists.resize(begin);
    std::vector<std::uint32_t> next(cells.lists.begin(),
                                    cells.lists.begin() + static_cast<std::ptrdiff_t>(count));
    for (int i = first; i < end; ++i)
        forEachCell(lights[static_cast<std::size_t>(i)], [&](std::size_t cell) {
            cells.lists[next[cell]++] = static_cast<std::uint32_t>(i);
        });
    return cells;
}

} // namespace patina::render
