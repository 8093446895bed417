#include "render/scene/FrameSlicer.h"

#include "core/base/Check.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace patina::render {
namespace {

constexpr double kAim = 0.7;           // of the budget: slices differ by what lies in them
constexpr double kUnknownShare = 0.01; // of a frame, until a slice has been measured
constexpr std::uint64_t kFewTriangles = 4096, kManyTriangles = 1 << 24;

} // namespace

void FrameSlicer::begin(int width, int height, std::vector<float> costs, double expectedMs,
                        double budgetMs) {
    CHECK(width > 0 && height > 0);
    CHECK(costs.size() == static_cast<std::size_t>(tiles(width) * tiles(height)));
    m_width = width;
    m_height = height;
    m_costs = std::move(costs);
    m_budgetMs = budgetMs;
    const double all = std::accumulate(m_costs.begin(), m_costs.end(), 0.0);
    const double expected = expectedMs > 0.0 ? kAim * budgetMs / expectedMs : kUnknownShare;
    const double share = std::min(expected, 1.0) * all;
    m_share = m_share > 0.0 ? std::min(m_share, share) : share;
    m_tile = 0;
    cut();
}

const SceneSlice& FrameSlicer::slice() const {
    CHECK(!done());
    return m_slice;
}

// Tiles of one row, or several whole rows.
void FrameSlicer::cut() {
    if (done())
        return;
    const auto columns = static_cast<std::size_t>(tiles(m_width));
    const std::size_t column = m_tile % columns;
    const std::size_t rowEnd = m_tile - column + columns;
    double cost = m_costs[m_tile];
    std::size_t end = m_tile + 1;
    while (end < rowEnd && cost + static_cast<double>(m_costs[end]) <= m_share)
        cost += static_cast<double>(m_costs[end++]);
    while (column == 0 && end % columns == 0 && end < m_costs.size()) {
        const auto row = m_costs.begin() + static_cast<std::ptrdiff_t>(end);
        const double more = std::accumulate(row, row + static_cast<std::ptrdiff_t>(columns), 0.0);
        if (cost + more > m_share)
            break;
        cost += more;
        end += columns;
    }
    m_nextTile = end;
    const auto x = static_cast<int>(column) * kTile;
    const auto y = static_cast<int>(m_tile / columns) * kTile;
    const auto right = static_cast<int>((end - 1) % columns + 1) * kTile;
    const auto top = static_cast<int>((end - 1) / columns + 1) * kTile;
    m_slice = {
        {x, y, std::min(right, m_width) - x, std::min(top, m_height) - y}, {0, m_triangles}, false};
    m_slowestMs = 0.0;
    m_tooLarge = false;
}

// Every rectangle costs what its triangles cost, however few pixels it has: of many triangles fewer
// are drawn at a time before rectangles become smaller.
void FrameSlicer::took(double milliseconds, const SceneSlice& drawn) {
    m_slowestMs = std::max(m_slowestMs, milliseconds);
    const std::uint64_t rest =
        drawn.shown > drawn.triangles.first ? drawn.shown - drawn.triangles.first : 0;
    const std::uint64_t triangles = std::min(drawn.triangles.count, rest);
    if (milliseconds > m_budgetMs && triangles > kFewTriangles)
        m_triangles = std::max(kFewTriangles, triangles / 2);
    else if (milliseconds > m_budgetMs)
        m_tooLarge = true;
    else if (milliseconds < 0.25 * m_budgetMs)
        m_triangles = std::min(kManyTriangles, m_triangles + m_triangles / 4);
    if (!drawn.complete) {
        m_slice.triangles = {m_slice.triangles.end(), m_triangles};
        return;
    }
    const double factor = kAim * m_budgetMs / std::max(m_slowestMs, 1e-3);
    const float most = *std::max_element(m_costs.begin(), m_costs.end());
    const double all = std::accumulate(m_costs.begin(), m_costs.end(), 0.0);
    m_share = std::clamp(m_share * std::clamp(factor, m_tooLarge ? 0.25 : 1.0, 1.5),
                         static_cast<double>(most), std::max(all, static_cast<double>(most)));
    m_tile = m_nextTile;
    cut();
}

} // namespace patina::render
