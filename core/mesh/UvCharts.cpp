#include "core/mesh/UvCharts.h"

#include "core/job/Parallel.h"
#include "core/mesh/BorderSweep.h"
#include "core/mesh/OverlapGrid.h"
#include "core/mesh/TriangleAdjacency.h"

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <numeric>
#include <queue>

namespace patina {
namespace {

constexpr std::uint32_t kNoLabel = kNoTriangle;

// Triangles of like direction get one label ("region"); regions may still overlap in projection.
class Regions {
  public:
    Regions(const Mesh& mesh, const std::vector<glm::dvec3>& points,
            const std::vector<std::array<std::uint32_t, 3>>& adjacency, double cosLimit)
        : m_adjacency(adjacency)
        , m_cosLimit(cosLimit)
        , m_label(mesh.triangleCount(), kNoLabel)
        , m_normal(mesh.triangleCount())
        , m_area(mesh.triangleCount()) {
        for (std::size_t t = 0; t < m_normal.size(); ++t) {
            const std::uint32_t* index = mesh.indices.data() + 3 * t;
            const glm::dvec3 cross = glm::cross(points[index[1]] - points[index[0]],
                                                points[index[2]] - points[index[0]]);
            m_area[t] = 0.5 * glm::length(cross);
            m_normal[t] = m_area[t] > 0.0 ? glm::normalize(cross) : glm::dvec3(0.0, 1.0, 0.0);
        }
    }

    void build() {
        growFromFreeTriangles();
        relax();
        growFromFreeTriangles();
    }

    [[nodiscard]] std::size_t count() const { return m_axis.size(); } // some may be empty
    [[nodiscard]] const std::vector<std::uint32_t>& labels() const { return m_label; }
    [[nodiscard]] const glm::dvec3& axis(std::uint32_t label) const { return m_axis[label]; }

  private:
    // Labels every free triangle. A region follows its mean normal while it grows; members that
    // ended up beyond the limit are set free again for the next round.
    void growFromFreeTriangles() {
        constexpr int kRounds = 4; // then axes stay with their seed, so that the end is certain
        for (int round = 0; round <= kRounds; ++round) {
            bool anyFree = false;
            for (std::uint32_t seed = 0; seed < m_label.size(); ++seed)
                if (m_label[seed] == kNoLabel)
                    anyFree |= growRegion(seed, round < kRounds);
            if (!anyFree)
                return;
        }
    }

    // Best first: the triangle that deviates least comes next. Returns true if members were freed.
    bool growRegion(std::uint32_t seed, bool moveAxis) {
        const auto label = static_cast<std::uint32_t>(m_axis.size());
        glm::dvec3 axis = m_normal[seed], sum(0.0);
        std::vector<std::uint32_t> members;
        Queue queue;
        queue.push({0.0, m_order++, seed, label});
        while (!queue.empty()) {
            const std::uint32_t t = queue.top().triangle;
            queue.pop();
            if (m_label[t] != kNoLabel || glm::dot(m_normal[t], axis) < m_cosLimit)
                continue;
            m_label[t] = label;
            members.push_back(t);
            sum += m_normal[t] * m_area[t];
            if (moveAxis && glm::length(sum) > 0.0)
                axis = glm::normalize(sum);
            pushNeighbours(queue, t, label, axis);
        }
        const auto fits = [&](std::uint32_t t) {
            return glm::dot(m_normal[t], axis) >= m_cosLimit;
        };
        if (std::none_of(members.begin(), members.end(), fits)) {
            axis = m_normal[seed];
        }
        m_axis.push_back(axis);
        bool freed = false;
        for (const std::uint32_t t : members) {
            if (fits(t))
                continue;
            m_label[t] = kNoLabel;
            freed = true;
        }
        return freed;
    }

    // All regions grow again at once from their best triangles with fixed axes, so that borders
    // settle where two axes suit equally well. Crumbs are left to their neighbours.
    void relax() {
        const std::size_t count = m_axis.size();
        std::vector<double> area(count, 0.0);
        std::vector<std::uint32_t> best(count, kNoTriangle);
        const double total = std::accumulate(m_area.begin(), m_area.end(), 0.0);
        for (std::uint32_t t = 0; t < m_label.size(); ++t) {
            const std::uint32_t label = m_label[t];
            area[label] += m_area[t];
            if (best[label] == kNoTriangle || glm::dot(m_normal[t], m_axis[label]) >
                                                  glm::dot(m_normal[best[label]], m_axis[label]))
                best[label] = t;
        }
        std::fill(m_label.begin(), m_label.end(), kNoLabel);
        Queue queue;
        for (std::uint32_t label = 0; label < count; ++label)
            if (best[label] != kNoTriangle && area[label] > 1e-4 * total)
                queue.push({0.0, m_order++, best[label], label});
        while (!queue.empty()) {
            const Candidate next = queue.top();
            queue.pop();
            if (m_label[next.triangle] != kNoLabel)
                continue;
            m_label[next.triangle] = next.label;
            pushNeighbours(queue, next.triangle, next.label, m_axis[next.label]);
        }
    }

