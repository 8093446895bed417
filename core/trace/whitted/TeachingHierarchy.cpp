#include "core/trace/whitted/TeachingHierarchy.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numeric>
#include <optional>
#include <utility>

namespace patina {
namespace {

using Box = TeachingHierarchy::Box;

void grow(Box& box, const Box& by) {
    box.low = glm::min(box.low, by.low);
    box.high = glm::max(box.high, by.high);
}

// Half of it; of an empty box 0.
float area(const Box& box) {
    const glm::vec3 d = box.high - box.low;
    return d.x < 0.0f ? 0.0f : d.x * d.y + d.y * d.z + d.z * d.x;
}

// Where a ray enters a box, or nothing. Kay & Kajiya 1986, "Ray Tracing Complex Scenes": slabs.
std::optional<float> enters(const Box& box, const glm::vec3& origin, const glm::vec3& inverse,
                            float before) {
    float near = 0.0f, far = before;
    for (int axis = 0; axis < 3; ++axis) {
        float t0 = (box.low[axis] - origin[axis]) * inverse[axis];
        float t1 = (box.high[axis] - origin[axis]) * inverse[axis];
        if (t0 > t1)
            std::swap(t0, t1);
        // Written so that 0 · ∞, of a ray within a plane of the box, leaves the interval as it is.
        near = t0 > near ? t0 : near;
        far = t1 < far ? t1 : far;
    }
    return near <= far ? std::optional(near) : std::nullopt;
}

struct Division {
    float cost = 0.0f; // of tests, relative to those of a triangle
    int axis = 0, bin = 0;
};

} // namespace

TeachingHierarchy TeachingHierarchy::build(const BakeGeometry& geometry, const JobContext& job) {
    TeachingHierarchy result;
    std::vector<Triangle> triangles;
    std::vector<Box> bounds;
    triangles.reserve(geometry.triangleCount());
    bounds.reserve(geometry.triangleCount());
    for (const BakeGeometryMesh& mesh : geometry.meshes) {
        const std::vector<std::uint32_t>& indices = mesh.mesh->indices;
        for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
            const glm::vec3 &a = mesh.positions[indices[i]], &b = mesh.positions[indices[i + 1]],
                            &c = mesh.positions[indices[i + 2]];
            triangles.push_back({a, b - a, c - a});
            bounds.push_back({glm::min(glm::min(a, b), c), glm::max(glm::max(a, b), c)});
        }
    }
    std::vector<std::uint32_t> order(triangles.size());
    std::iota(order.begin(), order.end(), 0u);
    if (order.empty())
        return result;

    const auto centre = [&](std::uint32_t triangle, int axis) {
        return 0.5f * (bounds[triangle].low[axis] + bounds[triangle].high[axis]);
    };
    result.m_nodes.push_back({{}, 0, static_cast<std::uint32_t>(order.size()), 0});
    // Nodes are appended as they are divided, and each is looked at once.
    for (std::size_t n = 0; n < result.m_nodes.size() && !job.cancelled(); ++n) {
        Node node = result.m_nodes[n];
        Box centres;
        for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
            grow(node.box, bounds[order[i]]);
            const glm::vec3 c = 0.5f * (bounds[order[i]].low + bounds[order[i]].high);
            grow(centres, {c, c});
        }
        result.m_levels = std::max(result.m_levels, node.level + 1);
        result.m_nodes[n] = node;
        const glm::vec3 extent = centres.high - centres.low;
        const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0
                         : extent.y >= extent.z                       ? 1
                                                                      : 2;
        if (node.count <= kLeaf || !(extent[axis] > 0.0f))
            continue;

