#include "core/light/BrdfLens.h"

#include "core/base/Check.h"
#include "core/material/BrdfModel.h"

#include <algorithm>
#include <cmath>

namespace patina {

namespace {

constexpr float kHalfPi = shading::kPi / 2.0f;
constexpr int kSteps = 180; // of a curve, 1° each

} // namespace

glm::vec3 lensDirection(float theta) {
    return {std::sin(theta), 0.0f, std::cos(theta)};
}

std::vector<float> lensAngles(float peak, float alpha) {
    std::vector<float> angles;
    for (int i = 0; i <= kSteps; ++i)
        angles.push_back(-kHalfPi +
                         2.0f * kHalfPi * static_cast<float>(i) / static_cast<float>(kSteps));
    // From a sixteenth of the highlight's width outwards, by a quarter of the way each time.
    const float middle = std::clamp(peak, -kHalfPi, kHalfPi);
    angles.push_back(middle);
    for (float away = alpha / 16.0f; away < 0.35f; away *= 1.25f)
        for (const float angle : {middle - away, middle + away})
            if (std::abs(angle) < kHalfPi)
                angles.push_back(angle);
    std::sort(angles.begin(), angles.end());
    angles.erase(std::unique(angles.begin(), angles.end()), angles.end());
    return angles;
}

BrdfLens::BrdfLens(const ShadingModel& model, const SurfacePoint& point, ImagePtr dfgTable)
    : m_choices(model)
    , m_model(brdfModel(model))
    , m_point(point)
    , m_dfgTable(std::move(dfgTable)) {
    CHECK(m_dfgTable && m_dfgTable->channels() == 3);
    CHECK_EQ(static_cast<float>(m_dfgTable->width()), shading::kDfgTableSize);
    // As surface.frag limits what it fetched.
    m_point.baseColor = glm::clamp(m_point.baseColor, 0.0f, 1.0f);
    m_point.metallic = std::clamp(m_point.metallic, 0.0f, 1.0f);
}

float BrdfLens::alpha() const {
    return shading::alphaFromPerceptualRoughness(m_point.perceptualRoughness);
}

glm::vec3 BrdfLens::dfg(float NoV) const {
    const glm::vec2 uv = shading::dfgTableUv(std::clamp(NoV, 0.0f, 1.0f),
                                             std::clamp(m_point.perceptualRoughness, 0.0f, 1.0f));
    return glm::vec3(sampleBilinear(*m_dfgTable, uv.x, uv.y));
}

shading::SurfaceTerms BrdfLens::surface(const glm::vec3& n, const glm::vec3& v) const {
    const float NoV = std::clamp(glm::dot(n, v), shading::kMinNoV, 1.0f);
    return shading::makeSurface(m_model, m_point, n, v, glm::vec2(dfg(NoV)));
}

glm::vec3 BrdfLens::brdf(const glm::vec3& l, const glm::vec3& v, LensLobe lobe) const {
    if (l.z <= 0.0f || v.z <= 0.0f)
        return glm::vec3(0.0f);
    // shadeDirect() multiplies with N·L.
    const shading::ShadedLight light =
        shading::shadeDirect(surface({0.0f, 0.0f, 1.0f}, v), l, glm::vec3(1.0f / l.z));
    switch (lobe) {
    case LensLobe::Specular:
        return light.specular;
    case LensLobe::Diffuse:
        return light.diffuse;
    case LensLobe::Both:
        break;
    }
    return light.diffuse + light.specular;
}

float BrdfLens::distribution(float theta) const {
    const float s = std::sin(theta);
    return shading::distribution(m_model, std::max(std::cos(theta), 0.0f), s * s, alpha());
}

glm::vec3 BrdfLens::fresnel(float theta) const {
    const glm::vec3 n(0.0f, 0.0f, 1.0f); // F0 is that of any view
    return shading::fresnel(m_model, surface(n, n).f0, m_point.metallic,
                            std::max(std::cos(theta), 0.0f));
}

float BrdfLens::masking(float thetaL, float thetaV) const {
    const float NoL = std::max(std::cos(thetaL), 0.0f);
    const float NoV = std::max(std::cos(thetaV), shading::kMinNoV);
    const float VoH = std::max(std::cos(0.5f * (thetaV - thetaL)), 0.0f);
    return 4.0f * NoL * NoV * shading::visibility(m_model, NoV, NoL, VoH, alpha());
}

LensAlbedo BrdfLens::albedo(float thetaV, LensLobe lobe) const {
    const bool specular = lobe != LensLobe::Diffuse, diffuse = lobe != LensLobe::Specular;
    const glm::vec3 v = lensDirection(thetaV), n(0.0f, 0.0f, 1.0f);
    const auto ofTable = [&](int multiScatter) {
        BrdfLens variant = *this;
        variant.m_model.multiScatter = multiScatter;
        const shading::SurfaceTerms s = variant.surface(n, v);
        return (specular ? s.specularAlbedo : glm::vec3(0.0f)) +
               (diffuse ? s.diffuseAlbedo : glm::vec3(0.0f));
    };
    LensAlbedo albedo;
    albedo.single = ofTable(0);
    albedo.multi = ofTable(1);
    const Returned lights = returnedFromLights(m_choices, m_point, std::max(v.z, 0.0f));
    if (specular)
        albedo.exact += glm::vec3(lights.specular);
    if (diffuse)
        albedo.exact += glm::vec3(lights.diffuse);
    return albedo;
}

} // namespace patina