    struct Candidate {
        double deviation; // 1 - cos
        std::uint64_t order;
        std::uint32_t triangle, label;
        friend bool operator>(const Candidate& a, const Candidate& b) {
            return a.deviation != b.deviation ? a.deviation > b.deviation : a.order > b.order;
        }
    };
    using Queue = std::priority_queue<Candidate, std::vector<Candidate>, std::greater<>>;

    void pushNeighbours(Queue& queue, std::uint32_t t, std::uint32_t label,
                        const glm::dvec3& axis) {
        for (const std::uint32_t neighbour : m_adjacency[t]) {
            if (neighbour == kNoTriangle || m_label[neighbour] != kNoLabel)
                continue;
            const double cosine = glm::dot(m_normal[neighbour], axis);
            if (cosine >= m_cosLimit)
                queue.push({1.0 - cosine, m_order++, neighbour, label});
        }
    }

    const std::vector<std::array<std::uint32_t, 3>>& m_adjacency;
    double m_cosLimit;
    std::vector<std::uint32_t> m_label;
    std::vector<glm::dvec3> m_normal;
    std::vector<double> m_area;
    std::vector<glm::dvec3> m_axis;
    std::uint64_t m_order = 0;
};

// Cells and triangles that are looked at for overlaps: ten times what meshes take that are no
// pile of needles.
constexpr double kLooksPerTriangle = 100.0, kLooksPerMesh = 1e7;

// About one cell per triangle, and no more than some thousand along a side, so that long needles
// cost little.
double gridCell(const Mesh& mesh, const std::vector<glm::dvec3>& points,
                const UvChartSettings& settings) {
    double area = 0.0;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const glm::dvec3& a = points[mesh.indices[i]];
        area += 0.5 * glm::length(glm::cross(points[mesh.indices[i + 1]] - a,
                                             points[mesh.indices[i + 2]] - a));
    }
    const double mean = std::sqrt(area / static_cast<double>(mesh.triangleCount()));
    return std::max({mean, settings.overlapTolerance, 1.0 / 4096.0});
}

// Cuts regions into charts.
class ChartCutter {
  public:
    // Keeps references.
    ChartCutter(const Mesh& mesh, const std::vector<glm::dvec3>& points, const Regions& regions,
                const std::vector<std::array<std::uint32_t, 3>>& adjacency,
                std::vector<std::uint32_t>& chartOf)
        : m_mesh(mesh)
        , m_points(points)
        , m_regions(regions)
        , m_adjacency(adjacency)
        , m_chartOf(chartOf)
        , m_gathered(mesh.triangleCount(), 0) {}

    // Within a region, grows connected charts that leave out what would overlap; what is left out
    // starts further charts. Numbers them within the region, and returns the triangle that each
    // began with. Several regions may be cut at a time.
    std::vector<std::uint32_t> cut(std::uint32_t region,
                                   const std::vector<std::uint32_t>& triangles, OverlapGrid grid) {
        const ChartFrame frame = chartFrame(m_regions.axis(region));
        std::vector<std::uint32_t> seeds;
        for (const std::uint32_t seed : triangles) {
            if (m_chartOf[seed] != kNoLabel)
                continue;
            const auto chart = static_cast<std::uint32_t>(seeds.size());
            seeds.push_back(seed);
            // Most often there is nothing to leave out.
            if (m_gathered[seed] == 0) {
                const std::vector<std::uint32_t> all = gather(seed);
                if (surelyLieApart(all, frame)) {
                    for (const std::uint32_t t : all)
                        m_chartOf[t] = chart;
                    continue;
                }
            }
            grow(seed, chart, frame, grid);
        }
        return seeds;
    }

  private:
    [[nodiscard]] bool areTogether(std::uint32_t t, std::uint32_t neighbour) const {
        return neighbour != kNoTriangle && m_regions.labels()[t] == m_regions.labels()[neighbour];
    }

    [[nodiscard]] Triangle2 projected(std::uint32_t t, const ChartFrame& frame) const {
        Triangle2 triangle;
        for (std::size_t corner = 0; corner < 3; ++corner) {
            const glm::dvec3& point = m_points[m_mesh.indices[3 * t + corner]];
            triangle[corner] = {glm::dot(point, frame.x), glm::dot(point, frame.y)};
        }
        return triangle;
    }

