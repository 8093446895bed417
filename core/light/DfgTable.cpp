#include "core/light/DfgTable.h"

#include "core/base/Check.h"
#include "core/job/Parallel.h"
#include "core/math/Quadrature.h"
#include "core/math/Shading.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace patina {

namespace {

// The terms to integrate, as a constant: after inlining, only the chosen ones are left.
template <Distribution D, Visibility V>
[[gnu::always_inline]] inline shading::BrdfModel lobeModel() {
    shading::BrdfModel model = shading::defaultBrdfModel();
    model.distribution = static_cast<int>(D);
    model.visibility = static_cast<int>(V);
    return model;
}

// ---- Quadrature
// ----------------------------------------------------------------------------------

// Nodes of the unit square that the visible normals are parametrised over: height in the spherical
// cap and azimuth; half the circle, because the integrand is symmetric about the plane of n and v.
// `upper` and `lower` heights: above and below the horizon's edge.
template <typename Real, int upper, int lower, int azimuths>
struct Nodes {
    static constexpr int kHeights = upper + lower, kAzimuths = azimuths;
    Real height[kHeights], heightWeight[kHeights];
    Real cosine[kAzimuths], sine[kAzimuths], azimuthWeight[kAzimuths];

    Nodes() {
        const GaussLegendre above(upper), below(lower), around(azimuths);
        for (int i = 0; i < upper; ++i) {
            // s²: crowded at the horizon, where masking makes the integrand fall to zero.
            const double s = above.node01(i);
            height[i] = static_cast<Real>(s * s);
            heightWeight[i] = static_cast<Real>(2.0 * s * above.weight01(i));
        }
        for (int i = 0; i < lower; ++i) {
            height[upper + i] = static_cast<Real>(below.node01(i));
            heightWeight[upper + i] = static_cast<Real>(below.weight01(i));
        }
        for (int k = 0; k < azimuths; ++k) {
            const double phi = std::numbers::pi * around.node01(k);
            cosine[k] = static_cast<Real>(std::cos(phi));
            sine[k] = static_cast<Real>(std::sin(phi));
            azimuthWeight[k] = static_cast<Real>(around.weight01(k));
        }
    }
};

using TableNodes = Nodes<float, 20, 12, 16>;
using FineNodes = Nodes<double, 128, 128, 256>;

// ∫ over visible normals h of GGX (Dupuy & Benyoub 2023), whatever the terms: their density of l,
// D_GGX G1(v) / (4 N·V), follows every lobeModel closely enough, and for GGX itself it cancels D
// and leaves a smooth function of the unit square. Split by F = F0 (1 - Fc) + Fc, Karis 2013.
template <Distribution D, Visibility V, typename Real, int upper, int lower, int azimuths>
[[gnu::always_inline]] inline glm::dvec3 integrate(const Nodes<Real, upper, lower, azimuths>& nodes,
                                                   Real NoV, Real alpha) {
    constexpr int kAzimuths = azimuths, kHeights = upper + lower;
    const shading::BrdfModel model = lobeModel<D, V>();
    const Real a2 = alpha * alpha;
    const Real sinV = std::sqrt(std::max(1 - NoV * NoV, Real(0)));
    const Real length = std::sqrt(a2 * sinV * sinV + NoV * NoV);
    const Real xStd = alpha * sinV / length, zStd = NoV / length; // v in the stretched space
    // 4 N·V / G1(v), Heitz 2014, eq. 72
    const Real density = 2 * (NoV + std::sqrt(NoV * NoV * (1 - a2) + a2));
    // At some height of the cap, which depends on the azimuth, light goes under the horizon and the
    // integrand has a kink: integrate each side of it for itself. Below it little is left (at
    // grazing views half vectors that lean away from the viewer come up once more).
    Real horizon[kAzimuths], high[kAzimuths];
    for (int k = 0; k < kAzimuths; ++k) {
        horizon[k] = -zStd;
        high[k] = 1;
    }
    // An edge that is off by d costs an error of the order of d²: 10 steps are enough for the
    // table.
    constexpr int kBisections = sizeof(Real) == 4 ? 10 : 44;
    for (int step = 0; step < kBisections; ++step)
        for (int k = 0; k < kAzimuths; ++k) {
            const Real low = horizon[k], top = high[k];
            const Real z = Real(0.5) * (low + top);
            const Real r = std::sqrt(1 - z * z);
            const Real hx = (r * nodes.cosine[k] + xStd) * alpha;
            const Real hy = r * nodes.sine[k] * alpha;
            const Real hz = z + zStd;
            const Real length2 = hx * hx + hy * hy + hz * hz;
            const bool below = 2 * (sinV * hx + NoV * hz) * hz < NoV * length2;
            horizon[k] = below ? z : low;
            high[k] = below ? top : z;
        }

    const auto NoV32 = static_cast<float>(NoV), alpha32 = static_cast<float>(alpha);
    Real scale[kAzimuths] = {}, bias[kAzimuths] = {}, along[kAzimuths] = {}, up[kAzimuths] = {};
    Real from[kAzimuths], extent[kAzimuths];
    for (int i = 0; i < kHeights; ++i) {
        if (i == 0 || i == upper)
            for (int k = 0; k < kAzimuths; ++k) {
                from[k] = i == 0 ? horizon[k] : -zStd;
                extent[k] = (i == 0 ? Real(1) : horizon[k]) - from[k];
            }
        const Real height = nodes.height[i];
        const Real heightWeight = nodes.heightWeight[i] / (1 + zStd) * density;
        // One lane per azimuth: the compiler turns each of these short loops into SIMD. Clamps
        // stand alone: next to more work it would branch around that, and not vectorize. The half
        // vectors and the light:
        float NoH[kAzimuths], sin2[kAzimuths], NoL[kAzimuths];
        Real VoH[kAzimuths], lx[kAzimuths], weight[kAzimuths];
        for (int k = 0; k < kAzimuths; ++k) {
            const Real z = from[k] + extent[k] * height;
            const Real r = std::sqrt(std::abs(1 - z * z)); // of a rounding error at z = 1
            const Real hx = (r * nodes.cosine[k] + xStd) * alpha;
            const Real hy = r * nodes.sine[k] * alpha;
            const Real hz = z + zStd;
            const Real hxy2 = hx * hx + hy * hy;
            const Real inverse = 1 / std::sqrt(hxy2 + hz * hz + Real(1e-30));
            const Real cosine = (sinV * hx + NoV * hz) * inverse;
            NoH[k] = static_cast<float>(hz * inverse);
            sin2[k] = static_cast<float>(hxy2 * inverse * inverse);
            VoH[k] = cosine;
            NoL[k] = static_cast<float>(2 * cosine * hz * inverse - NoV);
            lx[k] = 2 * cosine * hx * inverse - sinV;
            weight[k] = nodes.azimuthWeight[k] * heightWeight * extent[k];
        }
        for (int k = 0; k < kAzimuths; ++k)
            NoL[k] = std::max(NoL[k], 0.0f);
        // The lobeModel over the density:
        if constexpr (D != Distribution::GGX)
            for (int k = 0; k < kAzimuths; ++k)
                weight[k] *= shading::distribution(model, NoH[k], sin2[k], alpha32) /
                             shading::D_GGX_Sin2(NoH[k], sin2[k], alpha32);
        for (int k = 0; k < kAzimuths; ++k)
            weight[k] *=
                shading::visibility(model, NoV32, NoL[k], static_cast<float>(VoH[k]), alpha32) *
                NoL[k];
        // The integrals:
        for (int k = 0; k < kAzimuths; ++k) {
            const Real m = std::abs(1 - VoH[k]);
            const Real Fc = m * m * m * m * m;
            scale[k] += weight[k] * (1 - Fc);
            bias[k] += weight[k] * Fc;
            along[k] -= weight[k] * lx[k];
            up[k] += weight[k] * NoL[k];
        }
    }
    double A = 0, B = 0, x = 0, z = 0;
    for (int k = 0; k < kAzimuths; ++k) {
        A += scale[k];
        B += bias[k];
        x += along[k];
        z += up[k];
    }
    // (x, z) ∝ (t sinV, 1 - t + t N·V): the mean direction as a mix of n (0, 1) and R (sinV, N·V)
    return {A, B, x / (sinV * z + x * (1.0 - NoV))};
}

template <Distribution D, Visibility V>
glm::dvec3 integrateFine(const FineNodes& nodes, double NoV, double alpha) {
    return integrate<D, V>(nodes, NoV, alpha);
}

template <Distribution D, Visibility V>
glm::dvec3 integrateBaseline(const TableNodes& nodes, float NoV, float alpha) {
    return integrate<D, V>(nodes, NoV, alpha);
}

#if defined(__x86_64__)
template <Distribution D, Visibility V>
[[gnu::target("avx2,fma")]] glm::dvec3 integrateAvx2(const TableNodes& nodes, float NoV,
                                                     float alpha) {
    return integrate<D, V>(nodes, NoV, alpha);
}
#endif

// ---- Dispatch
// ------------------------------------------------------------------------------------

struct Integrator {
    glm::dvec3 (*fine)(const FineNodes&, double, double);
    glm::dvec3 (*table)(const TableNodes&, float, float);
};

template <Distribution D, Visibility V>
Integrator integratorOf() {
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
        return {integrateFine<D, V>, integrateAvx2<D, V>};
#endif
    return {integrateFine<D, V>, integrateBaseline<D, V>};
}

template <Distribution D>
Integrator chooseVisibility(Visibility visibility) {
    switch (visibility) {
    case Visibility::SmithCorrelated:
        return integratorOf<D, Visibility::SmithCorrelated>();
    case Visibility::SmithSeparable:
        return integratorOf<D, Visibility::SmithSeparable>();
    case Visibility::SchlickDirect:
        return integratorOf<D, Visibility::SchlickDirect>();
    case Visibility::SchlickIbl:
        return integratorOf<D, Visibility::SchlickIbl>();
    case Visibility::Kelemen:
        return integratorOf<D, Visibility::Kelemen>();
    default:
        CHECK(visibility == Visibility::Implicit);
        return integratorOf<D, Visibility::Implicit>();
    }
}

Integrator chooseIntegrator(Distribution distribution, Visibility visibility) {
    switch (distribution) {
    case Distribution::GGX:
        return chooseVisibility<Distribution::GGX>(visibility);
    case Distribution::Beckmann:
        return chooseVisibility<Distribution::Beckmann>(visibility);
    default:
        CHECK(distribution == Distribution::BlinnPhong);
        return chooseVisibility<Distribution::BlinnPhong>(visibility);
    }
}

} // namespace

