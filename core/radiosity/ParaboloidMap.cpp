#include "core/radiosity/ParaboloidMap.h"

#include "core/base/Check.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <utility>

namespace patina::radiosity {
namespace {

// Edges that are shorter on the map are straight: less than a thousandth of a texel off, where the
// cross product of their ends has few digits left.
constexpr double kShortEdge = 1e-6;

// ∫ dt / (k² + t²)² from 0 to t.
double alongEdge(double k2, double t) {
    const double k = std::sqrt(k2);
    return 0.5 * (t / (k2 * (k2 + t * t)) + std::atan(t / k) / (k2 * k));
}

// Form factor through the part of the disc with 0 <= x' <= x and 0 <= y' <= y. By Nusselt it is the
// area, over π, of what u = 2 p / (1 + p²), the first two coordinates of the direction, makes of
// the region: ½ ∮ u × du = 2 ∮ (p × dp) / (1 + p²)². Edges through the origin add nothing, and an
// arc of the rim half its angle.
double factorFromOrigin(double x, double y) {
    x = std::min(x, 1.0);
    y = std::min(y, 1.0);
    const double rimX = std::sqrt(1.0 - y * y), rimY = std::sqrt(1.0 - x * x);
    double sum = x * alongEdge(1.0 + x * x, std::min(y, rimY)) +
                 y * alongEdge(1.0 + y * y, std::min(x, rimX));
    if (x * x + y * y > 1.0)
        sum += 0.25 * (std::asin(y) - std::acos(x));
    return 2.0 / std::numbers::pi * sum;
}

double factorSigned(double x, double y) {
    const double value = factorFromOrigin(std::abs(x), std::abs(y));
    return (x < 0.0) == (y < 0.0) ? value : -value;
}

// The corner of a polygon above the horizon, and the plane of the edge that leaves it.
struct ClippedCorner {
    glm::dvec2 at;
    glm::dvec3 plane;
};

} // namespace

double ParaboloidMap::factor(double x0, double x1, double y0, double y1) {
    return factorSigned(x1, y1) - factorSigned(x0, y1) - factorSigned(x1, y0) +
           factorSigned(x0, y0);
}

glm::dvec2 ParaboloidMap::project(const glm::dvec3& direction) {
    return glm::dvec2(direction) / (glm::length(direction) + direction.z);
}

int ParaboloidMap::firstFrom(double coordinate) const {
    const double texel = std::ceil((coordinate + 1.0) / m_step - 0.5);
    return static_cast<int>(std::clamp(texel, 0.0, static_cast<double>(m_resolution)));
}

ParaboloidMap::ParaboloidMap(int resolution)
    : m_resolution(resolution)
    , m_step(2.0 / resolution) {
    const auto size = static_cast<std::size_t>(resolution);
    const auto isOnDisc = [&](int column, int row) {
        const double x = centre(column), y = centre(row);
        return x * x + y * y < 1.0;
    };
    // factorSigned() at the lower and the upper corners of a row of texels.
    std::vector<double> below(size + 1), above(size + 1);
    const auto findCorners = [&](int row, std::vector<double>& corners) {
        for (int i = 0; i <= resolution; ++i)
            corners[static_cast<std::size_t>(i)] =
                factorSigned(i * m_step - 1.0, row * m_step - 1.0);
    };
    findCorners(0, below);
    m_weights.assign(size * size, 0.0);
    for (int row = 0; row < resolution; ++row) {
        findCorners(row + 1, above);
        Run run{resolution, 0};
        for (int column = 0; column < resolution; ++column) {
            const double x = std::abs(centre(column)) - 0.5 * m_step,
                         y = std::abs(centre(row)) - 0.5 * m_step;
            if (!isOnDisc(column, row) && x * x + y * y >= 1.0)
                continue; // off the disc wholly
            int toColumn = column, toRow = row;
            while (!isOnDisc(toColumn, toRow)) { // towards the middle, along the longer way
                const double atX = centre(toColumn), atY = centre(toRow);
                if (std::abs(atX) > std::abs(atY))
                    toColumn += atX < 0.0 ? 1 : -1;
                else
                    toRow += atY < 0.0 ? 1 : -1;
            }
            const auto i = static_cast<std::size_t>(column);
            m_weights[static_cast<std::size_t>(toRow) * size +
                      static_cast<std::size_t>(toColumn)] +=
                above[i + 1] - above[i] - below[i + 1] + below[i];
            if (isOnDisc(column, row)) {
                run.first = std::min(run.first, column);
                run.end = column + 1;
            }
        }
        m_runs.push_back(run);
        std::swap(below, above);
    }
}

std::span<const ParaboloidFill::Span> ParaboloidFill::cover(std::span<const glm::dvec3> corners,
                                                            bool front) {
    CHECK(corners.size() <= 4);
    m_spans.clear();
    // Clipped at the horizon: Sutherland & Hodgman 1974. What is added there runs along it, with
    // the inside of a polygon seen from its front on the right.
    const glm::dvec3 horizon(0.0, 0.0, front ? -1.0 : 1.0);
    std::array<ClippedCorner, kMostCorners> clipped;
    std::size_t count = 0;
    for (std::size_t k = 0; k < corners.size(); ++k) {
        const glm::dvec3 &from = corners[k], &to = corners[(k + 1) % corners.size()];
        const glm::dvec3 plane = glm::cross(from, to);
        if (from.z > 0.0)
            clipped[count++] = {ParaboloidMap::project(from), plane};
        if ((from.z > 0.0) != (to.z > 0.0)) {
            const double t = from.z / (from.z - to.z);
            const glm::dvec2 rim =
                glm::normalize(glm::dvec2(from) + t * (glm::dvec2(to) - glm::dvec2(from)));
            clipped[count++] = {rim, from.z > 0.0 ? horizon : plane};
        }
    }
    m_firstRow = m_map.resolution();
    m_endRow = 0;
    for (std::size_t k = 0; k < count; ++k)
        addEdge(clipped[k].at, clipped[(k + 1) % count].at, clipped[k].plane);

    // Inside is between the first crossing of a row and the second, the third and the fourth.
    for (int row = m_firstRow; row < m_endRow; ++row) {
        Row& crossed = m_rows[static_cast<std::size_t>(row)];
        std::sort(crossed.x.begin(),
                  crossed.x.begin() + static_cast<std::ptrdiff_t>(crossed.count));
        const ParaboloidMap::Run run = m_map.run(row);
        for (std::size_t i = 0; i + 1 < crossed.count; i += 2) {
            const int first = std::max(m_map.firstFrom(crossed.x[i]), run.first);
            const int end = std::min(m_map.firstFrom(crossed.x[i + 1]), run.end);
            if (first < end)
                m_spans.push_back({row, first, end});
        }
        crossed.count = 0;
    }
    return m_spans;
}

// The plane n of an edge and of the point that sees it has n · (2 x, 2 y, 1 - x² - y²) = 0 on the
// map: n.z x² - 2 n.x x = n.z (1 - y²) + 2 n.y y, a circle about (n.x, n.y) / n.z, or a line
// through the origin. Above the horizon less than half of it is seen, and an edge passes its
// highest or its lowest point once at most. n.z x - n.x has the same sign up to there, and the
// other one after it.
void ParaboloidFill::addEdge(const glm::dvec2& from, const glm::dvec2& to,
                             const glm::dvec3& plane) {
    const glm::dvec2 way = glm::abs(to - from);
    if (std::max(way.x, way.y) < kShortEdge) {
        addLine(from, to);
        return;
    }
    const bool fromNegative = plane.z * from.x - plane.x < 0.0,
               toNegative = plane.z * to.x - plane.x < 0.0;
    if (fromNegative == toNegative || plane.z == 0.0) {
        addArc(from.y, to.y, plane, fromNegative);
        return;
    }
    // With n.z > 0 edges run about the circle's centre counter-clockwise: over the highest point
    // from right to left, and under the lowest one from left to right.
    const bool upwards = plane.z > 0.0;
    const bool fromRight = fromNegative != upwards;
    const double length = glm::length(plane);
    // (n.y ± |n|) / n.z; where the difference would cancel, by the product of both.
    const double side = fromRight ? length : -length;
    const double turn = side * plane.y < 0.0 ? -(plane.x * plane.x + plane.z * plane.z) /
                                                   (plane.z * (plane.y - side))
                                             : (plane.y + side) / plane.z;
    addArc(from.y, turn, plane, fromNegative);
    addArc(turn, to.y, plane, toNegative);
}

template <class PositionAt>
void ParaboloidFill::cross(double fromY, double toY, const PositionAt& xAt) {
    const int first = m_map.firstFrom(std::min(fromY, toY)),
              end = m_map.firstFrom(std::max(fromY, toY));
    if (first >= end)
        return;
    m_firstRow = std::min(m_firstRow, first);
    m_endRow = std::max(m_endRow, end);
    for (int row = first; row < end; ++row) {
        Row& crossed = m_rows[static_cast<std::size_t>(row)];
        crossed.x[crossed.count++] = xAt(m_map.centre(row));
    }
}

void ParaboloidFill::addLine(const glm::dvec2& from, const glm::dvec2& to) {
    cross(from.y, to.y,
          [&](double y) { return from.x + (y - from.y) / (to.y - from.y) * (to.x - from.x); });
}

void ParaboloidFill::addArc(double fromY, double toY, const glm::dvec3& n, bool negative) {
    cross(fromY, toY, [&](double y) {
        const double q = n.z * (1.0 - y * y) + 2.0 * n.y * y;
        const double size = std::sqrt(std::max(0.0, n.x * n.x + n.z * q));
        const double root = negative ? -size : size; // n.z x - n.x
        // Either form of the same number, whichever does not cancel.
        if (n.z != 0.0 && n.x * root >= 0.0)
            return (n.x + root) / n.z;
        return n.x != root ? -q / (n.x - root) : 0.0;
    });
}

} // namespace patina::radiosity
