// How paths find light: by rays to lights, and by meeting them.
#include "core/trace/path/LightPath.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace patina {
namespace {

constexpr float kUnbounded = std::numeric_limits<float>::infinity();
// Sheets of glass that a ray to a light passes.
constexpr int kMostWalls = 256;

// Veach 1997, "Robust Monte Carlo Methods for Light Transport Simulation", section 9.2.4: the power
// heuristic with exponent 2.
float powerWeight(float pdf, float other) {
    if (!(pdf > 0.0f))
        return 0.0f;
    const float ratio = other / pdf;
    return 1.0f / (1.0f + ratio * ratio);
}

} // namespace

glm::vec3 LightPath::reflected(const shading::SurfaceTerms& terms, const glm::vec3& l) {
    const shading::ShadedLight light = shading::shadeDirect(terms, l, glm::vec3(1.0f));
    m_split.reflects(light.diffuse, light.specular);
    return light.diffuse + light.specular;
}

glm::vec3 LightPath::reflected(const Part& part, const glm::vec3& l) {
    if (!part.isGlass)
        return reflected(part.surface.opaque, l);
    const glm::vec3 value = evaluateGlass(part.surface.glass, l);
    m_split.reflects(glm::vec3(0.0f), value, glm::dot(part.surface.glass.n, l) < 0.0f);
    return value;
}

float LightPath::found(const Search& search, float lightPdf) const {
    if (search.smooth || search.fromCamera)
        return 1.0f;
    switch (m_settings.search) {
    case LightSearch::Both:
        return powerWeight(search.pdf, lightPdf);
    case LightSearch::Lights:
        return lightPdf > 0.0f ? 0.0f : 1.0f;
    case LightSearch::Surfaces:
        break;
    }
    return 1.0f;
}

float LightPath::sent(float lightPdf, float pdf) const {
    switch (m_settings.search) {
    case LightSearch::Both:
        return powerWeight(lightPdf, pdf);
    case LightSearch::Lights:
        return 1.0f;
    case LightSearch::Surfaces:
        break;
    }
    return 0.0f;
}

glm::vec3 LightPath::arriving(const Part& part, const glm::vec3& l, float metres) {
    const bool through = part.isGlass && glm::dot(part.point.face, l) < 0.0f;
    const glm::vec3 from = TraceScene::origin(part.point, through);
    Media media = m_media;
    if (through && !part.surface.glass.thinWalled)
        media.cross(part.point, part.surface.ior);
    if (m_scene.hasStraightGlass())
        return throughStraightGlass(from, l, metres, media);
    ++m_rays;
    return m_scene.occluded(from, l, std::isinf(metres) ? kUnbounded : m_scene.sceneUnits(metres))
               ? glm::vec3(0.0f)
               : media.transmittance(metres);
}

glm::vec3 LightPath::throughStraightGlass(glm::vec3 from, const glm::vec3& l, float metres,
                                          Media& media) {
    glm::vec3 left(1.0f);
    for (int walls = 0; walls < kMostWalls; ++walls) {
        const ClosestRay hit = closest(from, l);
        const bool open = hit.mesh == ClosestRay::kNothing;
        const float distance = open ? kUnbounded : m_scene.metres(hit.ray.maxDistance);
        if (open || distance >= metres)
            return left * media.transmittance(metres);
        const TracePoint wall = m_scene.pointAt(hit);
        if (!wall.material->transmits())
            break;
        left *= leftOnWay(media, wall, distance);
        const TraceSurface surface = m_scene.surfaceIn(wall, -l, media);
        left *= surface.glassShare * straightTransmittance(surface.glass);
        if (left == glm::vec3(0.0f))
            break;
        if (!surface.glass.thinWalled)
            media.cross(wall, surface.ior);
        from = TraceScene::origin(wall, true);
        metres -= distance;
    }
    return glm::vec3(0.0f);
}

