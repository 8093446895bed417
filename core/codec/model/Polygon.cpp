#include "core/codec/model/Polygon.h"

#include "core/codec/Codec.h"
#include "core/codec/model/CornerSet.h"
#include "core/codec/model/CornerTree.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <utility>

namespace patina::codec {

namespace {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

// How much is asked of an ear. What comes later is for polygons that touch or cross themselves.
enum class Ears {
    Free,     // nothing of the polygon lies in the triangle or at its border
    Touched,  // nothing reaches into it
    Flat,     // no area: the corner is dropped
    Positive, // whatever lies in it
    Any
};

// What stands in the way of an ear.
enum class Obstacle {
    None,
    Corner,          // lies in the triangle, until it is clipped itself
    CornerWithSides, // only touches the triangle; what begins there reaches into it
};

// Corners of a polygon in a ring, of which ears are clipped.
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

    // Tries one corner after the other, against all corners.
    Triangles clip() {
        std::size_t left = m_points.size();
        Ears kind = Ears::Free;
        std::size_t tried = 0;
        for (std::uint32_t at = 0; left >= 3;) {
            if (isEar(at, kind)) {
                at = clip(at, kind);
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

  protected:
    static std::uint32_t index(std::size_t i) { return static_cast<std::uint32_t>(i); }

    [[nodiscard]] Exact area(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
        return signedArea(m_points[a], m_points[b], m_points[c]);
    }

    // Returns the corner to go on with: not the neighbour, as fans have thinner triangles.
    std::uint32_t clip(std::uint32_t at, Ears kind) {
        if (kind != Ears::Flat)
            m_triangles.push_back({m_previous[at], at, m_next[at]});
        m_next[m_previous[at]] = m_next[at];
        m_previous[m_next[at]] = m_previous[at];
        return m_next[m_next[at]];
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
                point.y <= most.y &&
                obstacle(p, {a, b, c}, kind == Ears::Touched) != Obstacle::None)
                return false;
        }
        return true;
    }

    // Whether corner p, or what begins there, lies in the triangle.
    [[nodiscard]] Obstacle obstacle(std::uint32_t p, const std::array<std::uint32_t, 3>& triangle,
                                    bool mayTouch) const {
        std::array<Exact, 3> sides{};
        for (std::size_t i = 0; i < 3; ++i) {
            sides[i] = area(triangle[i], triangle[(i + 1) % 3], p);
            if (sides[i] < 0)
                return Obstacle::None;
        }
        const auto whatReachesInside = [&](auto isInside) {
            return isInside(m_previous[p]) || isInside(m_next[p]) ? Obstacle::CornerWithSides
                                                                  : Obstacle::None;
        };
        // At a corner of the triangle: outlines with holes pass there twice.
        for (std::size_t i = 0; i < 3; ++i)
            if (m_points[p] == m_points[triangle[i]])
                return whatReachesInside([&](std::uint32_t q) {
                    return area(triangle[i], triangle[(i + 1) % 3], q) > 0 &&
                           area(triangle[i], q, triangle[(i + 2) % 3]) > 0;
                });
        if (!mayTouch)
            return Obstacle::Corner;
        for (std::size_t i = 0; i < 3; ++i)
            if (sides[i] == 0)
                return whatReachesInside([&](std::uint32_t q) {
                    return area(triangle[i], triangle[(i + 1) % 3], q) > 0;
                });
        return Obstacle::Corner;
    }

    std::vector<glm::vec2> m_points;
    std::vector<std::uint32_t> m_previous, m_next; // of the corners that are left
    Triangles m_triangles;
};

// The same ears in the same order, in O(n log n) for outlines that are drawn with care: a corner is
// tried again only when its neighbours have changed or what stood in its way has, and only against
// what lies near it.
class ManyCornersClipper : EarClipper {
  public:
    explicit ManyCornersClipper(std::vector<glm::vec2> points)
        : EarClipper(std::move(points))
        , m_tree(m_points)
        , m_open{CornerSet(m_points.size()), CornerSet(m_points.size())}
        , m_flat(m_points.size())
        , m_positive(m_points.size())
        , m_waiting(m_points.size())
        , m_obstacles(m_points.size()) {
        for (std::uint32_t i = 0; i < m_points.size(); ++i)
            sort(i);
    }

