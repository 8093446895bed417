#include "core/radiosity/RayFactors.h"

#include "core/math/Sampling.h"
#include "core/radiosity/HitCount.h"

#include <algorithm>
#include <cmath>
#include <glm/mat3x3.hpp>

namespace patina::radiosity {
namespace {

constexpr std::uint32_t kRayBatch = 1024;
constexpr std::size_t kMostRays = std::size_t{1} << 24; // of one row, that tries fit 32 bits
// For each ray, that are tried on an element of which most is within something.
constexpr double kMostPoints = 16.0;

} // namespace

void RayFactors::row(std::uint32_t sender, FactorRow& row) const {
    thread_local std::vector<ClosestRay> rays;
    thread_local HitCount hits;
    // Of a patch as many as of its elements: elements that only receive have the noise of all rays
    // together.
    const auto resolution = static_cast<std::size_t>(m_settings.resolution);
    const auto count = static_cast<std::uint32_t>(
        std::min(resolution * m_elements.senderElements(sender), kMostRays));
    const double exposed = double{m_elements.senderExposed(sender)};
    if (exposed <= 0.0) {
        row.clear();
        row.absorbed = 1.0f; // all of it is within something
        row.rays = count;
        return;
    }
    const ElementMesh::Node& node = m_elements.sender(sender);
    const Face& face = m_elements.faces()[node.face];
    const glm::vec3 normal(face.normal);
    glm::vec3 tangent, bitangent;
    orthonormalBasis(normal, tangent, bitangent);
    const glm::mat3 frame(tangent, bitangent, normal);
    const std::uint32_t seed = seedFor(m_settings.seed, sender);
    // What is exposed of an element has as many rays as a whole one.
    const double tries = exposed < 1.0 ? std::min(std::ceil(2.0 / exposed), kMostPoints) : 1.0;
    const auto points = static_cast<std::uint32_t>(count * tries);
    std::uint32_t cast = 0, next = 0;
    while (cast < count && next < points) {
        rays.clear();
        for (; next < points && rays.size() < std::min(kRayBatch, count - cast); ++next) {
            const glm::vec4 u = sobolOwen4D(next, seed);
            const glm::dvec2 at = m_elements.samplePoint(node, {u.x, u.y});
            if (exposed < 1.0 && m_elements.isSenderBuried(sender, at, m_rays))
                continue;
            const glm::dvec3 from = positionOn(face, at);
            OcclusionRay& ray = rays.emplace_back().ray;
            ray.origin = glm::vec3(from) + kRayOffset * normal;
            ray.direction = frame * cosineHemisphere({u.z, u.w});
        }
        m_rays.intersect(rays);
        cast += static_cast<std::uint32_t>(rays.size());
        for (const ClosestRay& ray : rays)
            hits.add(m_elements, ray, 1.0);
    }
    hits.finish(row);
    row.rays = cast > 0 ? cast : count;
}

} // namespace patina::radiosity
