// Where elements and surfaces do not fit together: leaks, through which light comes to where no
// light may come, and seams, at which light that should run on jumps. docs/maths/radiosity.md
// ("Leaks and seams") defines both.
#pragma once

#include "core/base/Result.h"
#include "core/job/JobContext.h"
#include "core/radiosity/Reconstruction.h"
#include "core/radiosity/SceneProblem.h"
#include "core/radiosity/document/LiveRadiosity.h"

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace patina {

// What both are looked for in; all of one scene.
struct SolvedElements {
    const TraceScene& scene;
    const radiosity::ElementMesh& elements;
    const radiosity::LitMesh& mesh; // litMesh() of them
    const radiosity::SceneProblem& lit;
    const radiosity::Solution& solution;
    int lightSamples = 128; // RadiositySettings::lightSamples
    std::uint32_t seed = 0;
};

struct LightLeak {
    enum class Kind {
        Divided, // another surface stands on the element, whose one radiosity is of both its sides
        Gap, // the element's edge ends short of another surface, nearer than the element is large
    };
    Kind kind = Kind::Gap;
    std::uint32_t element = 0;
    // Divided: area of the smaller side, as a share of the element's exposed area, 0…0.5.
    double share = 0.0;
    double width = 0.0; // Gap: m
    // W, summed over the colours. Divided: what one side shows too much and the other too little.
    // Gap: what passes through it one way more than the other.
    double power = 0.0;
    glm::vec3 place{0.0f}; // metres, world: the middle of the smaller side, or of the gap
};

// Of two elements of the same material and, but for the seam, the same smooth surface.
struct LightSeam {
    std::uint32_t element = 0, other = 0;
    double jump = 0.0;     // of the interpolated radiosity, W/m², summed over the colours …
    double share = 0.0;    // … as a share of the larger of the two, 0…1
    double width = 0.0;    // between the two edges, m; 0: they meet, and are not joined
    double length = 0.0;   // of the element's edge, m
    bool sameMesh = false; // vertices that are not shared, or a T-junction; else two meshes
    glm::vec3 place{0.0f}; // metres, world: the middle of the element's edge
};

// The largest power first; of equals the lowest element. Light of less than a tenth of what is on
// either side is no leak. The same for any number of threads. Errors: Cancelled.
Result<std::vector<LightLeak>> findLeaks(const SolvedElements& solved, const JobContext& job);
// The largest jump first; jumps below kLeastJump of the light are none. Each pair once.
Result<std::vector<LightSeam>> findSeams(const SolvedElements& solved, const JobContext& job);

inline constexpr double kLeastJump = 0.02;

struct LeaksAndSeams {
    std::vector<LightLeak> leaks;
    std::vector<LightSeam> seams;
};
// Both, of a solution that is followed. Errors: Cancelled; those of TraceScene::build().
Result<LeaksAndSeams> findLeaksAndSeams(const LiveRadiosity& live, const JobContext& job);

} // namespace patina
