#include "core/radiosity/RayFactors.h"

#include "core/math/Sampling.h"
#include "core/radiosity/HitCount.h"

#include <algorithm>
#include <glm/mat3x3.hpp>

namespace patina::radiosity {
namespace {

constexpr std::uint32_t kRayBatch = 1024;

} // namespace

void RayFactors::row(std::uint32_t element, FactorRow& row) const {
    thread_local std::vector<ClosestRay> rays;
    thread_local HitCount hits;
    const Face& face = m_elements.face(element);
    const glm::vec3 normal(face.normal);
    glm::vec3 tangent, bitangent;
    orthonormalBasis(normal, tangent, bitangent);
    const glm::mat3 frame(tangent, bitangent, normal);
    const std::uint32_t seed = seedFor(m_settings.seed, element);
    const auto count = static_cast<std::uint32_t>(m_settings.resolution);
    for (std::uint32_t first = 0; first < count; first += kRayBatch) {
        const std::uint32_t size = std::min(kRayBatch, count - first);
        rays.clear();
        for (std::uint32_t i = 0; i < size; ++i) {
            const glm::vec4 u = sobolOwen4D(first + i, seed);
            const glm::dvec3 from = m_elements.samplePosition(element, {u.x, u.y});
            if (m_elements.isBuried(element, from, m_rays))
                continue;
            OcclusionRay& ray = rays.emplace_back().ray;
            ray.origin = glm::vec3(from) + kRayOffset * normal;
            ray.direction = frame * cosineHemisphere({u.z, u.w});
        }
        m_rays.intersect(rays);
        for (const ClosestRay& ray : rays)
            hits.add(m_elements, ray, 1.0);
    }
    hits.finish(row);
}

} // namespace patina::radiosity
