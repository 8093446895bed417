// The lights of a scene as the classical ray tracer counts them: each by one point.
#pragma once

#include "core/base/Id.h"
#include "core/trace/path/TraceScene.h"

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace patina {

// What arrives of one light at a place where nothing is in the way.
struct PointLight {
    glm::vec3 direction{0.0f, 1.0f, 0.0f}; // to the light, unit
    glm::vec3 irradiance{0.0f};            // of a surface that faces it
    float distance = 0.0f;                 // scene units, may be infinite: as far as shadows count
    bool castsShadow = true;
    Id light = 0, glowing = 0; // Light::id, or the mesh that glows
};

class WhittedLights {
  public:
    // `scene` must outlive it.
    explicit WhittedLights(const TraceScene& scene);

    [[nodiscard]] std::size_t size() const { return m_lights + m_glowing.size(); }
    // At a place in scene units. Spheres and rectangles count by their centre, with the illuminance
    // of all of their surface (illuminanceAt()); each triangle that gives off light by its centroid
    // as a disc of the same area, E = L A cos / (d² + A/π), the closed form on a disc's axis, which
    // stays finite. Of more than kMostGlowing triangles as many are chosen, each for an equal share
    // of the power.
    [[nodiscard]] PointLight centre(std::size_t index, const glm::vec3& from) const;
    // The same by a point of the light that `u` chooses, so that the mean over many is a soft
    // shadow.
    [[nodiscard]] PointLight point(std::size_t index, const glm::vec3& from,
                                   const glm::vec2& u) const;

    // Of the environment, over all directions.
    [[nodiscard]] const glm::vec3& ambient() const { return m_ambient; }

    static constexpr std::size_t kMostGlowing = 32;

  private:
    struct Glowing {
        EmissiveTriangles::Triangle triangle;
        float area = 0.0f; // m², that it stands for
    };
    [[nodiscard]] PointLight glow(const Glowing& glowing, const glm::vec2& weights,
                                  const glm::vec3& from) const;

    const TraceScene& m_scene;
    std::size_t m_lights;
    std::vector<Glowing> m_glowing;
    glm::vec3 m_ambient;
};

} // namespace patina
