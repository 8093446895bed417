// The built-in meshes: shapes in metres that stand on y = 0, each with a UV layout in the unit
// square without overlaps, so that bakes into textures work on all of them.
#pragma once

#include "core/library/Library.h"
#include "core/mesh/Mesh.h"

#include <array>
#include <glm/vec3.hpp>
#include <span>

namespace patina::library {

struct ModelRecipe {
    const char* name;
    const char* title;
    const char* help;
    std::vector<ModelPart> (*make)();
    Room room = Room::None;
};

[[nodiscard]] std::span<const ModelRecipe> modelRecipes();

// A (2, 3) torus knot, 1.4 m high, with 2 * segments * sides triangles; for benchmarks as well.
Mesh makeTorusKnot(int segments, int sides);
Mesh makeSphere(int segments, int rings); // radius 0.5 m
Mesh makeRoundedCube(int edgeSteps);      // 1 m, edges rounded with 0.12 m
Mesh makePlane(int steps);                // 2 m × 2 m, facing up

// Completes the mesh with its name and tangents.
ModelPart makePart(const char* name, Mesh mesh, const Material& material);

// A library material under another name, its maps repeated `repeat` times over the unit square.
Material materialNamed(const char* partName, const char* materialName, glm::vec2 repeat);

std::vector<ModelPart> shaderBall();
// Rough, of the default index.
Material matteMaterial(const char* name, const glm::vec3& color);

// steps × steps quads between four corners, in cell `cell` of a texture of cells × cells squares,
// with a margin.
void addQuadGrid(Mesh& mesh, const std::array<glm::dvec3, 4>& corners, int steps, int cells,
                 int cell);

std::vector<ModelPart> cornellBox();
std::vector<ModelPart> cornellReference();
std::vector<ModelPart> lightAtWall();
std::vector<ModelPart> chessFloor();
std::vector<ModelPart> gallery();
std::vector<ModelPart> sphereGrid();
std::vector<ModelPart> glassSpheres();

} // namespace patina::library
