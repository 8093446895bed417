#include "core/radiosity/PolygonFactor.h"

#include "core/math/Quadrature.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <utility>

namespace patina::radiosity {
namespace {

// An edge of the second polygon, for integrals from many points of the first.
struct Edge {
    glm::dvec3 start, direction; // unit
    double length;
};

Edge edgeOf(const glm::dvec3& from, const glm::dvec3& to) {
    const glm::dvec3 way = to - from;
    const double length = glm::length(way);
    return {from, length > 0.0 ? way / length : glm::dvec3(0.0), length};
}

// ∫ ln r along the edge, r being the distance to p: of s ↦ ½ ln(s² + h²).
double logIntegral(const glm::dvec3& p, const Edge& edge) {
    const glm::dvec3 toP = p - edge.start;
    const double foot = glm::dot(toP, edge.direction);
    const double h = std::sqrt(std::max(0.0, glm::dot(toP, toP) - foot * foot));
    const auto primitive = [h](double s) {
        const double r2 = s * s + h * h;
        return r2 > 0.0 ? 0.5 * s * std::log(r2) - s + (h > 0.0 ? h * std::atan(s / h) : 0.0) : 0.0;
    };
    return primitive(edge.length - foot) - primitive(-foot);
}

// Where on `edge`, 0…1, `other` is nearest, and how near it is there.
std::pair<double, double> nearest(const Edge& edge, const Edge& other) {
    const glm::dvec3 between = edge.start - other.start;
    const double c = glm::dot(edge.direction, other.direction);
    const double d = glm::dot(edge.direction, between), e = glm::dot(other.direction, between);
    const double parallel = 1.0 - c * c;
    double along = parallel > 1e-12 ? (c * e - d) / parallel : -d;
    double on = std::clamp(c * std::clamp(along, 0.0, edge.length) + e, 0.0, other.length);
    along = std::clamp(c * on - d, 0.0, edge.length);
    on = std::clamp(c * along + e, 0.0, other.length);
    const double distance =
        glm::length(edge.start + along * edge.direction - other.start - on * other.direction);
    return {along / edge.length, distance};
}

// Outer integral from t0 to t1, by points that crowd at both ends: where edges touch the inner one
// has a kink or an infinite slope there.
double crowded(const Edge& outer, const Edge& inner, double t0, double t1) {
    static const GaussLegendre kPoints(24);
    double sum = 0.0;
    for (int i = 0; i < kPoints.size(); ++i) {
        const double x = kPoints.node01(i);
        const double t = x * x * x * (10.0 + x * (6.0 * x - 15.0));
        const double slope = 30.0 * x * x * (1.0 - x) * (1.0 - x);
        const glm::dvec3 p = outer.start + (t0 + (t1 - t0) * t) * outer.length * outer.direction;
        sum += kPoints.weight01(i) * slope * logIntegral(p, inner);
    }
    return sum * (t1 - t0) * outer.length;
}

double plain(const Edge& outer, const Edge& inner, const GaussLegendre& points) {
    double sum = 0.0;
    for (int i = 0; i < points.size(); ++i)
        sum += points.weight01(i) *
               logIntegral(outer.start + points.node01(i) * outer.length * outer.direction, inner);
    return sum * outer.length;
}

double edgePair(const Edge& outer, const Edge& inner) {
    static const GaussLegendre kFar(5), kMiddle(12);
    const double along = glm::dot(outer.direction, inner.direction);
    if (outer.length <= 0.0 || inner.length <= 0.0 || std::abs(along) < 1e-15)
        return 0.0;
    const auto [where, distance] = nearest(outer, inner);
    if (distance > 2.0 * outer.length)
        return along * plain(outer, inner, kFar);
    if (distance > 0.5 * outer.length)
        return along * plain(outer, inner, kMiddle);
    const double start = where > 1e-6 && where < 1.0 - 1e-6 ? where : 0.0;
    double sum = crowded(outer, inner, start, 1.0);
    if (start > 0.0)
        sum += crowded(outer, inner, 0.0, start);
    return along * sum;
}

} // namespace

Polygon::Polygon(std::span<const glm::dvec3> points)
    : count(points.size()) {
    std::copy(points.begin(), points.end(), corners.begin());
}

glm::dvec3 areaVector(std::span<const glm::dvec3> polygon) {
    glm::dvec3 sum(0.0);
    for (std::size_t i = 2; i < polygon.size(); ++i)
        sum += glm::cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]);
    return 0.5 * sum;
}

