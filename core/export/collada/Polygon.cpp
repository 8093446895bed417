#include "core/export/collada/Polygon.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <numeric>

namespace patina::collada {
namespace {

using Triangle = std::array<std::uint32_t, 3>;

// Twice the signed area of a triangle.
double turn(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

bool contains(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c, const glm::dvec2& p) {
    return turn(a, b, p) >= 0.0 && turn(b, c, p) >= 0.0 && turn(c, a, p) >= 0.0;
}

// Seen along its normal (Newell's), where it turns counter-clockwise.
std::vector<glm::dvec2> flattened(std::span<const glm::dvec3> corners) {
    glm::dvec3 normal(0.0);
    for (std::size_t i = 0; i < corners.size(); ++i)
        normal +=
            glm::cross(corners[i] - corners[0], corners[(i + 1) % corners.size()] - corners[0]);
    const glm::dvec3 size = glm::abs(normal);
    std::vector<glm::dvec2> flat;
    flat.reserve(corners.size());
    for (const glm::dvec3& p : corners) {
        if (size.z >= size.x && size.z >= size.y)
            flat.push_back(normal.z >= 0.0 ? glm::dvec2(p.x, p.y) : glm::dvec2(p.y, p.x));
        else if (size.y >= size.x)
            flat.push_back(normal.y >= 0.0 ? glm::dvec2(p.z, p.x) : glm::dvec2(p.x, p.z));
        else
            flat.push_back(normal.x >= 0.0 ? glm::dvec2(p.y, p.z) : glm::dvec2(p.z, p.y));
    }
    return flat;
}

bool isConvex(const std::vector<glm::dvec2>& flat) {
    const std::size_t n = flat.size();
    for (std::size_t i = 0; i < n; ++i)
        if (turn(flat[i], flat[(i + 1) % n], flat[(i + 2) % n]) < 0.0)
            return false;
    // It may still turn more than once around (a star): then some triangle of the fan is reversed.
    for (std::size_t i = 1; i + 1 < n; ++i)
        if (turn(flat[0], flat[i], flat[i + 1]) < 0.0)
            return false;
    return true;
}

// Whether the corner at `at` of what is left can be cut off: it is convex and nothing is in it.
bool isEar(const std::vector<glm::dvec2>& flat, const std::vector<std::uint32_t>& left,
           std::size_t at) {
    const std::size_t n = left.size();
    const glm::dvec2 a = flat[left[(at + n - 1) % n]], b = flat[left[at]],
                     c = flat[left[(at + 1) % n]];
    if (turn(a, b, c) <= 0.0)
        return false;
    for (std::size_t i = 2; i < n - 1; ++i) {
        const glm::dvec2 p = flat[left[(at + i) % n]];
        // Corners that meet the ear's own are the ends of a slit.
        if (p != a && p != b && p != c && contains(a, b, c, p))
            return false;
    }
    return true;
}

} // namespace

std::optional<std::vector<Triangle>> trianglesOf(std::span<const glm::dvec3> corners) {
    std::vector<Triangle> result;
    const auto n = static_cast<std::uint32_t>(corners.size());
    result.reserve(n - 2);
    const std::vector<glm::dvec2> flat = n > 3 ? flattened(corners) : std::vector<glm::dvec2>();
    if (n == 3 || isConvex(flat)) {
        for (std::uint32_t i = 1; i + 1 < n; ++i)
            result.push_back({0, i, i + 1});
        return result;
    }
    if (n > kMaxConcaveCorners)
        return std::nullopt;
    std::vector<std::uint32_t> left(n);
    std::iota(left.begin(), left.end(), 0u);
    while (left.size() > 3) {
        std::size_t at = 0;
        while (at < left.size() && !isEar(flat, left, at))
            ++at;
        // A polygon that crosses itself may have none left: any corner goes.
        at = at < left.size() ? at : 0;
        const std::size_t m = left.size();
        result.push_back({left[(at + m - 1) % m], left[at], left[(at + 1) % m]});
        left.erase(left.begin() + static_cast<std::ptrdiff_t>(at));
    }
    result.push_back({left[0], left[1], left[2]});
    return result;
}

} // namespace patina::collada
