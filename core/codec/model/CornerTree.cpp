#include "core/codec/model/CornerTree.h"

#include <algorithm>
#include <glm/common.hpp>
#include <numeric>

namespace patina::codec {

CornerTree::CornerTree(const std::vector<glm::vec2>& points)
    : m_points(points)
    , m_corners(points.size())
    , m_places(points.size())
    , m_removed(points.size(), false) {
    std::iota(m_corners.begin(), m_corners.end(), 0u);
    std::size_t nodes = 1;
    for (std::size_t most = points.size(); most > kLeafSize; most = (most + 1) / 2)
        nodes = 2 * nodes + 1;
    m_boxes.resize(nodes);
    m_left.resize(nodes);
    build(0, 0, m_corners.size());
    for (std::size_t i = 0; i < m_corners.size(); ++i)
        m_places[m_corners[i]] = static_cast<std::uint32_t>(i);
}

void CornerTree::build(std::size_t node, std::size_t begin, std::size_t end) {
    Box box{m_points[m_corners[begin]], m_points[m_corners[begin]]};
    for (std::size_t i = begin + 1; i < end; ++i) {
        box.least = glm::min(box.least, m_points[m_corners[i]]);
        box.most = glm::max(box.most, m_points[m_corners[i]]);
    }
    m_boxes[node] = box;
    m_left[node] = static_cast<std::uint32_t>(end - begin);
    if (end - begin <= kLeafSize)
        return;
    const int axis = box.most.x - box.least.x > box.most.y - box.least.y ? 0 : 1;
    const std::size_t middle = (begin + end) / 2;
    const auto at = [&](std::size_t i) {
        return m_corners.begin() + static_cast<std::ptrdiff_t>(i);
    };
    std::nth_element(at(begin), at(middle), at(end), [&](std::uint32_t a, std::uint32_t b) {
        return m_points[a][axis] < m_points[b][axis];
    });
    build(2 * node + 1, begin, middle);
    build(2 * node + 2, middle, end);
}

void CornerTree::remove(std::uint32_t corner) {
    m_removed[corner] = true;
    std::size_t node = 0, begin = 0, end = m_corners.size();
    while (true) {
        --m_left[node];
        if (end - begin <= kLeafSize)
            return;
        const std::size_t middle = (begin + end) / 2;
        const bool first = m_places[corner] < middle;
        node = 2 * node + (first ? 1 : 2);
        (first ? end : begin) = middle;
    }
}

bool CornerTree::mayMeet(const Box& box, const std::array<glm::vec2, 3>& triangle) {
    const auto [a, b, c] = triangle;
    const glm::vec2 least = glm::min(glm::min(a, b), c), most = glm::max(glm::max(a, b), c);
    if (box.most.x < least.x || box.least.x > most.x || box.most.y < least.y ||
        box.least.y > most.y)
        return false;
    // The box's point that lies furthest to the left of each side. Rounding is monotonic: where its
    // area is negative, those of all others are.
    for (std::size_t i = 0; i < 3; ++i) {
        const glm::vec2 p = triangle[i], q = triangle[(i + 1) % 3];
        const glm::vec2 furthest(q.y > p.y ? box.least.x : box.most.x,
                                 q.x > p.x ? box.most.y : box.least.y);
        if (signedArea(p, q, furthest) < 0)
            return false;
    }
    return true;
}

} // namespace patina::codec
