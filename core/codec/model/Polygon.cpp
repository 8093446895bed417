#include "core/codec/model/Polygon.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <utility>

namespace patina::codec {

namespace {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

// In 64 bits of mantissa: products of differences of floats of like size are exact, and so is the
// sign of an area. With 53 bits that holds for floats within a factor of two.
using Exact = long double;

// How much is asked of an ear. What comes later is for polygons that touch or cross themselves.
enum class Ears {
    Free,     // nothing of the polygon lies in the triangle or at its border
    Touched,  // nothing reaches into it
    Flat,     // no area: the corner is dropped
    Positive, // whatever lies in it
    Any
};

// Twice the signed area.
Exact signedArea(const glm::vec2& p, const glm::vec2& q, const glm::vec2& r) {
    return (Exact(q.x) - Exact(p.x)) * (Exact(r.y) - Exact(p.y)) -
           (Exact(q.y) - Exact(p.y)) * (Exact(r.x) - Exact(p.x));
}

class EarClipper {
  public:
    // Counter-clockwise.
    explicit EarClipper(std::vector<glm::vec2> points)
        : m_points(std::move(points))
        , m_previous(m_points.size())
        , m_next(m_points.size()) {
        for (std::size_t i = 0; i < m_points.size(); ++i) {
            m_previous[i] = index(i == 0 ? m_points.size() - 1 : i - 1);
            m_next[i] = index(i + 1 == m_points.size() ? 0 : i + 1);
        }
    }

    Triangles clip() {
        std::size_t left = m_points.size();
        Ears kind = Ears::Free;
        std::size_t tried = 0;
        for (std::uint32_t at = 0; left >= 3;) {
            if (isEar(at, kind)) {
                if (kind != Ears::Flat)
                    m_triangles.push_back({m_previous[at], at, m_next[at]});
                m_next[m_previous[at]] = m_next[at];
                m_previous[m_next[at]] = m_previous[at];
                // Not the neighbour: fans have thinner triangles.
                at = m_next[m_next[at]];
                --left;
                kind = Ears::Free;
                tried = 0;
                continue;
            }
            at = m_next[at];
            if (++tried == left) {
                kind = static_cast<Ears>(static_cast<int>(kind) + 1);
                tried = 0;
            }
        }
        return std::move(m_triangles);
    }

  private:
    static std::uint32_t index(std::size_t i) { return static_cast<std::uint32_t>(i); }

    [[nodiscard]] Exact area(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
        return signedArea(m_points[a], m_points[b], m_points[c]);
    }

    [[nodiscard]] bool isEar(std::uint32_t b, Ears kind) const {
        const std::uint32_t a = m_previous[b], c = m_next[b];
        const Exact size = area(a, b, c);
        if (kind == Ears::Any)
            return true;
        if (kind == Ears::Flat)
            return size == 0;
        if (!(size > 0))
            return false;
        if (kind == Ears::Positive)
            return true;
        const glm::vec2 least = glm::min(glm::min(m_points[a], m_points[b]), m_points[c]);
        const glm::vec2 most = glm::max(glm::max(m_points[a], m_points[b]), m_points[c]);
        for (std::uint32_t p = m_next[c]; p != a; p = m_next[p]) {
            const glm::vec2& point = m_points[p];
            if (point.x >= least.x && point.x <= most.x && point.y >= least.y &&
                point.y <= most.y && isInTheWay(p, {a, b, c}, kind == Ears::Touched))
                return false;
        }
        return true;
    }

    // Whether corner p, or what begins there, lies in the triangle.
    [[nodiscard]] bool isInTheWay(std::uint32_t p, const std::array<std::uint32_t, 3>& triangle,
                                  bool mayTouch) const {
        std::array<Exact, 3> sides{};
        for (std::size_t i = 0; i < 3; ++i) {
            sides[i] = area(triangle[i], triangle[(i + 1) % 3], p);
            if (sides[i] < 0)
                return false;
        }
        const auto reachesInside = [&](auto isInside) {
            return isInside(m_previous[p]) || isInside(m_next[p]);
        };
        // At a corner of the triangle: outlines with holes pass there twice.
        for (std::size_t i = 0; i < 3; ++i)
            if (m_points[p] == m_points[triangle[i]])
                return reachesInside([&](std::uint32_t q) {
                    return area(triangle[i], triangle[(i + 1) % 3], q) > 0 &&
                           area(triangle[i], q, triangle[(i + 2) % 3]) > 0;
                });
        if (!mayTouch)
            return true;
        for (std::size_t i = 0; i < 3; ++i)
            if (sides[i] == 0)
                return reachesInside([&](std::uint32_t q) {
                    return area(triangle[i], triangle[(i + 1) % 3], q) > 0;
                });
        return true;
    }

    std::vector<glm::vec2> m_points;
    std::vector<std::uint32_t> m_previous, m_next; // of the corners that are left
    Triangles m_triangles;
};

Triangles fan(std::size_t corners) {
    Triangles triangles;
    for (std::uint32_t i = 2; i < corners; ++i)
        triangles.push_back({0, i - 1, i});
    return triangles;
}

// M. E. Newell's: of the area vector, also where the polygon is not flat.
glm::dvec3 areaVectorOf(std::span<const glm::vec3> corners) {
    glm::dvec3 sum(0.0);
    const glm::dvec3 origin(corners[0]);
    for (std::size_t i = 1; i + 1 < corners.size(); ++i)
        sum += glm::cross(glm::dvec3(corners[i]) - origin, glm::dvec3(corners[i + 1]) - origin);
    return sum;
}

} // namespace

Triangles triangulatePolygon(std::span<const glm::vec3> corners) {
    if (corners.size() < 3)
        return {};
    // Seen along an axis the coordinates stay as they are, without rounding.
    const glm::dvec3 normal = areaVectorOf(corners), size = glm::abs(normal);
    const int axis = size.x > size.y && size.x > size.z ? 0 : size.y > size.z ? 1 : 2;
    if (corners.size() == 3 || !(size[axis] > 0.0) || !std::isfinite(size[axis]))
        return fan(corners.size());
    std::vector<glm::vec2> points;
    points.reserve(corners.size());
    for (const glm::vec3& corner : corners) {
        const float x = corner[(axis + 1) % 3], y = corner[(axis + 2) % 3];
        points.emplace_back(normal[axis] > 0.0 ? glm::vec2(x, y) : glm::vec2(y, x));
    }
    if (points.size() == 4 && signedArea(points[0], points[1], points[2]) > 0 &&
        signedArea(points[0], points[2], points[3]) > 0)
        return fan(4);
    return EarClipper(std::move(points)).clip();
}

} // namespace patina::codec
