#include "core/trace/blame/PrefilterLobe.h"

#include "core/math/Sampling.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace patina {

// With dl = 4 N·H dh and t = (N·H)², so that N·L = 2 t - 1, over the half vectors of the upper
// hemisphere, b = 1 - a²:
//   4 ∫ D N·H N·L dh = 4 a² ∫_{1/2}^{1} (2 t - 1) / (1 - b t)² dt
//                    = 4 / b² (b - 2 a² ln((1 + a²) / 2 a²)).
double prefilterNorm(double alpha) {
    const double a2 = alpha * alpha, b = 1.0 - a2;
    // The bracket is b² / 4 + O(b³) and has lost its digits there.
    if (b < 1e-4)
        return 1.0;
    return 4.0 / (b * b) * (b - 2.0 * a2 * std::log((1.0 + a2) / (2.0 * a2)));
}

PrefilterLobe::PrefilterLobe(const glm::vec3& axis, float alpha)
    : m_axis(axis)
    , m_alpha(alpha)
    , m_scale(static_cast<float>(1.0 / prefilterNorm(static_cast<double>(alpha)))) {}

float PrefilterLobe::density(const glm::vec3& l) const {
    const glm::vec3 sum = m_axis + l;
    const float length2 = glm::dot(sum, sum);
    if (length2 < 1e-12f)
        return 0.0f; // opposite: no half vector
    const glm::vec3 h = sum / std::sqrt(length2), across = glm::cross(m_axis, h);
    return shading::D_GGX_Sin2(glm::dot(m_axis, h), std::min(glm::dot(across, across), 1.0f),
                               m_alpha);
}

float PrefilterLobe::weight(const glm::vec3& l) const {
    const float NoL = glm::dot(m_axis, l);
    return NoL > 0.0f ? m_scale * density(l) * NoL : 0.0f;
}

// Half vectors have the density D N·H, directions that by 4 V·H = 4 N·H (Walter et al. 2007,
// equation 14).
float PrefilterLobe::pdf(const glm::vec3& l) const {
    return 0.25f * density(l);
}

glm::vec3 PrefilterLobe::sample(const glm::vec2& u) const {
    glm::vec3 t, b;
    orthonormalBasis(m_axis, t, b);
    const glm::vec3 h = shading::sampleHalfVectorGGX(u, m_alpha);
    // The axis reflected at h.
    const glm::vec3 l(2.0f * h.z * h.x, 2.0f * h.z * h.y, 2.0f * h.z * h.z - 1.0f);
    return glm::normalize(l.x * t + l.y * b + l.z * m_axis);
}

} // namespace patina
