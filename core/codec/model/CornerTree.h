// The corners of a polygon by their places: which of those that are left lie in a triangle.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <utility>
#include <vector>

namespace patina::codec {

// In 64 bits of mantissa: products of differences of floats of like size are exact, and so is the
// sign of an area. With 53 bits that holds for floats within a factor of two.
using Exact = long double;

// Twice the area of a triangle, negative where it runs clockwise.
inline Exact signedArea(const glm::vec2& p, const glm::vec2& q, const glm::vec2& r) {
    return (Exact(q.x) - Exact(p.x)) * (Exact(r.y) - Exact(p.y)) -
           (Exact(q.y) - Exact(p.y)) * (Exact(r.x) - Exact(p.x));
}

// Boxes, each of which is halved at the middle one of its corners, along its longer side.
class CornerTree {
  public:
    // Keeps a reference.
    explicit CornerTree(const std::vector<glm::vec2>& points);

    void remove(std::uint32_t corner);

    // Calls visit(corner) for each one that is left and may lie in the triangle, counter-clockwise,
    // or at its border, until visit returns true; in an order that follows from `seed`. Adds what
    // it has looked at to `work`.
    template <class Visit>
    void forEachNear(const std::array<glm::vec2, 3>& triangle, std::uint32_t seed,
                     std::size_t& work, const Visit& visit) const {
        struct Part {
            std::size_t node, begin, end;
        };
        std::array<Part, 64> pending; // as many as there are levels
        std::size_t count = 0;
        pending[count++] = {0, 0, m_corners.size()};
        while (count > 0) {
            const auto [node, begin, end] = pending[--count];
            ++work;
            if (m_left[node] == 0 || !mayMeet(m_boxes[node], triangle))
                continue;
            if (end - begin > kLeafSize) {
                const std::size_t middle = (begin + end) / 2;
                pending[count] = {2 * node + 2, middle, end};
                pending[count + 1] = {2 * node + 1, begin, middle};
                seed = seed * 1664525u + 1013904223u;
                if ((seed >> 31) != 0)
                    std::swap(pending[count], pending[count + 1]);
                count += 2;
                continue;
            }
            work += end - begin;
            for (std::size_t i = begin; i < end; ++i)
                if (!m_removed[m_corners[i]] && visit(m_corners[i]))
                    return;
        }
    }

  private:
    struct Box {
        glm::vec2 least, most;
    };
    static constexpr std::size_t kLeafSize = 8;

    void build(std::size_t node, std::size_t begin, std::size_t end);
    [[nodiscard]] static bool mayMeet(const Box& box, const std::array<glm::vec2, 3>& triangle);

    const std::vector<glm::vec2>& m_points;
    std::vector<std::uint32_t> m_corners; // in the order of the leaves
    std::vector<std::uint32_t> m_places;  // of each corner in it
    std::vector<bool> m_removed;
    std::vector<Box> m_boxes;          // of each node; those of node n are 2 n + 1 and 2 n + 2
    std::vector<std::uint32_t> m_left; // corners of each node
};

} // namespace patina::codec
