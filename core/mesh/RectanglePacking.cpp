#include "core/mesh/RectanglePacking.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace patina {
namespace {

// The outline of what is packed so far, from left to right.
struct Segment {
    int x, y, width;
};

class Skyline {
  public:
    explicit Skyline(int side)
        : m_side(side)
        , m_segments{{0, 0, side}} {}

    // The lowest place, then the leftmost; {-1, -1} when there is none.
    glm::ivec2 place(int width, int height) {
        std::size_t best = 0;
        int bestY = std::numeric_limits<int>::max();
        for (std::size_t i = 0; i < m_segments.size(); ++i) {
            if (m_segments[i].x + width > m_side)
                break;
            int y = 0, covered = 0;
            for (std::size_t j = i; covered < width && y < bestY; ++j) {
                y = std::max(y, m_segments[j].y);
                covered += m_segments[j].width;
            }
            if (y < bestY && y + height <= m_side) {
                bestY = y;
                best = i;
            }
        }
        if (bestY == std::numeric_limits<int>::max())
            return {-1, -1};
        const glm::ivec2 position(m_segments[best].x, bestY);
        cover(best, {position.x, bestY + height, width});
        return position;
    }

  private:
    void cover(std::size_t at, const Segment& added) {
        const int end = added.x + added.width;
        std::size_t last = at;
        while (last < m_segments.size() && m_segments[last].x + m_segments[last].width <= end)
            ++last;
        if (last < m_segments.size() && m_segments[last].x < end) {
            m_segments[last].width -= end - m_segments[last].x;
            m_segments[last].x = end;
        }
        const auto begin = m_segments.begin();
        m_segments.erase(begin + static_cast<std::ptrdiff_t>(at),
                         begin + static_cast<std::ptrdiff_t>(last));
        m_segments.insert(m_segments.begin() + static_cast<std::ptrdiff_t>(at), added);
        if (at + 1 < m_segments.size() && m_segments[at + 1].y == added.y) {
            m_segments[at].width += m_segments[at + 1].width;
            m_segments.erase(m_segments.begin() + static_cast<std::ptrdiff_t>(at + 1));
        }
        if (at > 0 && m_segments[at - 1].y == m_segments[at].y) {
            m_segments[at - 1].width += m_segments[at].width;
            m_segments.erase(m_segments.begin() + static_cast<std::ptrdiff_t>(at));
        }
    }

    int m_side;
    std::vector<Segment> m_segments;
};

glm::ivec2 cellSize(const glm::dvec2& size, double scale, int margin) {
    const auto texels = [&](double length) {
        return static_cast<int>(std::ceil(length * scale)) + 2 * margin;
    };
    return {std::max(texels(size.x), 1), std::max(texels(size.y), 1)};
}

bool tryPack(std::span<const glm::dvec2> sizes, std::span<const std::size_t> order, int margin,
             double scale, RectanglePacking& packing) {
    Skyline skyline(packing.side);
    for (const std::size_t i : order) {
        const glm::ivec2 cell = cellSize(sizes[i], scale, margin);
        packing.positions[i] = skyline.place(cell.x, cell.y);
        if (packing.positions[i].x < 0)
            return false;
    }
    packing.scale = scale;
    return true;
}

} // namespace

RectanglePacking packRectangles(std::span<const glm::dvec2> sizes, int side, int margin) {
    RectanglePacking packing;
    packing.positions.resize(sizes.size());
    packing.side = side;
    // Margins and one texel each may take half of the square.
    const double perCell = std::pow(2.0 * margin + 1.0, 2.0);
    while (static_cast<double>(sizes.size()) * perCell >
           0.5 * static_cast<double>(packing.side) * packing.side)
        packing.side *= 2;

    std::vector<std::size_t> order(sizes.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        if (sizes[a].y != sizes[b].y)
            return sizes[a].y > sizes[b].y;
        return sizes[a].x != sizes[b].x ? sizes[a].x > sizes[b].x : a < b;
    });

    double area = 0.0, longest = 0.0;
    for (const glm::dvec2& size : sizes) {
        area += size.x * size.y;
        longest = std::max({longest, size.x, size.y});
    }
    if (!(longest > 0.0))
        longest = 1.0;
    double high = (packing.side - 2 * margin) / longest;
    if (area > 0.0)
        high = std::min(high, packing.side / std::sqrt(area));
    if (tryPack(sizes, order, margin, high, packing))
        return packing;
    double low = high;
    do {
        high = low;
        low *= 0.8;
    } while (!tryPack(sizes, order, margin, low, packing));
    for (int step = 0; step < 4; ++step) {
        const double middle = std::sqrt(low * high);
        (tryPack(sizes, order, margin, middle, packing) ? low : high) = middle;
    }
    (void)tryPack(sizes, order, margin, low, packing); // the last success
    return packing;
}

} // namespace patina
