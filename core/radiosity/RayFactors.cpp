#include "core/radiosity/RayFactors.h"

#include "core/math/Sampling.h"
#include "core/radiosity/HitCount.h"

#include <algorithm>
#include <cmath>
#include <glm/mat3x3.hpp>

namespace patina::radiosity {
namespace {

constexpr std::uint32_t kRayBatch = 1024;
// For each ray, that are tried on an element of which most is within something.
constexpr double kMostPoints = 16.0;

} // namespace

void RayFactors::row(std::uint32_t element, FactorRow& row) const {
    thread_local std::vector<ClosestRay> rays;
    thread_local HitCount hits;
    const auto count = static_cast<std::uint32_t>(m_settings.resolution);
    const double exposed = double{m_elements.exposed(element)};
    if (exposed <= 0.0) {
        row.clear();
        row.absorbed = 1.0f; // all of it is within something
        row.rays = count;
        return;
    }
    const Face& face = m_elements.face(element);
    const glm::vec3 normal(face.normal);
    glm::vec3 tangent, bitangent;
    orthonormalBasis(normal, tangent, bitangent);
    const glm::mat3 frame(tangent, bitangent, normal);
    const std::uint32_t seed = seedFor(m_settings.seed, element);
    // What is exposed of an element has as many rays as a whole one.
    const double tries = exposed < 1.0 ? std::min(std::ceil(2.0 / exposed), kMostPoints) : 1.0;
    const auto points = static_cast<std::uint32_t>(count * tries);
    std::uint32_t cast = 0, next = 0;
    while (cast < count && next < points) {
        rays.clear();
        for (; next < points && rays.size() < std::min(kRayBatch, count - cast); ++next) {
            const glm::vec4 u = sobolOwen4D(next, seed);
            const glm::dvec3 from = m_elements.samplePosition(element, {u.x, u.y});
            if (m_elements.isBuried(element, from, m_rays))
                continue;
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
