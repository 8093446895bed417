// The equation of radiosity of a scene whose surfaces are divided: what its elements reflect, how
// they glow, and the light of lights and sky that falls on them.
#pragma once

#include "core/base/Result.h"
#include "core/job/JobContext.h"
#include "core/radiosity/ElementMesh.h"
#include "core/radiosity/ElementShard.h"
#include "core/radiosity/FoundFlags.h"
#include "core/radiosity/Problem.h"
#include "core/trace/path/TraceScene.h"

#include <cstddef>
#include <cstdint>
#include <functional>
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

// Of each element what of the direct light of lights and glowing faces arrives, or what is hidden,
// whichever is less; W/m², source by source, summed over the colours. Much of it is a penumbra.
// Errors: Cancelled.
Result<std::vector<double>> partlyHidden(const TraceScene& scene, const ElementMesh& elements,
                                         const SceneProblemSettings& settings,
                                         const JobContext& job);

// What directLight() finds of all sources together, as far as it has been found.
class DirectLight {
  public:
    DirectLight() = default;
    explicit DirectLight(std::size_t elements)
        : m_irradiance(elements, glm::dvec3(0.0))
        , m_found(elements) {}

    // Finds that of the elements of a shard where it is not there. `between`: called after each,
    // from any thread. Errors: Cancelled; what was found by then is there.
    Result<void> complete(const TraceScene& scene, const ElementMesh& elements,
                          const SceneProblemSettings& settings, const ElementShard& shard,
                          const JobContext& job, const std::function<void()>& between = {});
    // Of an element whose is not there. From any thread.
    void set(std::uint32_t element, const glm::dvec3& irradiance) {
        m_irradiance[element] = irradiance;
        m_found.set(element);
    }

    [[nodiscard]] std::size_t size() const { return m_irradiance.size(); }
    // May be asked while other threads find some.
    [[nodiscard]] bool has(std::uint32_t element) const { return m_found.has(element); }
    [[nodiscard]] const glm::dvec3& irradiance(std::uint32_t element) const { // W/m²
        return m_irradiance[element];
    }

  private:
    std::vector<glm::dvec3> m_irradiance;
    FoundFlags m_found;
};

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

    // Whether any light falls on an element or leaves one, be it black.
    [[nodiscard]] bool hasLight() const;

    // Errors: Cancelled.
    static Result<SceneProblem> make(const TraceScene& scene, const ElementMesh& elements,
                                     const SceneProblemSettings& settings, const JobContext& job);
    // The same; what of the direct light is not there is found. `between`: as DirectLight has it.
    static Result<SceneProblem> make(const TraceScene& scene, const ElementMesh& elements,
                                     const SceneProblemSettings& settings, DirectLight& light,
                                     const JobContext& job,
                                     const std::function<void()>& between = {});
};

} // namespace patina::radiosity
