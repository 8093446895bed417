// Scenes whose radiosity is known, divided into elements.
#pragma once

#include "core/radiosity/FormFactors.h"
#include "core/radiosity/SceneProblem.h"

#include <array>
#include <glm/vec3.hpp>
#include <memory>
#include <vector>

namespace patina::test {

// Form factors of a unit square to one opposite of it and one beside it: Howell C-11, C-14.
inline constexpr double kOpposite = 0.199824895698, kAdjacent = 0.200043776075;

struct Wall {
    std::array<glm::vec3, 4> corners; // metres, counter-clockwise about the side that reflects
    glm::vec3 reflectance{0.5f};
    float emission = 0.0f; // radiosity, W/m²
    bool twoSided = false;
};

// A quad's two triangles, then the next one's; one mesh each.
[[nodiscard]] TraceInputs sceneOf(const std::vector<Wall>& walls);
// Inside of the unit cube: ceiling, floor, x-, x+, z-, z+; the ceiling sends 1 W/m² out.
[[nodiscard]] std::vector<Wall> unitCube(float reflectance);
// A ball of radius 1 out of flat triangles, seen from inside or outside.
[[nodiscard]] TraceMesh facetedBall(int rings, float radius, bool inside, std::size_t material);

// What the solvers need of a scene; stays where it is, because elements refer to the rest.
struct DividedScene {
    TraceScene scene;
    radiosity::ElementMesh elements;
    radiosity::SceneProblem lit;
    [[nodiscard]] const radiosity::Problem& problem() const { return lit.problem; }
    [[nodiscard]] std::unique_ptr<radiosity::FormFactors>
    factors(const radiosity::FactorSettings& settings) const;
};
[[nodiscard]] std::unique_ptr<DividedScene>
divided(const TraceInputs& inputs, const radiosity::ElementLimits& limits,
        const radiosity::SceneProblemSettings& light = {.glowByFactors = true});

} // namespace patina::test