glm::dvec3 integrateDfg(float NoV, float perceptualRoughness, Distribution distribution,
                        Visibility visibility) {
    // alpha = 0 is a mirror, whose integral is the limit; the floor keeps 0 / 0 out. So does the
    // ceiling at N·V = 1, where n and R are one and the tilt is a limit, too.
    const double r = std::clamp(perceptualRoughness, 0.0f, 1.0f);
    const double alpha = std::max(r * r, 1e-6);
    static const FineNodes kNodes;
    return chooseIntegrator(distribution, visibility)
        .fine(kNodes, std::clamp(static_cast<double>(NoV), 1e-4, 1.0 - 1e-7), alpha);
}

namespace {

// The table's quadrature, kept off the limits: N·V = 0, where the lobeModel has no density, N·V =
// 1, where n and R are one, and a mirror.
glm::dvec3 tableEntry(const Integrator& integrator, const TableNodes& nodes, float NoV,
                      float perceptualRoughness) {
    return integrator.table(nodes, std::clamp(NoV, 1e-3f, 1.0f - 1e-4f),
                            std::max(perceptualRoughness * perceptualRoughness, 1e-5f));
}

} // namespace

glm::dvec2 estimateDfg(float NoV, float perceptualRoughness, Distribution distribution,
                       Visibility visibility) {
    static const TableNodes kNodes;
    return tableEntry(chooseIntegrator(distribution, visibility), kNodes, NoV,
                      std::clamp(perceptualRoughness, 0.0f, 1.0f));
}

Image computeDfgTable(int size, Distribution distribution, Visibility visibility,
                      DfgTexels texels) {
    CHECK_LE(2, size);
    Image table(size, size, 3, PixelType::F32, ColorEncoding::Data);
    const std::span<float> out = table.f32();
    const TableNodes nodes;
    const Integrator integrator = chooseIntegrator(distribution, visibility);
    const auto position = [&](std::size_t i) {
        return texels == DfgTexels::Inside
                   ? (static_cast<float>(i) + 0.5f) / static_cast<float>(size)
                   : static_cast<float>(i) / static_cast<float>(size - 1);
    };
    const auto count = static_cast<std::size_t>(size);
    parallelFor(JobContext(), count, 4, [&](std::size_t begin, std::size_t end) {
        for (std::size_t y = begin; y < end; ++y)
            for (std::size_t x = 0; x < count; ++x) {
                const glm::vec3 dfg(tableEntry(integrator, nodes, position(x), position(y)));
                std::copy_n(&dfg.x, 3, out.data() + (y * count + x) * 3);
            }
    });
    return table;
}

Visibility iblVisibility(Visibility visibility) {
    return visibility == Visibility::SchlickDirect ? Visibility::SchlickIbl : visibility;
}

} // namespace patina
