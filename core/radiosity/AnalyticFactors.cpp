#include "core/radiosity/AnalyticFactors.h"

#include "core/math/Quadrature.h"
#include "core/math/Sampling.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <utility>

namespace patina::radiosity {
namespace {

// Sizes apart from where a few points stand for a line integral: their error is below 1e-6.
constexpr double kFar = 6.0;
// Pairs of points that are looked at first: where all of them agree, no more are.
constexpr std::uint32_t kFirstPairs = 8;

// Area of a times its factor to b, for polygons that are far from one another and in front of one
// another: the second's closed form at the points of a quadrature over the first.
double exchangeOfFar(const Polygon& a, const Polygon& b, const glm::dvec3& normalA) {
    static const GaussLegendre kPoints(2);
    double sum = 0.0;
    for (std::size_t corner = 2; corner < a.count; ++corner) {
        const glm::dvec3 x = a.corners[corner - 1] - a.corners[0],
                         y = a.corners[corner] - a.corners[0];
        const double twice = glm::length(glm::cross(x, y));
        for (int i = 0; i < 2; ++i)
            for (int k = 0; k < 2; ++k) {
                const double u = kPoints.node01(i), v = kPoints.node01(k) * (1.0 - u);
                sum += kPoints.weight01(i) * kPoints.weight01(k) * (1.0 - u) * twice *
                       pointToPolygon(a.corners[0] + u * x + v * y, normalA, b);
            }
    }
    return sum;
}

} // namespace

AnalyticFactors::AnalyticFactors(const ElementMesh& elements, const RayScene& rays,
                                 const FactorSettings& settings)
    : m_elements(elements)
    , m_rays(rays)
    , m_settings(settings)
    , m_rounds(elements.size()) {
    for (std::uint32_t e = 0; e < elements.size(); ++e) {
        const Polygon polygon = elements.polygon(e);
        Round& round = m_rounds[e];
        round.centre = elements.centre(e);
        for (const glm::dvec3& corner : polygon.points())
            round.radius = std::max(round.radius, glm::length(corner - round.centre));
    }
}

double AnalyticFactors::visibility(std::uint32_t a, std::uint32_t b) const {
    thread_local std::vector<OcclusionRay> rays;
    thread_local std::vector<double> weights;
    const glm::dvec3 normalA = m_elements.face(a).normal, normalB = m_elements.face(b).normal;
    const std::uint32_t pair = hash32(a) ^ (b * 0x9e3779b9u);
    const std::uint32_t pointsA = seedFor(m_settings.seed, 2 * pair),
                        pointsB = seedFor(m_settings.seed, 2 * pair + 1);
    const auto all = static_cast<std::uint32_t>(m_settings.resolution);
    double total = 0.0, seen = 0.0;
    for (std::uint32_t first = 0; first < all;) {
        const std::uint32_t end = first == 0 ? std::min(kFirstPairs, all) : all;
        rays.clear();
        weights.clear();
        for (std::uint32_t i = first; i < end; ++i) {
            const glm::dvec3 from = m_elements.samplePosition(a, sobolOwen2D(i, pointsA)),
                             to = m_elements.samplePosition(b, sobolOwen2D(i, pointsB));
            const glm::dvec3 way = to - from;
            const double cosA = glm::dot(normalA, way), cosB = -glm::dot(normalB, way);
            const double length2 = glm::dot(way, way);
            if (!(cosA > 0.0 && cosB > 0.0 && length2 > 0.0))
                continue;
            const double distance = std::sqrt(length2);
            OcclusionRay ray;
            ray.origin = glm::vec3(from + double{kRayOffset} * normalA);
            const glm::dvec3 offsetWay = to + double{kRayOffset} * normalB - glm::dvec3(ray.origin);
            ray.direction = glm::vec3(glm::normalize(offsetWay));
            ray.maxDistance = static_cast<float>(
                std::max(0.0, glm::length(offsetWay) - 0.5 * double{kRayOffset}));
            if (distance <= 2.0 * double{kRayOffset}) // nothing fits in between
                ray.maxDistance = 0.0f;
            const double weight = cosA * cosB / (length2 * length2);
            if (m_elements.isBuried(a, from, m_rays) || m_elements.isBuried(b, to, m_rays)) {
                total += weight; // sees nothing
                continue;
            }
            rays.push_back(ray);
            weights.push_back(weight);
        }
        m_rays.occlude(rays);
        for (std::size_t i = 0; i < rays.size(); ++i) {
            total += weights[i];
            if (!rays[i].occluded())
                seen += weights[i];
        }
        first = end;
        if (first < all && total > 0.0 && (seen == 0.0 || seen == total))
            break;
    }
    // No two of the points see one another: the little that does is taken for visible.
    return total > 0.0 ? seen / total : 1.0;
}

void AnalyticFactors::row(std::uint32_t element, FactorRow& row) const {
    row.clear();
    if (m_elements.exposed(element) <= 0.0f) {
        row.absorbed = 1.0f; // all of it is within something
        return;
    }
    const Polygon own = m_elements.polygon(element);
    const glm::dvec3 normal = m_elements.face(element).normal;
    const Round& round = m_rounds[element];
    const double area = glm::length(areaVector(own.points())) * double{m_elements.exposed(element)};
    double sum = 0.0;
    for (std::uint32_t other = 0; other < m_elements.size(); ++other) {
        if (other == element || m_elements.exposed(other) <= 0.0f)
            continue;
        const Round& there = m_rounds[other];
        const glm::dvec3 otherNormal = m_elements.face(other).normal;
        const glm::dvec3 way = there.centre - round.centre;
        const double above = glm::dot(normal, way), before = -glm::dot(otherNormal, way);
        // Wholly behind one another's planes.
        if (above <= -there.radius || before <= -round.radius)
            continue;
        const bool clear = above >= there.radius && before >= round.radius;
        const double distance = glm::length(way);
        const Polygon polygon = m_elements.polygon(other);
        const double between = clear && distance > kFar * 2.0 * std::max(round.radius, there.radius)
                                   ? exchangeOfFar(own, polygon, normal)
                                   : exchange(own, polygon);
        if (!(between > 0.0))
            continue;
        // The same pairs of points from either side, so that what one sees the other sees, too.
        const double factor =
            between / area * visibility(std::min(element, other), std::max(element, other));
        if (!(static_cast<float>(factor) > 0.0f))
            continue;
        row.shares.push_back({other, static_cast<float>(factor)});
        sum += factor;
    }
    // What sees no element: it is not told apart which part meets backs.
    row.escaped = static_cast<float>(std::max(0.0, 1.0 - sum));
}

} // namespace patina::radiosity
