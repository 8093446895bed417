#include "core/bake/transfer/VisibilityTiles.h"

#include "core/math/Sampling.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace patina {
namespace {

// The 20 lowest bits of x, with two zeros after each.
constexpr std::uint64_t spreadBits(std::uint64_t x) {
    x = (x | (x << 32)) & 0x000f00000000ffffull;
    x = (x | (x << 16)) & 0x000f0000ff0000ffull;
    x = (x | (x << 8)) & 0x000f00f00f00f00full;
    x = (x | (x << 4)) & 0x00c30c30c30c30c3ull;
    return (x | (x << 2)) & 0x0249249249249249ull;
}

// The face of a cube that the normal points through, 0 … 5.
std::uint64_t sideOf(const glm::vec3& normal) {
    const glm::vec3 size = glm::abs(normal);
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    return static_cast<std::uint64_t>(2 * axis + (normal[axis] < 0.0f ? 1 : 0));
}

struct Place {
    std::uint64_t key; // side, then the place on a Z-curve through the scene
    std::uint32_t point;
};

} // namespace

VisibilityTiles::VisibilityTiles(std::span<const BakePoint> points, std::uint32_t seed)
    : m_points(points.size())
    , m_seeds(points.size()) {
    constexpr float kCells = 1u << 20;
    std::vector<Place> places(points.size());
    for (std::uint32_t p = 0; p < points.size(); ++p) {
        const glm::uvec3 cell(
            glm::clamp((points[p].origin + 1.0f) * (0.5f * kCells), 0.0f, kCells - 1.0f));
        places[p] = {(sideOf(points[p].normal) << 60) | spreadBits(cell.x) |
                         (spreadBits(cell.y) << 1) | (spreadBits(cell.z) << 2),
                     p};
    }
    std::ranges::sort(places, [](const Place& a, const Place& b) {
        return a.key != b.key ? a.key < b.key : a.point < b.point;
    });
    for (std::size_t i = 0; i < places.size(); ++i) {
        const bool begins = m_begin.empty() || i - m_begin.back() == kMaxPoints ||
                            (places[i].key >> 60) != (places[i - 1].key >> 60);
        if (begins)
            m_begin.push_back(static_cast<std::uint32_t>(i));
        m_points[i] = places[i].point;
        m_seeds[places[i].point] =
            begins ? seedFor(seed, places[i].point) : m_seeds[places[i - 1].point];
    }
    m_begin.push_back(static_cast<std::uint32_t>(places.size()));
}

void findRim(std::span<const BakePoint> points, std::span<const std::uint32_t> tile,
             std::vector<std::uint8_t>& isRim) {
    glm::vec3 sum(0.0f), t, b;
    for (const std::uint32_t p : tile)
        sum += points[p].normal;
    orthonormalBasis(glm::normalize(sum), t, b); // all on one side of a cube: the sum is not zero
    isRim.assign(tile.size(), 0);
    constexpr int kDirections = 16;
    for (int k = 0; k < kDirections; ++k) {
        const float angle = 2.0f * std::numbers::pi_v<float> * static_cast<float>(k) / kDirections;
        const glm::vec3 outwards = std::cos(angle) * t + std::sin(angle) * b;
        const auto farthest = std::ranges::max_element(
            tile, {}, [&](std::uint32_t p) { return glm::dot(outwards, points[p].origin); });
        isRim[static_cast<std::size_t>(farthest - tile.begin())] = 1;
    }
}

} // namespace patina
