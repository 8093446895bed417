// Integrals of the specular lobe over the lights, without random numbers: half vectors on a grid of
// the distribution's own cumulative function, which cancels D's peak.
#pragma once

#include "core/math/Sampling.h"
#include "core/math/Shading.h"

#include <cmath>

namespace patina::shading {

// One light direction l = reflect(-v, h) and the solid angle it stands for.
struct LobeNode {
    vec3 l;
    float NoH, NoL, VoH, sin2;
    double solidAngle;
};

// Visits lights above the horizon for v = (sin, 0, NoV), n = +z. By symmetry half the azimuths do.
template <class Visit>
void forEachReflection(const BrdfModel& m, float NoV, float alpha, const Visit& visit,
                       int heights = 400, int azimuths = 48) {
    const vec3 v(std::sqrt(1.0f - NoV * NoV), 0.0f, NoV);
    for (int i = 0; i < heights; ++i)
        for (int j = 0; j < azimuths; ++j) {
            // s² towards u = 1, where the long tails are
            const float t = (static_cast<float>(i) + 0.5f) / static_cast<float>(heights);
            const vec2 u(t * (2.0f - t), (static_cast<float>(j) + 0.5f) / (2.0f * azimuths));
            const float du = 2.0f * (1.0f - t) / static_cast<float>(heights);
            const vec3 h = m.distribution == kDistributionGGX ? sampleHalfVectorGGX(u, alpha)
                           : m.distribution == kDistributionBeckmann
                               ? sampleHalfVectorBeckmann(u, alpha)
                               : sampleHalfVectorBlinnPhong(u, alpha);
            const float VoH = dot(v, h);
            const vec3 l = 2.0f * VoH * h - v;
            if (VoH <= 0.0f || l.z <= 0.0f)
                continue;
            const float sin2 = h.x * h.x + h.y * h.y;
            const double pdf = distribution(m, h.z, sin2, alpha) * h.z / (4.0 * VoH);
            visit(LobeNode{l, h.z, l.z, VoH, sin2, du / (azimuths * pdf)});
        }
}

// (scale, bias) of the model's D and V, as the DFG table holds them.
inline vec2 quadratureDfg(const BrdfModel& m, float NoV, float alpha) {
    double scale = 0.0, bias = 0.0;
    forEachReflection(m, NoV, alpha, [&](const LobeNode& n) {
        const double f = double(distribution(m, n.NoH, n.sin2, alpha)) *
                         visibility(m, NoV, n.NoL, n.VoH, alpha) * n.NoL * n.solidAngle;
        const double weight = schlickWeight(n.VoH);
        scale += f * (1.0 - weight);
        bias += f * weight;
    });
    return {static_cast<float>(scale), static_cast<float>(bias)};
}

} // namespace patina::shading