        const float scale = static_cast<float>(kBins) / extent[axis];
        const auto binOf = [&](std::uint32_t triangle) {
            const float at = (centre(triangle, axis) - centres.low[axis]) * scale;
            return std::clamp(static_cast<int>(at), 0, kBins - 1);
        };
        std::array<Box, kBins> boxes;
        std::array<std::uint32_t, kBins> counts{};
        for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
            const auto bin = static_cast<std::size_t>(binOf(order[i]));
            grow(boxes[bin], bounds[order[i]]);
            ++counts[bin];
        }
        std::array<float, kBins> costs{};
        const auto sweep = [&](bool forwards) {
            Box box;
            std::uint32_t count = 0;
            for (int i = 0; i + 1 < kBins; ++i) {
                const auto bin = static_cast<std::size_t>(forwards ? i : kBins - 1 - i);
                grow(box, boxes[bin]);
                count += counts[bin];
                costs[forwards ? bin : bin - 1] += area(box) * static_cast<float>(count);
            }
        };
        sweep(true);
        sweep(false);
        Division best{std::numeric_limits<float>::infinity(), axis, 0};
        for (int bin = 0; bin + 1 < kBins; ++bin)
            if (costs[static_cast<std::size_t>(bin)] < best.cost)
                best = {costs[static_cast<std::size_t>(bin)], axis, bin};
        const auto middle =
            std::partition(order.begin() + node.first, order.begin() + node.first + node.count,
                           [&](std::uint32_t triangle) { return binOf(triangle) <= best.bin; });
        const auto left = static_cast<std::uint32_t>(middle - order.begin()) - node.first;
        if (left == 0 || left == node.count)
            continue;
        const auto children = static_cast<std::uint32_t>(result.m_nodes.size());
        result.m_nodes.push_back({{}, node.first, left, node.level + 1});
        result.m_nodes.push_back({{}, node.first + left, node.count - left, node.level + 1});
        result.m_nodes[n].first = children;
        result.m_nodes[n].count = 0;
    }
    result.m_triangles.reserve(order.size());
    for (const std::uint32_t triangle : order)
        result.m_triangles.push_back(triangles[triangle]);
    return result;
}

TeachingHierarchy::Tests TeachingHierarchy::count(const glm::vec3& origin,
                                                  const glm::vec3& direction,
                                                  float distance) const {
    Tests tests;
    if (m_nodes.empty())
        return tests;
    const glm::vec3 inverse = 1.0f / direction;
    // Both children of a node at most, one of which is followed: no more than its levels.
    std::vector<std::pair<float, std::uint32_t>> open;
    open.reserve(static_cast<std::size_t>(m_levels) + 1);
    ++tests.boxes;
    if (const auto near = enters(m_nodes[0].box, origin, inverse, distance))
        open.emplace_back(*near, 0u);
    while (!open.empty()) {
        const auto [near, index] = open.back();
        open.pop_back();
        if (near > distance)
            continue;
        const Node& node = m_nodes[index];
        if (node.count == 0) {
            tests.boxes += 2;
            const auto a = enters(m_nodes[node.first].box, origin, inverse, distance);
            const auto b = enters(m_nodes[node.first + 1].box, origin, inverse, distance);
            const bool bFirst = a && b && *b < *a;
            if (a && !bFirst && b)
                open.emplace_back(*b, node.first + 1);
            if (a)
                open.emplace_back(*a, node.first);
            if (b && (bFirst || !a))
                open.emplace_back(*b, node.first + 1);
            continue;
        }
        // Möller & Trumbore 1997, "Fast, Minimum Storage Ray/Triangle Intersection".
        for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
            const Triangle& triangle = m_triangles[i];
            ++tests.triangles;
            const glm::vec3 p = glm::cross(direction, triangle.ac);
            const float determinant = glm::dot(triangle.ab, p);
            if (determinant == 0.0f)
                continue;
            const glm::vec3 from = origin - triangle.a, q = glm::cross(from, triangle.ab);
            const float u = glm::dot(from, p) / determinant,
                        v = glm::dot(direction, q) / determinant,
                        t = glm::dot(triangle.ac, q) / determinant;
            if (u >= 0.0f && v >= 0.0f && u + v <= 1.0f && t > 0.0f)
                distance = std::min(distance, t);
        }
    }
    return tests;
}

std::vector<TeachingHierarchy::Box> TeachingHierarchy::boxes(int level) const {
    std::vector<Box> result;
    for (const Node& node : m_nodes)
        if (node.level == level || (node.level < level && node.count > 0))
            result.push_back(node.box);
    return result;
}

} // namespace patina