    Triangles clip() {
        // Outlines of a hundred thousand random radii take 230 a corner, others a half or less.
        const std::size_t most = 1'000'000 + 1'000 * m_points.size();
        std::uint32_t at = 0;
        for (std::size_t left = m_points.size(); left >= 3; --left) {
            const auto [ear, kind] = findEar(at);
            const std::uint32_t a = m_previous[ear], c = m_next[ear];
            at = EarClipper::clip(ear, kind);
            m_tree.remove(ear);
            for (CornerSet* set : {&m_open[0], &m_open[1], &m_flat, &m_positive})
                set->erase(ear);
            reopen(ear, false);
            for (const std::uint32_t neighbour : {a, c}) {
                sort(neighbour);
                reopen(neighbour, true);
            }
            if (m_work > most)
                throw Refusal(fmt::format("a face of {} corners touches or crosses itself too "
                                          "often to be divided into triangles; divide it in the "
                                          "program that made it and export it again",
                                          m_points.size()));
        }
        return std::move(m_triangles);
    }

  private:
    struct Ear {
        std::uint32_t corner;
        Ears kind;
    };
    struct Waiting {
        std::uint32_t corner;
        std::uint8_t kind;
        bool forSides; // of what it waits for
    };
    static constexpr std::uint32_t kNothing = ~0u;

    // By what its neighbours allow; nothing stands in its way as far as is known.
    void sort(std::uint32_t corner) {
        const Exact size = area(m_previous[corner], corner, m_next[corner]);
        const auto put = [&](CornerSet& set, bool in) {
            in ? set.insert(corner) : set.erase(corner);
        };
        for (CornerSet& set : m_open)
            put(set, size > 0);
        put(m_positive, size > 0);
        put(m_flat, size == 0);
        m_obstacles[corner] = {kNothing, kNothing};
    }

    // What waits for a corner that is gone, or whose sides are others now.
    void reopen(std::uint32_t corner, bool onlyForSides) {
        std::vector<Waiting>& waiting = m_waiting[corner];
        m_work += waiting.size();
        std::erase_if(waiting, [&](const Waiting& w) {
            if (m_obstacles[w.corner][w.kind] != corner)
                return true; // not any more
            if (onlyForSides && !w.forSides)
                return false;
            m_obstacles[w.corner][w.kind] = kNothing;
            m_open[w.kind].insert(w.corner);
            return true;
        });
    }

    [[nodiscard]] Ear findEar(std::uint32_t at) {
        for (const Ears kind : {Ears::Free, Ears::Touched}) {
            CornerSet& open = m_open[static_cast<std::size_t>(kind)];
            while (const auto corner = open.nextInCircle(at)) {
                if (isFree(*corner, kind))
                    return {*corner, kind};
                open.erase(*corner);
            }
        }
        if (const auto corner = m_flat.nextInCircle(at))
            return {*corner, Ears::Flat};
        if (const auto corner = m_positive.nextInCircle(at))
            return {*corner, Ears::Positive};
        return {at, Ears::Any};
    }

    [[nodiscard]] bool isFree(std::uint32_t b, Ears kind) {
        const std::array<std::uint32_t, 3> triangle{m_previous[b], b, m_next[b]};
        bool isFree = true;
        // Any obstacle will do. Were it the same for all that have it in their way, all of them
        // would be tried again as often as one is clipped.
        m_tree.forEachNear(
            {m_points[triangle[0]], m_points[triangle[1]], m_points[triangle[2]]},
            static_cast<std::uint32_t>(m_work), m_work, [&](std::uint32_t p) {
                if (p == triangle[0] || p == triangle[1] || p == triangle[2])
                    return false;
                const Obstacle found = obstacle(p, triangle, kind == Ears::Touched);
                if (found == Obstacle::None)
                    return false;
                const auto which = static_cast<std::uint8_t>(kind);
                m_waiting[p].push_back({b, which, found == Obstacle::CornerWithSides});
                m_obstacles[b][which] = p;
                isFree = false;
                return true;
            });
        return isFree;
    }

    CornerTree m_tree;
    std::array<CornerSet, 2> m_open; // may be ears, Free or Touched
    CornerSet m_flat, m_positive;
    std::vector<std::vector<Waiting>> m_waiting;           // for each corner
    std::vector<std::array<std::uint32_t, 2>> m_obstacles; // that each corner waits for
    std::size_t m_work = 0;
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
    constexpr std::size_t kFew = 64;
    return points.size() <= kFew ? EarClipper(std::move(points)).clip()
                                 : ManyCornersClipper(std::move(points)).clip();
}

} // namespace patina::codec
