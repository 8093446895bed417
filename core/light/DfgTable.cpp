#include "core/base/Check.h"
#include "core/job/Parallel.h"
#include "core/light/Ibl.h"
#include "core/math/Quadrature.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace patina {

namespace {

// Nodes of the unit square that the visible normals are parametrised over: height in the spherical
// cap and azimuth; half the circle, because the integrand is symmetric about the plane of n and v.
constexpr int kUpperHeights = 20, kLowerHeights = 12; // above and below the horizon's edge
constexpr int kHeights = kUpperHeights + kLowerHeights;
constexpr int kAzimuths = 16;

struct Nodes {
    float height[kHeights], heightWeight[kHeights];
    float cosine[kAzimuths], sine[kAzimuths], azimuthWeight[kAzimuths];

    Nodes() {
        const GaussLegendre upper(kUpperHeights), lower(kLowerHeights), azimuths(kAzimuths);
        for (int i = 0; i < kUpperHeights; ++i) {
            // s²: crowded at the horizon, where masking makes the integrand fall to zero.
            const double s = upper.node01(i);
            height[i] = static_cast<float>(s * s);
            heightWeight[i] = static_cast<float>(2.0 * s * upper.weight01(i));
        }
        for (int i = 0; i < kLowerHeights; ++i) {
            height[kUpperHeights + i] = static_cast<float>(lower.node01(i));
            heightWeight[kUpperHeights + i] = static_cast<float>(lower.weight01(i));
        }
        for (int k = 0; k < kAzimuths; ++k) {
            const double phi = std::numbers::pi * azimuths.node01(k);
            cosine[k] = static_cast<float>(std::cos(phi));
            sine[k] = static_cast<float>(std::sin(phi));
            azimuthWeight[k] = static_cast<float>(azimuths.weight01(k));
        }
    }
};

// E = ∫ f cos dω over visible normals (Dupuy & Benyoub 2023): the density cancels all but
// F G2 / G1, a smooth function of the unit square. Split by F = F0 (1 - Fc) + Fc, Karis 2013.
[[gnu::always_inline]] inline glm::vec2 integrate(const Nodes& nodes, float NoV, float alpha) {
    const float a2 = alpha * alpha;
    const float sinV = std::sqrt(std::max(1.0f - NoV * NoV, 0.0f));
    const float length = std::sqrt(a2 * sinV * sinV + NoV * NoV);
    const float xStd = alpha * sinV / length, zStd = NoV / length;     // v in the stretched space
    const float sqrtV = std::sqrt(NoV * NoV * (1.0f - a2) + a2) / NoV; // 1 + 2 Lambda(v)
    // At some height of the cap, which depends on the azimuth, light goes under the horizon and the
    // integrand has a kink: integrate each side of it for itself. Below it little is left (at
    // grazing views half vectors that lean away from the viewer come up once more).
    float horizon[kAzimuths], high[kAzimuths];
    for (int k = 0; k < kAzimuths; ++k) {
        horizon[k] = -zStd;
        high[k] = 1.0f;
    }
    for (int step = 0; step < 16; ++step)
        for (int k = 0; k < kAzimuths; ++k) {
            const float z = 0.5f * (horizon[k] + high[k]);
            const float r = std::sqrt(1.0f - z * z);
            const float hx = (r * nodes.cosine[k] + xStd) * alpha;
            const float hy = r * nodes.sine[k] * alpha;
            const float hz = z + zStd;
            const float length2 = hx * hx + hy * hy + hz * hz;
            const bool below = 2.0f * (sinV * hx + NoV * hz) * hz < NoV * length2;
            horizon[k] = below ? z : horizon[k];
            high[k] = below ? high[k] : z;
        }

    float scale[kAzimuths] = {}, bias[kAzimuths] = {};
    for (int i = 0; i < kHeights; ++i) {
        // One lane per azimuth: the compiler turns this loop into SIMD.
        for (int k = 0; k < kAzimuths; ++k) {
            const float from = i < kUpperHeights ? horizon[k] : -zStd;
            const float extent = (i < kUpperHeights ? 1.0f : horizon[k]) - from;
            const float z = from + extent * nodes.height[i];
            const float heightWeight = nodes.heightWeight[i] * extent / (1.0f + zStd);
            const float r2 = 1.0f - z * z;
            const float r = std::sqrt(r2 > 0.0f ? r2 : 0.0f);
            // The half vector and the light
            const float hx = (r * nodes.cosine[k] + xStd) * alpha;
            const float hy = r * nodes.sine[k] * alpha;
            const float hz = z + zStd;
            const float inverse = 1.0f / std::sqrt(hx * hx + hy * hy + hz * hz + 1e-30f);
            const float NoH = hz * inverse;
            const float product = (sinV * hx + NoV * hz) * inverse;
            const float VoH = product < 1.0f ? product : 1.0f;
            const float raw = 2.0f * VoH * NoH - NoV;
            const float NoL = raw > 0.0f ? raw : 0.0f;
            // G2 / G1 = (1 + Lambda(v)) / (1 + Lambda(v) + Lambda(l)), height-correlated Smith
            const float rootL = std::sqrt(NoL * NoL * (1.0f - a2) + a2);
            const float ratio = (1.0f + sqrtV) * NoL / (sqrtV * NoL + rootL);
            const float m = 1.0f - VoH;
            const float Fc = m * m * m * m * m;
            const float w = ratio * (nodes.azimuthWeight[k] * heightWeight);
            scale[k] += w * (1.0f - Fc);
            bias[k] += w * Fc;
        }
    }
    glm::vec2 result(0.0f);
    for (int k = 0; k < kAzimuths; ++k)
        result += glm::vec2(scale[k], bias[k]);
    return result;
}

using Integrate = glm::vec2 (*)(const Nodes&, float, float);

glm::vec2 integrateBaseline(const Nodes& nodes, float NoV, float alpha) {
    return integrate(nodes, NoV, alpha);
}

#if defined(__x86_64__)
[[gnu::target("avx2,fma")]] glm::vec2 integrateAvx2(const Nodes& nodes, float NoV, float alpha) {
    return integrate(nodes, NoV, alpha);
}
#endif

Integrate chooseIntegrate() {
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
        return integrateAvx2;
#endif
    return integrateBaseline;
}

} // namespace

glm::vec2 integrateDfg(float NoV, float perceptualRoughness) {
    // alpha = 0 is a mirror, whose integral is the limit; the floor keeps 0 / 0 out.
    const float alpha = std::max(perceptualRoughness * perceptualRoughness, 1e-6f);
    return chooseIntegrate()(Nodes(), std::clamp(NoV, 1e-4f, 1.0f), alpha);
}

Image computeDfgTable(int size) {
    CHECK_LE(1, size);
    Image table(size, size, 3, PixelType::F32, ColorEncoding::Data);
    const std::span<float> out = table.f32();
    const Nodes nodes;
    const Integrate integrateCell = chooseIntegrate();
    parallelFor(JobContext(), size, 4, [&](std::size_t begin, std::size_t end) {
        for (std::size_t y = begin; y < end; ++y)
            for (int x = 0; x < size; ++x) {
                const float NoV = (static_cast<float>(x) + 0.5f) / static_cast<float>(size);
                const float r = (static_cast<float>(y) + 0.5f) / static_cast<float>(size);
                const glm::vec2 dfg = integrateCell(nodes, NoV, r * r);
                float* texel = out.data() + (y * size + x) * 3;
                texel[0] = dfg.x;
                texel[1] = dfg.y;
            }
    });
    return table;
}

} // namespace patina
