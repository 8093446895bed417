#include "core/mesh/CoarseMesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numeric>
#include <span>

namespace patina {
namespace {

constexpr float kMaxCells = 512.0f; // along a side: keys have 3 · 10 bits

bool before(const glm::vec3& a, const glm::vec3& b) {
    return std::array{a.x, a.y, a.z} < std::array{b.x, b.y, b.z};
}

// Where all vertices of a cell go: those of them that lie at one position. A position with several
// vertices is on a seam and wins, for it has one for either side; else the one nearest the middle.
// Sorts the cell's vertices by position.
std::span<const std::uint32_t> meetingPoint(const Mesh& mesh, std::span<std::uint32_t> cell) {
    const auto& at = mesh.positions;
    std::sort(cell.begin(), cell.end(), [&](std::uint32_t a, std::uint32_t b) {
        return at[a] != at[b] ? before(at[a], at[b]) : a < b;
    });
    glm::vec3 middle(0.0f);
    for (const std::uint32_t vertex : cell)
        middle += at[vertex] / static_cast<float>(cell.size());
    std::span<const std::uint32_t> best;
    float bestDistance = 0.0f;
    for (std::size_t begin = 0, end = 0; begin < cell.size(); begin = end) {
        while (end < cell.size() && at[cell[end]] == at[cell[begin]])
            ++end;
        const float distance = glm::distance(at[cell[begin]], middle);
        if (end - begin > best.size() || (end - begin == best.size() && distance < bestDistance)) {
            best = cell.subspan(begin, end - begin);
            bestDistance = distance;
        }
    }
    return best;
}

// Of the vertices at the meeting point, the one on the same side of seams.
std::uint32_t likest(const Mesh& mesh, std::uint32_t vertex,
                     std::span<const std::uint32_t> candidates) {
    const auto unlike = [&](std::uint32_t other) {
        const glm::vec2 uv = mesh.uvs[vertex] - mesh.uvs[other];
        const glm::vec3 normal = mesh.normals[vertex] - mesh.normals[other];
        return glm::dot(uv, uv) + glm::dot(normal, normal);
    };
    return *std::min_element(
        candidates.begin(), candidates.end(),
        [&](std::uint32_t a, std::uint32_t b) { return unlike(a) < unlike(b); });
}

} // namespace

std::vector<std::uint32_t> coarseTriangles(const Mesh& mesh, float cellSize) {
    const std::size_t count = mesh.vertexCount();
    const Bounds bounds = mesh.bounds();
    if (count == 0)
        return {};
    // Finite positions may lie further apart than floats reach, or so close that no float is their
    // 64th part: such meshes keep their triangles.
    const glm::vec3 extent = bounds.max - bounds.min;
    const float along = std::max({extent.x, extent.y, extent.z}) / cellSize;
    if (!(cellSize > 0.0f && along <= kMaxCells))
        return {};

    // Vertices by cell.
    std::vector<std::uint32_t> cells(count), order(count);
    for (std::size_t i = 0; i < count; ++i) {
        const glm::uvec3 cell((mesh.positions[i] - bounds.min) / cellSize);
        cells[i] = (cell.z << 20) | (cell.y << 10) | cell.x;
    }
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(), order.end(),
              [&](std::uint32_t a, std::uint32_t b) { return cells[a] < cells[b]; });

    std::vector<std::uint32_t> target(count);
    for (std::size_t begin = 0, end = 0; begin < count; begin = end) {
        while (end < count && cells[order[end]] == cells[order[begin]])
            ++end;
        const std::span<std::uint32_t> cell(order.data() + begin, end - begin);
        const auto meeting = meetingPoint(mesh, cell);
        for (const std::uint32_t vertex : cell)
            target[vertex] = likest(mesh, vertex, meeting);
    }

    std::vector<std::uint32_t> result;
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        const std::uint32_t a = mesh.indices[i], b = mesh.indices[i + 1], c = mesh.indices[i + 2];
        if (cells[a] != cells[b] && cells[b] != cells[c] && cells[c] != cells[a])
            result.insert(result.end(), {target[a], target[b], target[c]});
    }
    return result;
}

} // namespace patina