glm::vec3 LightPath::direct(const Part& part, const glm::vec3& world, int surface,
                            const PathSequence& sequence) {
    glm::vec3 sum(0.0f);
    if (searchesSky()) {
        const EnvironmentSampler::Sample sky = m_scene.endOf(m_sky);
        if (sky.pdf > 0.0f && part.isOpenTo(sky.direction))
            if (const glm::vec3 value = reflected(part, sky.direction); value != glm::vec3(0.0f))
                if (const glm::vec3 left = arriving(part, sky.direction, kUnbounded);
                    left != glm::vec3(0.0f))
                    sum += m_split.sent(surface,
                                        left * (value * sky.radiance) *
                                            (sent(sky.pdf, part.pdf(sky.direction)) / sky.pdf));
    }
    const bool toGlow = !m_scene.emissive().empty() && m_settings.search != LightSearch::Surfaces;
    const bool toLights = !m_scene.lights().empty() && (m_firstLights || surface > 0);
    if (!toLights && !toGlow)
        return sum;
    const glm::vec2 choice = sequence.at(surface, PathSequence::kChoice);
    if (toLights)
        sum += m_split.sent(
            surface, fromLight(part, world, choice.x, sequence.at(surface, PathSequence::kLight)));
    if (toGlow)
        sum += m_split.sent(surface,
                            fromGlow(part, choice.y, sequence.at(surface, PathSequence::kGlow)));
    return sum;
}

glm::vec3 LightPath::fromLight(const Part& part, const glm::vec3& world, float u,
                               const glm::vec2& u2) {
    float before = 0.0f;
    std::size_t chosen = m_choices.size();
    for (std::size_t i = 0; i < m_choices.size(); ++i) {
        if (!(m_choices[i] > 0.0f))
            continue;
        chosen = i; // rounding: the last one that is likely at all
        before += m_choices[i];
        if (u < before)
            break;
    }
    if (chosen == m_choices.size())
        return glm::vec3(0.0f);
    const LightSample light = m_scene.lights().sample(chosen, world, u2);
    if (!part.isOpenTo(light.direction))
        return glm::vec3(0.0f);
    const glm::vec3 value = reflected(part, light.direction) * light.light;
    if (value == glm::vec3(0.0f))
        return value;
    float weight = 1.0f / m_choices[chosen];
    if (light.pdf > 0.0f)
        weight *= sent(light.pdf * m_choices[chosen], part.pdf(light.direction)) / light.pdf;
    if (weight == 0.0f)
        return glm::vec3(0.0f);
    if (!m_scene.lights().isHidden(chosen))
        return value * weight;
    return arriving(part, light.direction, light.distance) * value * weight;
}

glm::vec3 LightPath::fromGlow(const Part& part, float u, const glm::vec2& u2) {
    const TracePoint source =
        m_scene.pointAt(m_scene.emissive().sample(u), EmissiveTriangles::point(u2));
    const bool through =
        part.isGlass && glm::dot(part.point.face, source.position - part.point.position) < 0.0f;
    const glm::vec3 to = source.position - TraceScene::origin(part.point, through);
    const float distance2 = glm::dot(to, to);
    if (!(distance2 > 0.0f))
        return glm::vec3(0.0f);
    const float distance = std::sqrt(distance2);
    const glm::vec3 l = to / distance;
    float cosine = -glm::dot(source.face, l);
    if (source.material->doubleSided())
        cosine = std::abs(cosine);
    if (cosine <= 0.0f || !part.isOpenTo(l))
        return glm::vec3(0.0f);
    const glm::vec3 value =
        reflected(part, l) * source.material->emissionAt(source.uv) * m_scene.solidShare(source);
    const float pdf = glowPdf(source, m_scene.metres(distance), cosine);
    if (value == glm::vec3(0.0f) || !(pdf > 0.0f))
        return glm::vec3(0.0f);
    // Short of the source itself.
    const glm::vec3 left = arriving(part, l, m_scene.metres(distance - 2.0f * kRayOffset / cosine));
    return left * value * (sent(pdf, part.pdf(l)) / pdf);
}

float LightPath::glowPdf(const TracePoint& place, float metres, float cosine) const {
    const auto luminance = static_cast<double>(shading::luminance(place.material->emissive()));
    return m_scene.emissive().density(luminance) * metres * metres / std::max(cosine, 1e-6f);
}

glm::vec3 LightPath::lightsAlong(const Search& search, const glm::vec3& l, float metres) const {
    glm::vec3 sum(0.0f);
    for (std::size_t i = 0; i < m_scene.lights().size() && !search.fromCamera; ++i) {
        const LightSample light =
            m_scene.lights().along(i, search.world, l, search.travelled + metres);
        if (light.pdf > 0.0f && light.distance >= search.travelled)
            sum += light.light * m_media.transmittance(light.distance - search.travelled) *
                   found(search, search.smooth ? 0.0f : light.pdf * m_choices[i]);
    }
    return sum;
}

} // namespace patina
