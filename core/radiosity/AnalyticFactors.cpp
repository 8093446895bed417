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

// Of all pairs of points of the two, the share that is exposed at both ends and has nothing in
// between.
double visibilityOf(const ElementMesh& elements, const RayScene& scene,
                    const FactorSettings& settings, std::uint32_t a, std::uint32_t b) {
    thread_local std::vector<OcclusionRay> rays;
    thread_local std::vector<double> weights;
    const glm::dvec3 normalA = elements.face(a).normal, normalB = elements.face(b).normal;
    const std::uint32_t pair = hash32(a) ^ (b * 0x9e3779b9u);
    const std::uint32_t pointsA = seedFor(settings.seed, 2 * pair),
                        pointsB = seedFor(settings.seed, 2 * pair + 1);
    const auto all = static_cast<std::uint32_t>(settings.resolution);
    double total = 0.0, seen = 0.0;
    for (std::uint32_t first = 0; first < all;) {
        const std::uint32_t end = first == 0 ? std::min(kFirstPairs, all) : all;
        rays.clear();
        weights.clear();
        for (std::uint32_t i = first; i < end; ++i) {
            const glm::dvec3 from = elements.samplePosition(a, sobolOwen2D(i, pointsA)),
                             to = elements.samplePosition(b, sobolOwen2D(i, pointsB));
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
            if (elements.isBuried(a, from, scene) || elements.isBuried(b, to, scene)) {
                total += weight; // sees nothing
                continue;
            }
            rays.push_back(ray);
            weights.push_back(weight);
        }
        scene.occlude(rays);
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

} // namespace

ElementSphere sphereOf(const ElementMesh& elements, std::uint32_t element) {
    ElementSphere sphere{elements.centre(element), 0.0};
    const Polygon polygon = elements.polygon(element);
    for (const glm::dvec3& corner : polygon.points())
        sphere.radius = std::max(sphere.radius, glm::length(corner - sphere.centre));
    return sphere;
}

double visibleExchange(const ElementMesh& elements, const RayScene& rays,
                       const FactorSettings& settings, std::uint32_t a,
                       const ElementSphere& sphereA, std::uint32_t b,
                       const ElementSphere& sphereB) {
    const glm::dvec3 normalA = elements.face(a).normal, normalB = elements.face(b).normal;
    const glm::dvec3 way = sphereB.centre - sphereA.centre;
    const double above = glm::dot(normalA, way), before = -glm::dot(normalB, way);
    // Wholly behind one another's planes.
    if (above <= -sphereB.radius || before <= -sphereA.radius)
        return 0.0;
    const bool clear = above >= sphereB.radius && before >= sphereA.radius;
    const double distance = glm::length(way);
    const Polygon polygonA = elements.polygon(a), polygonB = elements.polygon(b);
    const double between = clear && distance > kFar * 2.0 * std::max(sphereA.radius, sphereB.radius)
                               ? exchangeOfFar(polygonA, polygonB, normalA)
                               : exchange(polygonA, polygonB);
    if (!(between > 0.0))
        return 0.0;
    // The same pairs of points from either side, so that what one sees the other sees, too.
    return between * visibilityOf(elements, rays, settings, std::min(a, b), std::max(a, b));
}

AnalyticFactors::AnalyticFactors(const ElementMesh& elements, const RayScene& rays,
                                 const FactorSettings& settings)
    : m_elements(elements)
    , m_rays(rays)
    , m_settings(settings) {
    for (std::uint32_t e = 0; e < elements.size(); ++e)
        m_spheres.push_back(sphereOf(elements, e));
}

void AnalyticFactors::row(std::uint32_t element, FactorRow& row) const {
    row.clear();
    if (m_elements.exposed(element) <= 0.0f) {
        row.absorbed = 1.0f; // all of it is within something
        return;
    }
    const double area = glm::length(areaVector(m_elements.polygon(element).points())) *
                        double{m_elements.exposed(element)};
    double sum = 0.0;
    for (std::uint32_t other = 0; other < m_elements.size(); ++other) {
        if (other == element || m_elements.exposed(other) <= 0.0f)
            continue;
        const double factor = visibleExchange(m_elements, m_rays, m_settings, element,
                                              m_spheres[element], other, m_spheres[other]) /
                              area;
        if (!(static_cast<float>(factor) > 0.0f))
            continue;
        row.shares.push_back({other, static_cast<float>(factor)});
        sum += factor;
    }
    // What sees no element: it is not told apart which part meets backs.
    row.escaped = static_cast<float>(std::max(0.0, 1.0 - sum));
}

} // namespace patina::radiosity
