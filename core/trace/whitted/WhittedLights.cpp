#include "core/trace/whitted/WhittedLights.h"

#include "core/math/Shading.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace patina {

WhittedLights::WhittedLights(const TraceScene& scene)
    : m_scene(scene)
    , m_lights(scene.lights().size())
    , m_ambient(scene.meanEnvironment()) {
    const EmissiveTriangles& emissive = scene.emissive();
    if (emissive.empty())
        return;
    const std::size_t count = std::min(emissive.size(), kMostGlowing);
    const double all = emissive.power();
    for (std::size_t i = 0; i < count; ++i) {
        const bool each = emissive.size() <= kMostGlowing;
        const EmissiveTriangles::Triangle& triangle =
            each ? emissive.triangle(i)
                 : emissive.sample((static_cast<float>(i) + 0.5f) / static_cast<float>(count));
        const double power = each ? emissive.power(i) : all / static_cast<double>(count);
        const TracePoint centre = scene.pointAt(triangle, glm::vec2(1.0f / 3.0f));
        const auto luminance = static_cast<double>(shading::luminance(centre.material->emissive()));
        m_glowing.push_back({triangle, static_cast<float>(power / luminance)});
    }
}

PointLight WhittedLights::centre(std::size_t index, const glm::vec3& from) const {
    if (index >= m_lights)
        return glow(m_glowing[index - m_lights], glm::vec2(1.0f / 3.0f), from);
    const LightSample light = m_scene.lights().centre(index, m_scene.toWorld(from));
    return {light.direction,
            light.light,
            std::isinf(light.distance) ? light.distance : m_scene.sceneUnits(light.distance),
            m_scene.lights().isHidden(index),
            m_scene.lights().id(index),
            0};
}

PointLight WhittedLights::point(std::size_t index, const glm::vec3& from,
                                const glm::vec2& u) const {
    if (index >= m_lights)
        return glow(m_glowing[index - m_lights], EmissiveTriangles::point(u), from);
    const LightSample light = m_scene.lights().sample(index, m_scene.toWorld(from), u);
    if (!(light.pdf > 0.0f)) // without extent
        return centre(index, from);
    PointLight result = centre(index, from);
    result.direction = light.direction;
    result.irradiance = light.light / light.pdf;
    result.distance =
        std::isinf(light.distance) ? light.distance : m_scene.sceneUnits(light.distance);
    return result;
}

PointLight WhittedLights::glow(const Glowing& glowing, const glm::vec2& weights,
                               const glm::vec3& from) const {
    PointLight result;
    const TracePoint source = m_scene.pointAt(glowing.triangle, weights);
    result.glowing = m_scene.meshId(source.mesh);
    const glm::vec3 to = source.position - from;
    const float distance2 = glm::dot(to, to);
    if (!(distance2 > 0.0f))
        return result;
    const float distance = std::sqrt(distance2);
    result.direction = to / distance;
    float cosine = -glm::dot(source.face, result.direction);
    if (source.material->doubleSided())
        cosine = std::abs(cosine);
    if (cosine <= 0.0f)
        return result;
    const float metres = m_scene.metres(distance);
    result.irradiance =
        source.material->emissionAt(source.uv) *
        (glowing.area * cosine / (metres * metres + glowing.area * shading::kInvPi));
    // Short of the source itself.
    result.distance = std::max(distance - 2.0f * kRayOffset / cosine, 0.0f);
    return result;
}

} // namespace patina
