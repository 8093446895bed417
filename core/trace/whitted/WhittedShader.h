// Whitted's recursion: what arrives along one ray of the camera. Whitted 1980, "An Improved
// Illumination Model for Shaded Display"; docs/maths/whitted.md.
#pragma once

#include "core/trace/path/Glass.h"
#include "core/trace/path/PathTracer.h"
#include "core/trace/whitted/RayTree.h"
#include "core/trace/whitted/WhittedLights.h"
#include "core/trace/whitted/WhittedSettings.h"

#include <cstdint>

namespace patina {

class TeachingHierarchy;

// What a sample took.
struct RayCounts {
    std::uint32_t rays = 0;                        // that were cast, of all kinds
    std::uint32_t depth = 0;                       // of the deepest one
    std::uint64_t boxTests = 0, triangleTests = 0; // of a hierarchy that counts; else 0

    void add(const RayCounts& other);
};

// One per thread.
class WhittedShader {
  public:
    // All must outlive it. `hierarchy` counts tests; null: nothing counts.
    WhittedShader(const TraceScene& scene, const WhittedLights& lights, const TraceView& view,
                  const WhittedSettings& settings, const TeachingHierarchy* hierarchy = nullptr);

    struct Sample {
        glm::vec3 radiance{0.0f};
        float alpha = 0.0f;
        RayCounts counts;
        bool byChance = false; // blended surfaces let rays through by chance
    };
    // Along a ray in scene units. `index`, `seed`: choose the random numbers of settings that are
    // stochastic. `tree`: gets the sample's nodes; null: none. The sample is the sum of what the
    // nodes add, whether there is a tree or not.
    Sample look(const glm::vec3& origin, const glm::vec3& direction, std::uint32_t index,
                std::uint32_t seed, RayTree* tree);
    [[nodiscard]] std::uint64_t rays() const { return m_rays; } // of all samples so far

  private:
    struct Ray {
        RayKind kind = RayKind::Camera;
        glm::vec3 origin{0.0f}, direction{0.0f};
        glm::vec3 weight{1.0f};
        glm::vec3 factor{1.0f};  // RayTerms::factor
        Media media;             // that it goes through
        bool fromCamera = false; // straight
        int depth = 0, parent = RayNode::kNone;
        std::uint32_t seed = 0;
    };
    struct Place { // that a ray has come to
        TracePoint point;
        shading::SurfaceTerms terms; // of all of it
        TraceSurface surface;        // and as a mixture with glass
    };
    struct Optics;

    void follow(Ray ray);
    void absorb(Ray& ray, int node, const TracePoint& point, float metres);
    void miss(Ray& ray, int node);
    [[nodiscard]] Optics opticsOf(const Place& place, const Ray& ray) const;
    void refract(Optics& optics, const Place& place, const Ray& ray) const;
    void lightFrom(const Ray& ray, int node, const Place& place);
    [[nodiscard]] PointLight lightAt(std::size_t index, const glm::vec3& from,
                                     std::uint32_t seed) const;
    // `told`: gets the terms; null: nobody.
    [[nodiscard]] glm::vec3 local(const shading::SurfaceTerms& terms, const glm::vec3& l,
                                  const glm::vec3& irradiance, RayTerms* told) const;
    glm::vec3 passesTo(const glm::vec3& from, const PointLight& light, int node);
    [[nodiscard]] glm::vec3 passesFace(const TracePoint& point, const glm::vec3& direction,
                                       float metres) const;
    void branch(const Ray& ray, int node, const Place& place, const Optics& optics);
    void branchOff(const Ray& child, bool below);
    [[nodiscard]] glm::vec3 facetNormal(const shading::SurfaceTerms& terms,
                                        std::uint32_t seed) const;
    [[nodiscard]] glm::vec3 glossDirection(const shading::SurfaceTerms& terms, std::uint32_t seed,
                                           glm::vec3& share) const;

    // `goesOn`: the same ray, from a surface that it has passed.
    ClosestRay closest(const glm::vec3& origin, const glm::vec3& direction, float distance,
                       bool goesOn = false);
    int begin(const Ray& ray);
    void met(int node, const TracePoint& point, float distance);
    void end(int node, RayEnd reason);
    void add(int node, const glm::vec3& light);

    const TraceScene& m_scene;
    const WhittedLights& m_lights;
    const TraceView& m_view;
    const WhittedSettings& m_settings;
    const TeachingHierarchy* m_hierarchy;
    RayTree* m_tree = nullptr;
    std::uint32_t m_index = 0; // of the sample
    glm::dvec3 m_sum{0.0};
    float m_alpha = 0.0f;
    RayCounts m_counts;
    std::uint64_t m_rays = 0;
};

} // namespace patina
