#include "core/light/Energy.h"

#include "core/light/DfgTable.h"
#include "core/material/BrdfModel.h"
#include "core/math/Quadrature.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace patina {

namespace {

// The surface with n along z and v in the plane of x and z.
shading::SurfaceTerms surfaceTerms(const ShadingModel& model, const SurfacePoint& point,
                                   float NoV) {
    const glm::dvec2 dfg = estimateDfg(NoV, point.perceptualRoughness, model.distribution,
                                       iblVisibility(model.visibility));
    const float mu = std::clamp(NoV, shading::kMinNoV, 1.0f);
    const glm::vec3 v(std::sqrt(1.0f - mu * mu), 0.0f, mu);
    return shading::makeSurface(brdfModel(model), point, glm::vec3(0.0f, 0.0f, 1.0f), v,
                                glm::vec2(dfg));
}

// ∫ specular cos: over visible normals of GGX (Dupuy & Benyoub 2023), whose density follows every
// lobe closely enough. As in DfgTable.cpp each side of the kink, where light goes under the
// horizon, is integrated for itself.
glm::dvec3 integrateSpecular(const shading::SurfaceTerms& s) {
    static const GaussLegendre kAbove(32), kBelow(12), kAround(32);
    const double alpha = s.alpha, NoV = s.v.z, sinV = s.v.x;
    const double length = std::sqrt(alpha * alpha * sinV * sinV + NoV * NoV);
    const double xStd = alpha * sinV / length, zStd = NoV / length; // v in the stretched space
    const double density = // 4 N·V / G1(v), Heitz 2014, eq. 72
        2.0 * (NoV + std::sqrt(NoV * NoV * (1.0 - alpha * alpha) + alpha * alpha));
    const auto halfVector = [&](double z, double phi) {
        const double r = std::sqrt(std::max(1.0 - z * z, 0.0));
        return glm::normalize(glm::dvec3(alpha * (r * std::cos(phi) + xStd),
                                         alpha * r * std::sin(phi), z + zStd + 1e-12));
    };
    const auto lightOf = [&](const glm::dvec3& h) {
        return 2.0 * (sinV * h.x + NoV * h.z) * h - glm::dvec3(sinV, 0.0, NoV);
    };

    glm::dvec3 sum(0.0);
    for (int k = 0; k < kAround.size(); ++k) {
        const double phi = std::numbers::pi * kAround.node01(k);
        double horizon = -zStd, high = 1.0;
        for (int step = 0; step < 40; ++step) {
            const double z = 0.5 * (horizon + high);
            (lightOf(halfVector(z, phi)).z < 0.0 ? horizon : high) = z;
        }
        const auto add = [&](double z, double weight) {
            const glm::dvec3 h = halfVector(z, phi);
            const glm::vec3 l(glm::normalize(lightOf(h)));
            const double D = shading::D_GGX_Sin2(static_cast<float>(h.z),
                                                 static_cast<float>(h.x * h.x + h.y * h.y),
                                                 static_cast<float>(alpha));
            sum += glm::dvec3(shading::shadeDirect(s, l, glm::vec3(1.0f)).specular) *
                   (kAround.weight01(k) * weight / (1.0 + zStd) * density / D);
        };
        // s²: crowded at the horizon, where masking makes the integrand fall to zero.
        for (int i = 0; i < kAbove.size(); ++i) {
            const double t = kAbove.node01(i);
            add(horizon + (1.0 - horizon) * t * t, (1.0 - horizon) * 2.0 * t * kAbove.weight01(i));
        }
        for (int i = 0; i < kBelow.size(); ++i)
            add(-zStd + (horizon + zStd) * kBelow.node01(i), (horizon + zStd) * kBelow.weight01(i));
    }
    return sum;
}

// ∫ diffuse cos over N·L and half of the azimuths.
glm::dvec3 integrateDiffuse(const shading::SurfaceTerms& s) {
    static const GaussLegendre kUp(16), kAround(16);
    glm::dvec3 sum(0.0);
    for (int i = 0; i < kUp.size(); ++i) {
        const double mu = kUp.node01(i), sine = std::sqrt(1.0 - mu * mu);
        for (int k = 0; k < kAround.size(); ++k) {
            const double phi = std::numbers::pi * kAround.node01(k);
            const glm::vec3 l(sine * std::cos(phi), sine * std::sin(phi), mu);
            sum += glm::dvec3(shading::shadeDirect(s, l, glm::vec3(1.0f)).diffuse) *
                   (kUp.weight01(i) * kAround.weight01(k));
        }
    }
    return 2.0 * std::numbers::pi * sum;
}

// What is seen through the surface is not lost.
glm::dvec3 through(const shading::SurfaceTerms& s) {
    return glm::dvec3(shading::shadeThrough(s, glm::vec3(1.0f)));
}

} // namespace

Returned returnedFromEnvironment(const ShadingModel& model, const SurfacePoint& point, float NoV) {
    const shading::SurfaceTerms s = surfaceTerms(model, point, NoV);
    return {glm::dvec3(s.specularAlbedo), glm::dvec3(s.diffuseAlbedo) + through(s)};
}

Returned returnedFromLights(const ShadingModel& model, const SurfacePoint& point, float NoV) {
    const shading::SurfaceTerms s = surfaceTerms(model, point, NoV);
    Returned returned{integrateSpecular(s), glm::dvec3(0.0)};
    if (point.metallic < 1.0f)
        returned.diffuse = integrateDiffuse(s) + through(s);
    return returned;
}

Returned averageReturned(const std::function<Returned(float NoV)>& returned) {
    static const GaussLegendre kViews(16);
    Returned average;
    for (int i = 0; i < kViews.size(); ++i) {
        const double mu = kViews.node01(i), weight = 2.0 * mu * kViews.weight01(i);
        const Returned at = returned(static_cast<float>(mu));
        average.specular += weight * at.specular;
        average.diffuse += weight * at.diffuse;
    }
    return average;
}

EnergyBalance energyBalance(const Returned& single, const Returned& compensated,
                            bool multiScatter) {
    const Returned& now = multiScatter ? compensated : single;
    EnergyBalance balance;
    balance.specular = now.specular;
    balance.diffuse = now.diffuse;
    balance.absorbed = glm::dvec3(1.0) - compensated.total();
    balance.lost = compensated.total() - now.total();
    return balance;
}

glm::dvec3 specularLoss(const Returned& single, const Returned& compensated) {
    return glm::dvec3(1.0) - single.specular / glm::max(compensated.specular, glm::dvec3(1e-9));
}

ShadingModel withCompensation(ShadingModel model, bool multiScatter) {
    model.multiScatter = multiScatter;
    return model;
}

} // namespace patina
