#include "core/trace/whitted/WhittedLights.h"

#include "core/math/Shading.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace patina {
namespace {

// A mesh whose triangles' areas, as vectors, add up to more than this share of their area.
constexpr double kFlat = 0.5;

} // namespace

WhittedLights::WhittedLights(const TraceScene& scene)
    : m_scene(scene)
    , m_lights(scene.lights().size())
    , m_ambient(scene.meanEnvironment()) {
    collectGlowing();
}

void WhittedLights::collectGlowing() {
    const EmissiveTriangles& emissive = m_scene.emissive();
    std::uint32_t mesh = 0;
    glm::dvec3 centroid(0.0), radiance(0.0), facing(0.0);
    double area = 0.0;
    const auto finish = [&] {
        Glowing& last = m_glowing.back();
        last.triangles.finish();
        last.centroid = glm::vec3(centroid / area);
        last.radiance = glm::vec3(radiance / area);
        last.facing = glm::vec3(facing);
        last.area = static_cast<float>(area);
        last.isFlat = glm::length(facing) > kFlat * area;
        centroid = radiance = facing = glm::dvec3(0.0);
        area = 0.0;
    };
    for (std::size_t i = 0; i < emissive.size(); ++i) {
        const EmissiveTriangles::Triangle& triangle = emissive.triangle(i);
        const TracePoint centre = m_scene.pointAt(triangle, glm::vec2(1.0f / 3.0f));
        if (m_glowing.empty() || triangle.mesh != mesh) {
            if (!m_glowing.empty())
                finish();
            mesh = triangle.mesh;
            Glowing& next = m_glowing.emplace_back();
            next.mesh = m_scene.meshId(mesh);
            next.doubleSided = centre.material->doubleSided();
        }
        const auto luminance = static_cast<double>(shading::luminance(centre.material->emissive()));
        const double squareMetres = emissive.power(i) / luminance;
        m_glowing.back().triangles.add(triangle, squareMetres, luminance);
        centroid += squareMetres * glm::dvec3(centre.position);
        radiance += squareMetres * glm::dvec3(centre.material->emissionAt(centre.uv));
        facing += squareMetres * glm::dvec3(centre.face);
        area += squareMetres;
    }
    if (!m_glowing.empty())
        finish();
}

PointLight WhittedLights::centre(std::size_t index, const glm::vec3& from) const {
    if (index >= m_lights)
        return glow(m_glowing[index - m_lights], from);
    const LightSample light = m_scene.lights().centre(index, m_scene.toWorld(from));
    return {light.direction,
            light.light,
            std::isinf(light.distance) ? light.distance : m_scene.sceneUnits(light.distance),
            m_scene.lights().isHidden(index),
            m_scene.lights().id(index),
            0,
            false};
}

PointLight WhittedLights::point(std::size_t index, const glm::vec3& from,
                                const glm::vec3& u) const {
    if (index >= m_lights)
        return glow(m_glowing[index - m_lights], from, u);
    const LightSample light = m_scene.lights().sample(index, m_scene.toWorld(from), glm::vec2(u));
    if (!(light.pdf > 0.0f)) // without extent
        return centre(index, from);
    PointLight result = centre(index, from);
    result.direction = light.direction;
    result.irradiance = light.light / light.pdf;
    result.distance =
        std::isinf(light.distance) ? light.distance : m_scene.sceneUnits(light.distance);
    return result;
}

PointLight WhittedLights::glow(const Glowing& glowing, const glm::vec3& from) const {
    PointLight result;
    result.glowing = glowing.mesh;
    result.meetsItself = true;
    const glm::vec3 to = glowing.centroid - from;
    result.distance = glm::length(to);
    if (!(result.distance > 0.0f))
        return result;
    result.direction = to / result.distance;
    const float metres = m_scene.metres(result.distance), metres2 = metres * metres;
    if (!glowing.isFlat) {
        result.irradiance = glowing.radiance * (0.25f * glowing.area / metres2);
        return result;
    }
    float shown = -glm::dot(glowing.facing, result.direction);
    if (glowing.doubleSided)
        shown = std::abs(shown);
    result.irradiance =
        glowing.radiance * (std::max(shown, 0.0f) / (metres2 + glowing.area * shading::kInvPi));
    return result;
}

PointLight WhittedLights::glow(const Glowing& glowing, const glm::vec3& from,
                               const glm::vec3& u) const {
    PointLight result;
    result.glowing = glowing.mesh;
    const TracePoint source =
        m_scene.pointAt(glowing.triangles.sample(u.z), EmissiveTriangles::point(glm::vec2(u)));
    const glm::vec3 to = source.position - from;
    result.distance = glm::length(to);
    if (!(result.distance > 0.0f))
        return result;
    result.direction = to / result.distance;
    float cosine = -glm::dot(source.face, result.direction);
    if (source.material->doubleSided())
        cosine = std::abs(cosine);
    const float metres = m_scene.metres(result.distance);
    const float density =
        glowing.triangles.density(shading::luminance(source.material->emissive()));
    if (cosine > 0.0f && density > 0.0f)
        result.irradiance =
            source.material->emissionAt(source.uv) * (cosine / (density * metres * metres));
    // Short of the source itself, which hides what of it is behind.
    result.distance = std::max(result.distance - 2.0f * kRayOffset / std::max(cosine, 1e-3f), 0.0f);
    return result;
}

} // namespace patina
