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
    Id light = 0, glowing = 0; // Light::id, or the mesh that gives off light
    bool meetsItself = false;  // who meets that mesh on the way has reached the light
};

class WhittedLights {
  public:
    // `scene` must outlive it.
    explicit WhittedLights(const TraceScene& scene);

    [[nodiscard]] std::size_t size() const { return m_lights + m_glowing.size(); }
    // At a place in scene units. Spheres and rectangles count by their centre, with the illuminance
    // of all of their surface (illuminanceAt()). A mesh that gives off light counts by the centroid
    // of what it gives off: a flat one as a disc of its area on the disc's axis, which stays
    // finite, E = L A cos / (d² + A/π); one that closes as what a convex body of its area shows on
    // average, a quarter of it (Cauchy 1841), E = L A / 4d².
    [[nodiscard]] PointLight centre(std::size_t index, const glm::vec3& from) const;
    // The same by a point of the light that `u` chooses, so that the mean over many is a soft
    // shadow.
    [[nodiscard]] PointLight point(std::size_t index, const glm::vec3& from,
                                   const glm::vec3& u) const;

    // Of the environment, over all directions.
    [[nodiscard]] const glm::vec3& ambient() const { return m_ambient; }

  private:
    struct Glowing {
        EmissiveTriangles triangles; // of one mesh
        Id mesh = 0;
        glm::vec3 centroid{0.0f}; // scene units
        glm::vec3 radiance{0.0f}; // mean
        glm::vec3 facing{0.0f};   // m²: the sum of its triangles' areas as vectors
        float area = 0.0f;        // m²
        bool isFlat = false, doubleSided = false;
    };
    void collectGlowing();
    [[nodiscard]] PointLight glow(const Glowing& glowing, const glm::vec3& from) const;
    [[nodiscard]] PointLight glow(const Glowing& glowing, const glm::vec3& from,
                                  const glm::vec3& u) const;

    const TraceScene& m_scene;
    std::size_t m_lights;
    std::vector<Glowing> m_glowing;
    glm::vec3 m_ambient;
};

} // namespace patina
