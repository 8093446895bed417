// The equation of radiosity of a scene whose surfaces are divided: what its elements reflect, how
// they glow, and the light of lights and sky that falls on them.
#pragma once

#include "core/base/Result.h"
#include "core/job/JobContext.h"
#include "core/radiosity/ElementMesh.h"
#include "core/radiosity/Problem.h"
#include "core/trace/path/TraceScene.h"

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace patina::radiosity {

struct SceneProblemSettings {
    int lightSamples = 64; // rays per element to each light and glowing face, and to the sky
    std::uint32_t seed = 0;
    // Elements that glow shoot or are gathered from like all others, as in the textbooks. Else what
    // they send counts as direct light, which is exact but for shadows: the small bright faces that
    // rays of form factors seldom meet are then no matter of form factors.
    bool glowByFactors = false;
};

// Where light comes straight from. What arrives of several adds up.
struct DirectSources {
    bool glow = false;                      // glowing faces
    bool sky = false;                       // all environments together
    std::vector<std::uint32_t> lights = {}; // of TraceScene::lights()

    [[nodiscard]] std::size_t size() const {
        return (glow ? 1u : 0u) + (sky ? 1u : 0u) + lights.size();
    }
};
// All of a scene.
[[nodiscard]] DirectSources directSources(const TraceScene& scene,
                                          const SceneProblemSettings& settings);

// Mean irradiance of each element, W/m², of each source alone and unreflected: [source][element],
// glow first, then the sky. Errors: Cancelled.
Result<std::vector<std::vector<glm::dvec3>>>
directLight(const TraceScene& scene, const ElementMesh& elements, const DirectSources& sources,
            const SceneProblemSettings& settings, const JobContext& job);

// Means over each element.
struct ElementSurfaces {
    std::vector<glm::dvec3> reflectance; // 0…kMaxReflectance
    std::vector<glm::dvec3> glow;        // radiosity of its own, W/m²
    std::size_t clamped = 0;             // elements whose reflectance was above kMaxReflectance

    static constexpr double kMaxReflectance = 0.995; // so that light dies out
};
// Errors: Cancelled.
Result<ElementSurfaces> elementSurfaces(const TraceScene& scene, const ElementMesh& elements,
                                        const SceneProblemSettings& settings,
                                        const JobContext& job);

// m² of each element as far as it is exposed, and never nothing.
[[nodiscard]] std::vector<double> exposedAreas(const ElementMesh& elements);

// All light is linear sRGB. Reflection is Lambert's, of base colour × (1 - metallic) ×
// (1 - transmission), textures averaged over the element: view.reflectionMix = 0 in every renderer.
struct SceneProblem {
    Problem problem;
    // H of lights, sky and, but for glowByFactors, glowing elements, W/m²; its reflection is a part
    // of problem.emission.
    std::vector<glm::dvec3> direct;
    std::vector<glm::dvec3>
        glow;                // radiosity of its own, W/m²: with glowByFactors a part of it, too
    std::size_t clamped = 0; // ElementSurfaces::clamped

    // All light that an element sends, and that falls on it, of a solution of `problem`.
    [[nodiscard]] glm::dvec3 radiosity(const Solution& solution, std::uint32_t element) const {
        return glow[element] + problem.reflectance[element] * irradiance(solution, element);
    }
    [[nodiscard]] glm::dvec3 irradiance(const Solution& solution, std::uint32_t element) const {
        return direct[element] + solution.irradiance[element];
    }

    // Errors: Cancelled.
    static Result<SceneProblem> make(const TraceScene& scene, const ElementMesh& elements,
                                     const SceneProblemSettings& settings, const JobContext& job);
};

} // namespace patina::radiosity
