#include "core/trace/path/Glass.h"

#include "core/math/Shading.h"
#include "core/trace/path/TraceScene.h"

#include <algorithm>
#include <cmath>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>

namespace patina {
namespace {

// Indices nearer to each other than this do not refract: the bend is below 0.03° but at grazing
// angles, and the half vector of such a refraction has no digits left.
constexpr float kSameIndex = 5e-4f;

struct Frame {
    glm::vec3 t{0.0f}, b{0.0f}, n;
    explicit Frame(const glm::vec3& normal)
        : n(normal) {
        shading::orthonormalBasis(n, t, b);
    }
    [[nodiscard]] glm::vec3 into(const glm::vec3& w) const {
        return {glm::dot(w, t), glm::dot(w, b), glm::dot(w, n)};
    }
    [[nodiscard]] glm::vec3 world(const glm::vec3& w) const {
        return glm::normalize(w.x * t + w.y * b + w.z * n);
    }
};

// The viewer in the frame of the normal, never below it.
glm::vec3 viewerOf(const GlassTerms& glass, const Frame& frame) {
    const glm::vec3 v = frame.into(glass.v);
    return glm::normalize(glm::vec3(v.x, v.y, glass.NoV));
}

float distributionAt(const glm::vec3& wm, float alpha) {
    return shading::D_GGX_Sin2(wm.z, std::min(wm.x * wm.x + wm.y * wm.y, 1.0f), alpha);
}

// Of visible normals, per steradian of the facet: Heitz 2018, equation 3.
float visibleDensity(const glm::vec3& wo, const glm::vec3& wm, float alpha) {
    return shading::G1_SmithGGX(wo.z, alpha) * distributionAt(wm, alpha) *
           std::max(glm::dot(wo, wm), 0.0f) / wo.z;
}

// Snell's law about `m`, for `cosine` = wo · m > 0 at an angle that is not totally reflected.
glm::vec3 refracted(const glm::vec3& wo, const glm::vec3& m, float cosine, float eta) {
    if (eta == 1.0f)
        return -wo;
    const float sin2 = std::max(1.0f - cosine * cosine, 0.0f) / (eta * eta);
    const float behind = std::sqrt(std::max(1.0f - sin2, 0.0f));
    return glm::normalize(-wo / eta + (cosine / eta - behind) * m);
}

glm::vec3 mirrored(const glm::vec3& w) {
    return {w.x, w.y, -w.z};
}

// The facet that reflects or refracts wi to wo, on the side of wo: Walter et al. 2007, equations 13
// and 16. Zero: none.
glm::vec3 halfVector(const glm::vec3& wo, const glm::vec3& wi, float eta) {
    glm::vec3 h = wi.z > 0.0f ? wo + wi : wo + eta * wi;
    const float length = glm::length(h);
    if (!(length > 1e-6f))
        return glm::vec3(0.0f);
    h /= h.z < 0.0f ? -length : length;
    // Facets that face away from one of the two show it nothing.
    if (glm::dot(h, wo) <= 0.0f || glm::dot(h, wi) * wi.z <= 0.0f)
        return glm::vec3(0.0f);
    return h;
}

// Steradians of the facet's normal over those of the refracted direction: Walter et al. 2007,
// equation 17, divided by eta².
float refractionJacobian(const glm::vec3& wo, const glm::vec3& wi, const glm::vec3& h, float eta) {
    const float sum = glm::dot(wi, h) + glm::dot(wo, h) / eta;
    return std::abs(glm::dot(wi, h)) / std::max(sum * sum, 1e-12f);
}

// Both sides at once: a thin wall is a mirror that sends its light on in the mirrored direction.
bool isBelow(const GlassTerms& glass, glm::vec3& wi) {
    const bool below = wi.z < 0.0f;
    if (below && glass.thinWalled)
        wi = mirrored(wi);
    return below;
}

float pdfInFrame(const GlassTerms& glass, const glm::vec3& wo, glm::vec3 wi) {
    const bool through = isBelow(glass, wi);
    const glm::vec3 h = halfVector(wo, wi, glass.eta);
    if (h == glm::vec3(0.0f))
        return 0.0f;
    const float cosine = glm::dot(wo, h);
    const float reflects = glassReflectance(glass, cosine);
    const float facet = visibleDensity(wo, h, glass.alpha);
    if (through && !glass.thinWalled)
        return (1.0f - reflects) * facet * refractionJacobian(wo, wi, h, glass.eta);
    return (through ? 1.0f - reflects : reflects) * facet / (4.0f * cosine);
}

// BSDF times the cosine. Walter et al. 2007, equations 20 and 21; radiance that enters an optically
// denser body is gathered into a smaller angle, hence the division by eta² (Veach 1997, section
// 5.2).
glm::vec3 valueInFrame(const GlassTerms& glass, const glm::vec3& wo, glm::vec3 wi) {
    const bool through = isBelow(glass, wi);
    const glm::vec3 h = halfVector(wo, wi, glass.eta);
    if (h == glm::vec3(0.0f))
        return glm::vec3(0.0f);
    const float cosine = glm::dot(wo, h);
    const float reflects = glassReflectance(glass, cosine);
    if (through && !glass.thinWalled) {
        const float value = (1.0f - reflects) * visibleDensity(wo, h, glass.alpha) *
                            shading::G1_SmithGGX(-wi.z, glass.alpha) *
                            refractionJacobian(wo, wi, h, glass.eta) / (glass.eta * glass.eta);
        return glass.gain * value * glass.tint;
    }
    const float lobe = distributionAt(h, glass.alpha) *
                       shading::V_SmithGGXCorrelated(wo.z, wi.z, glass.alpha) * wi.z;
    return glass.gain * lobe * (through ? (1.0f - reflects) * glass.tint : glm::vec3(reflects));
}

GlassSample smoothSample(const GlassTerms& glass, float u) {
    GlassSample sample;
    const float reflects = glassReflectance(glass, glass.NoV);
    sample.through = u >= reflects;
    if (!sample.through) {
        sample.direction = glm::normalize(2.0f * glm::dot(glass.n, glass.v) * glass.n - glass.v);
        sample.weight = glm::vec3(1.0f);
    } else if (glass.isStraight()) {
        sample.direction = -glass.v;
        sample.weight = glass.tint;
    } else {
        sample.direction = refracted(glass.v, glass.n, glass.NoV, glass.eta);
        sample.weight = glass.tint / (glass.eta * glass.eta);
    }
    return sample;
}

} // namespace

float glassAlpha(float perceptualRoughness, float eta, bool thinWalled) {
    const bool smooth = perceptualRoughness <= shading::kMinPerceptualRoughness;
    return smooth || (eta == 1.0f && !thinWalled)
               ? 0.0f
               : shading::alphaFromPerceptualRoughness(perceptualRoughness);
}

float glassEta(float indexBehind, float indexBefore) {
    const float eta = indexBehind / indexBefore;
    return std::abs(eta - 1.0f) < kSameIndex ? 1.0f : eta;
}

float glassReflectance(const GlassTerms& glass, float cosine) {
    if (glass.eta == 1.0f)
        return 0.0f;
    // Holds for eta below 1, too, where it is 1 beyond the critical angle.
    const float once = shading::F_Dielectric(cosine, glass.eta);
    // A wall's two faces: R + T² R (1 + R² + …) = R + T² R / (1 - R²) with T = 1 - R.
    return glass.thinWalled ? 2.0f * once / (1.0f + once) : once;
}

GlassSample sampleGlass(const GlassTerms& glass, const glm::vec3& u) {
    if (glass.isSmooth())
        return smoothSample(glass, u.z);
    GlassSample sample;
    const Frame frame(glass.n);
    const glm::vec3 wo = viewerOf(glass, frame);
    const glm::vec3 h = shading::sampleVndfGGX(glm::vec2(u), wo, glass.alpha);
    const float cosine = glm::dot(wo, h);
    if (!(cosine > 0.0f))
        return sample;
    sample.through = u.z >= glassReflectance(glass, cosine);
    glm::vec3 wi = sample.through && !glass.thinWalled ? refracted(wo, h, cosine, glass.eta)
                                                       : glm::normalize(2.0f * cosine * h - wo);
    if (sample.through && glass.thinWalled)
        wi = mirrored(wi);
    // Beyond the facets' horizon light would meet the surface a second time.
    if ((wi.z < 0.0f) != sample.through || wi.z == 0.0f)
        return sample;
    sample.pdf = pdfInFrame(glass, wo, wi);
    if (!(sample.pdf > 0.0f))
        return sample;
    sample.direction = frame.world(wi);
    sample.weight = valueInFrame(glass, wo, wi) / sample.pdf;
    return sample;
}

float glassPdf(const GlassTerms& glass, const glm::vec3& l) {
    const Frame frame(glass.n);
    return glass.isSmooth() ? 0.0f : pdfInFrame(glass, viewerOf(glass, frame), frame.into(l));
}

glm::vec3 evaluateGlass(const GlassTerms& glass, const glm::vec3& l) {
    const Frame frame(glass.n);
    return glass.isSmooth() ? glm::vec3(0.0f)
                            : valueInFrame(glass, viewerOf(glass, frame), frame.into(l));
}

glm::vec3 straightTransmittance(const GlassTerms& glass) {
    return glass.isSmooth() && glass.isStraight()
               ? (1.0f - glassReflectance(glass, glass.NoV)) * glass.tint
               : glm::vec3(0.0f);
}

void Media::enter(const Medium& medium) {
    if (m_count < kMost)
        m_media[m_count++] = medium;
    else
        m_media[kMost - 1] = medium;
}

void Media::leave(const TraceMaterial* material) {
    for (std::size_t i = m_count; i-- > 0;)
        if (m_media[i].material == material) {
            std::move(m_media.begin() + static_cast<std::ptrdiff_t>(i) + 1,
                      m_media.begin() + static_cast<std::ptrdiff_t>(m_count),
                      m_media.begin() + static_cast<std::ptrdiff_t>(i));
            --m_count;
            return;
        }
}

void Media::cross(const TracePoint& face, float ior) {
    if (face.isBack)
        leave(face.material);
    else
        enter({face.material, ior});
}

bool Media::contains(const TraceMaterial* material) const {
    return std::any_of(m_media.begin(), m_media.begin() + static_cast<std::ptrdiff_t>(m_count),
                       [&](const Medium& medium) { return medium.material == material; });
}

glm::vec3 Media::transmittance(float metres) const {
    if (m_count == 0)
        return glm::vec3(1.0f);
    const glm::vec3& absorption = m_media[m_count - 1].material->glass().absorption;
    glm::vec3 left(1.0f);
    for (int c = 0; c < 3; ++c)
        if (absorption[c] > 0.0f) // 0 times infinity is no number
            left[c] = std::exp(-absorption[c] * metres);
    return left;
}

} // namespace patina
