// The equation of radiosity of a scene whose surfaces are divided: what its elements reflect, how
// they glow, and the light of lamps and sky that falls on them.
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
    int lightSamples = 64; // rays per element to each lamp, and to the sky
    std::uint32_t seed = 0;
};

// All light is linear sRGB. Reflection is Lambert's, of base colour × (1 - metallic) ×
// (1 - transmission), textures averaged over the element: view.reflectionMix = 0 in every renderer.
struct SceneProblem {
    Problem problem;
    // H of lamps and sky, W/m²; its reflection is a part of problem.emission. Elements that glow
    // are no lamps here.
    std::vector<glm::dvec3> direct;
    std::size_t clamped = 0; // elements whose reflectance was above kMaxReflectance

    static constexpr double kMaxReflectance = 0.995; // so that light dies out

    // Errors: Cancelled.
    static Result<SceneProblem> make(const TraceScene& scene, const ElementMesh& elements,
                                     const SceneProblemSettings& settings, const JobContext& job);
};

} // namespace patina::radiosity