    // All that hangs together with a triangle in its region.
    std::vector<std::uint32_t> gather(std::uint32_t seed) {
        std::vector<std::uint32_t> all{seed};
        m_gathered[seed] = 1;
        for (std::size_t i = 0; i < all.size(); ++i)
            for (const std::uint32_t neighbour : m_adjacency[all[i]])
                if (areTogether(all[i], neighbour) && m_gathered[neighbour] == 0) {
                    m_gathered[neighbour] = 1;
                    all.push_back(neighbour);
                }
        return all;
    }

    [[nodiscard]] bool surelyLieApart(const std::vector<std::uint32_t>& triangles,
                                      const ChartFrame& frame) const {
        constexpr double kRounding = 1e-14; // of areas: needles may seem turned over
        std::vector<BorderSegment> border;
        for (const std::uint32_t t : triangles) {
            const auto [a, b, c] = projected(t, frame);
            if ((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x) < -kRounding)
                return false;
            const Triangle2 corners{a, b, c};
            for (std::size_t edge = 0; edge < 3; ++edge)
                if (!areTogether(t, m_adjacency[t][edge]))
                    border.push_back({corners[edge], corners[(edge + 1) % 3]});
        }
        return windsAtMostOnce(border);
    }

    void grow(std::uint32_t seed, std::uint32_t chart, const ChartFrame& frame, OverlapGrid& grid) {
        std::queue<std::uint32_t> front;
        front.push(seed);
        while (!front.empty()) {
            const std::uint32_t t = front.front();
            front.pop();
            if (m_chartOf[t] != kNoLabel || !grid.add(chart, projected(t, frame)))
                continue;
            m_chartOf[t] = chart;
            for (const std::uint32_t neighbour : m_adjacency[t])
                if (areTogether(t, neighbour) && m_chartOf[neighbour] == kNoLabel)
                    front.push(neighbour);
        }
    }

    const Mesh& m_mesh;
    const std::vector<glm::dvec3>& m_points;
    const Regions& m_regions;
    const std::vector<std::array<std::uint32_t, 3>>& m_adjacency;
    std::vector<std::uint32_t>& m_chartOf;
    std::vector<std::uint8_t> m_gathered; // of each triangle
};

} // namespace

ChartFrame chartFrame(const glm::dvec3& axis) {
    // World up stays up in the chart where there is one, so that textures stand upright.
    const glm::dvec3 up = std::abs(axis.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, -1);
    const glm::dvec3 x = glm::normalize(glm::cross(up, axis));
    return {x, glm::cross(axis, x)};
}

UvCharts cutUvCharts(const Mesh& mesh, const std::vector<glm::dvec3>& points,
                     const UvChartSettings& settings) {
    const auto adjacency = triangleAdjacency(mesh);
    Regions regions(mesh, points, adjacency, std::cos(glm::radians(settings.maxDeviationDeg)));
    regions.build();
    std::vector<std::vector<std::uint32_t>> triangles(regions.count());
    for (std::uint32_t t = 0; t < mesh.triangleCount(); ++t)
        triangles[regions.labels()[t]].push_back(t);

    // No chart spans two regions, so that each is cut by itself. Its charts begin with the first
    // triangle that is left, and are numbered within the region.
    UvCharts charts;
    charts.chartOfTriangle.assign(mesh.triangleCount(), kNoLabel);
    std::vector<std::vector<std::uint32_t>> seeds(regions.count()); // of its charts, ascending
    const double cell = gridCell(mesh, points, settings);
    const double looks =
        kLooksPerTriangle + kLooksPerMesh / static_cast<double>(mesh.triangleCount());
    ChartCutter cutter(mesh, points, regions, adjacency, charts.chartOfTriangle);
    parallelFor(JobContext(), regions.count(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t region = begin; region < end; ++region)
            seeds[region] =
                cutter.cut(static_cast<std::uint32_t>(region), triangles[region],
                           OverlapGrid(cell, settings.overlapTolerance,
                                       static_cast<std::size_t>(
                                           looks * static_cast<double>(triangles[region].size()))));
    });

    // Numbered by their first triangles, over all regions.
    struct Chart {
        std::uint32_t seed, region;
    };
    std::vector<Chart> all;
    for (std::uint32_t region = 0; region < seeds.size(); ++region)
        for (const std::uint32_t seed : seeds[region])
            all.push_back({seed, region});
    std::ranges::sort(all, {}, &Chart::seed);
    std::vector<std::vector<std::uint32_t>> numbers(seeds.size());
    for (std::uint32_t chart = 0; chart < all.size(); ++chart) {
        numbers[all[chart].region].push_back(chart);
        charts.axes.push_back(regions.axis(all[chart].region));
    }
    for (std::uint32_t t = 0; t < mesh.triangleCount(); ++t)
        charts.chartOfTriangle[t] = numbers[regions.labels()[t]][charts.chartOfTriangle[t]];
    return charts;
}

} // namespace patina
