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

// What two of exchange light: an element, or a sender.
struct Piece {
    const ElementMesh::Node& node;
    const Face& face;
    std::uint32_t number;
    bool sends;
    const ElementSphere& sphere;

    [[nodiscard]] bool isBuried(const ElementMesh& elements, const glm::dvec2& at,
                                const RayScene& rays) const {
        return sends ? elements.isSenderBuried(number, at, rays)
                     : elements.isBuried(number, positionOn(face, at), rays);
    }
};

// Of all pairs of points of the two, the share that is exposed at both ends and has nothing in
// between.
double visibilityOf(const ElementMesh& elements, const RayScene& scene,
                    const FactorSettings& settings, const Piece& a, const Piece& b) {
    thread_local std::vector<OcclusionRay> rays;
    thread_local std::vector<double> weights;
    const glm::dvec3 normalA = a.face.normal, normalB = b.face.normal;
    const std::uint32_t pair = hash32(a.number) ^ (b.number * 0x9e3779b9u);
    const std::uint32_t pointsA = seedFor(settings.seed, 2 * pair),
                        pointsB = seedFor(settings.seed, 2 * pair + 1);
    const auto all = static_cast<std::uint32_t>(settings.resolution);
    double total = 0.0, seen = 0.0;
    for (std::uint32_t first = 0; first < all;) {
        const std::uint32_t end = first == 0 ? std::min(kFirstPairs, all) : all;
        rays.clear();
        weights.clear();
        for (std::uint32_t i = first; i < end; ++i) {
            const glm::dvec2 atA = elements.samplePoint(a.node, sobolOwen2D(i, pointsA)),
                             atB = elements.samplePoint(b.node, sobolOwen2D(i, pointsB));
            const glm::dvec3 from = positionOn(a.face, atA), to = positionOn(b.face, atB);
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
            if (a.isBuried(elements, atA, scene) || b.isBuried(elements, atB, scene)) {
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

double exchangeOf(const ElementMesh& elements, const RayScene& rays, const FactorSettings& settings,
                  const Piece& a, const Piece& b) {
    const glm::dvec3 normalA = a.face.normal, normalB = b.face.normal;
    const glm::dvec3 way = b.sphere.centre - a.sphere.centre;
    const double above = glm::dot(normalA, way), before = -glm::dot(normalB, way);
    // Wholly behind one another's planes.
    if (above <= -b.sphere.radius || before <= -a.sphere.radius)
        return 0.0;
    const bool clear = above >= b.sphere.radius && before >= a.sphere.radius;
    const double distance = glm::length(way);
    const Polygon polygonA = elements.polygon(a.node), polygonB = elements.polygon(b.node);
    const double between =
        clear && distance > kFar * 2.0 * std::max(a.sphere.radius, b.sphere.radius)
            ? exchangeOfFar(polygonA, polygonB, normalA)
            : exchange(polygonA, polygonB);
    if (!(between > 0.0))
        return 0.0;
    // The same pairs of points from either side, so that what one sees the other sees, too.
    return between * (a.number < b.number ? visibilityOf(elements, rays, settings, a, b)
                                          : visibilityOf(elements, rays, settings, b, a));
}

} // namespace

ElementSphere sphereOf(const ElementMesh& elements, const ElementMesh::Node& node) {
    ElementSphere sphere{elements.centre(node), 0.0};
    const Polygon polygon = elements.polygon(node);
    for (const glm::dvec3& corner : polygon.points())
        sphere.radius = std::max(sphere.radius, glm::length(corner - sphere.centre));
    return sphere;
}

double visibleExchange(const ElementMesh& elements, const RayScene& rays,
                       const FactorSettings& settings, std::uint32_t a,
                       const ElementSphere& sphereA, std::uint32_t b,
                       const ElementSphere& sphereB) {
    return exchangeOf(elements, rays, settings,
                      {elements.node(a), elements.face(a), a, false, sphereA},
                      {elements.node(b), elements.face(b), b, false, sphereB});
}

AnalyticFactors::AnalyticFactors(const ElementMesh& elements, const RayScene& rays,
                                 const FactorSettings& settings)
    : m_elements(elements)
    , m_rays(rays)
    , m_settings(settings) {
    for (std::uint32_t e = 0; e < elements.size(); ++e)
        m_spheres.push_back(sphereOf(elements, e));
}

void AnalyticFactors::row(std::uint32_t sender, FactorRow& row) const {
    row.clear();
    const float exposed = m_elements.senderExposed(sender);
    if (exposed <= 0.0f) {
        row.absorbed = 1.0f; // all of it is within something
        return;
    }
    const ElementMesh::Node& node = m_elements.sender(sender);
    const double area =
        glm::length(areaVector(m_elements.polygon(node).points())) * double{exposed};
    const ElementSphere sphere = sphereOf(m_elements, node);
    const Piece sends{node, m_elements.faces()[node.face], sender, true, sphere};
    double sum = 0.0;
    for (std::uint32_t other = 0; other < m_elements.size(); ++other) {
        if (m_elements.senderOf(other) == sender || m_elements.exposed(other) <= 0.0f)
            continue;
        const double factor = exchangeOf(m_elements, m_rays, m_settings, sends,
                                         {m_elements.node(other), m_elements.face(other), other,
                                          false, m_spheres[other]}) /
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
