// Which elements are too coarse for the light on them: where a division goes on.
#pragma once

#include "core/base/Result.h"
#include "core/job/JobContext.h"
#include "core/radiosity/ElementMesh.h"
#include "core/radiosity/SceneProblem.h"

#include <cstdint>
#include <glm/vec3.hpp>
#include <string_view>
#include <vector>

namespace patina::radiosity {

// What tells. All of it is irradiance, its size summed over the colours, in shares of what the
// element has, or of what all have in the mean where that is more.
enum class DivisionRule {
    // By how much the light differs from vertex to vertex of an element. Cohen, Greenberg, Immel &
    // Brock 1986, "An Efficient Radiosity Approach for Realistic Image Synthesis".
    Gradient,
    // Light that is hidden in part: penumbras. Of each source and of the faces that send most light
    // what
    // of theirs arrives, or what does not, whichever is less. The sky, of which everything hides a
    // part, does not count.
    Visibility,
    // By how much the next order of interpolation, quadratic, differs from the linear one that is
    // shown: a slope that is even divides nothing. As a norm over the element: integrals, L1 and
    // L2, let small elements differ by more, in shares of the same over one of the first ones; L∞
    // is the largest difference. For the norms: Cohen & Wallace 1993, "Radiosity and Realistic
    // Image Synthesis", section 6.3.
    L1,
    L2,
    Linf,
};

[[nodiscard]] std::string_view name(DivisionRule rule); // as the command line has it

struct DivisionSettings {
    DivisionRule rule = DivisionRule::Gradient;
    double share = 0.1;     // that is allowed
    double firstArea = 1.0; // m²: of the largest elements before any division
    // W/m² that are expected to arrive everywhere yet (Shooting::ambient()): what elements have, in
    // whose shares differences count, is that much more.
    glm::dvec3 ambient{0.0};
    // Standard error of each element's irradiance, W/m², summed over the colours: differences that
    // it may make alone divide nothing. Empty: not known.
    std::vector<double> noise = {};
    // No element is divided yet: then those that reach from border to border of what is smooth, so
    // that no vertex tells how light differs on them, are too coarse as well.
    bool first = false;
};

// The elements to divide, ascending. `solution` is one of lit.problem, or on the way to it. Errors:
// Cancelled.
[[nodiscard]] Result<std::vector<std::uint32_t>>
tooCoarse(const TraceScene& scene, const ElementMesh& elements, const SceneProblem& lit,
          const Solution& solution, const SceneProblemSettings& light,
          const DivisionSettings& settings, const JobContext& job);

} // namespace patina::radiosity