Polygon clip(const Polygon& polygon, const glm::dvec3& point, const glm::dvec3& normal) {
    std::array<double, Polygon::kMax> above{};
    double farthest2 = 0.0;
    for (std::size_t i = 0; i < polygon.count; ++i) {
        const glm::dvec3 to = polygon.corners[i] - point;
        above[i] = glm::dot(normal, to);
        farthest2 = std::max(farthest2, glm::dot(to, to));
    }
    // Corners in the plane but for the rounding of float coordinates are in it.
    const double tolerance = 1e-7 * std::sqrt(farthest2);
    for (std::size_t i = 0; i < polygon.count; ++i)
        if (std::abs(above[i]) <= tolerance)
            above[i] = 0.0;
    Polygon result;
    bool some = false;
    for (std::size_t i = 0; i < polygon.count; ++i) {
        const std::size_t next = (i + 1) % polygon.count;
        some = some || above[i] > 0.0;
        if (above[i] >= 0.0 && result.count < Polygon::kMax)
            result.add(polygon.corners[i]);
        if (above[i] * above[next] < 0.0 && result.count < Polygon::kMax) {
            const double t = above[i] / (above[i] - above[next]);
            result.add(glm::mix(polygon.corners[i], polygon.corners[next], t));
        }
    }
    if (!some)
        result.count = 0;
    return result;
}

double pointToPolygon(const glm::dvec3& point, const glm::dvec3& normal, const Polygon& polygon) {
    const Polygon seen = clip(polygon, point, normal);
    double sum = 0.0;
    for (std::size_t i = 0; i < seen.count; ++i) {
        const glm::dvec3 a = seen.corners[i] - point,
                         b = seen.corners[(i + 1) % seen.count] - point;
        const glm::dvec3 across = glm::cross(a, b);
        const double sine = glm::length(across);
        if (sine > 0.0)
            sum += glm::dot(normal, across) / sine * std::atan2(sine, glm::dot(a, b));
    }
    // Counter-clockwise about its own normal, which faces the point, is clockwise from there.
    return std::clamp(-sum / (2.0 * std::numbers::pi), 0.0, 1.0);
}

double exchange(const Polygon& a, const Polygon& b) {
    const glm::dvec3 normalA = areaVector(a.points()), normalB = areaVector(b.points());
    const double areaA = glm::length(normalA), areaB = glm::length(normalB);
    if (a.count < 3 || b.count < 3 || !(areaA > 0.0) || !(areaB > 0.0))
        return 0.0;
    const Polygon seenB = clip(b, a.corners[0], normalA / areaA);
    const Polygon seenA = clip(a, b.corners[0], normalB / areaB);
    if (seenA.count < 3 || seenB.count < 3)
        return 0.0;
    std::array<Edge, Polygon::kMax> edges;
    for (std::size_t k = 0; k < seenB.count; ++k)
        edges[k] = edgeOf(seenB.corners[k], seenB.corners[(k + 1) % seenB.count]);
    double sum = 0.0;
    for (std::size_t i = 0; i < seenA.count; ++i) {
        const Edge outer = edgeOf(seenA.corners[i], seenA.corners[(i + 1) % seenA.count]);
        for (std::size_t k = 0; k < seenB.count; ++k)
            sum += edgePair(outer, edges[k]);
    }
    return std::max(0.0, sum / (2.0 * std::numbers::pi));
}

} // namespace patina::radiosity
