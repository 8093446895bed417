// Simple rooms of undivided faces, whose light is for radiosity to find.
#include "core/library/Meshes.h"
#include "core/material/Material.h"

#include <utility>

namespace patina::library {
namespace {

using Corners = std::array<glm::dvec3, 4>; // metres, counter-clockwise from where it is seen

Material lightMaterial(float radiance) {
    Material m = matteMaterial("Light", glm::vec3(0.78f));
    m.emissive = glm::vec3(1.0f);
    m.emissiveStrength = radiance;
    return m;
}

} // namespace

std::vector<ModelPart> lightAtWall() {
    Mesh wall, floor, light;
    addQuadGrid(wall, Corners{{{-1, 0, -0.75}, {1, 0, -0.75}, {1, 1.25, -0.75}, {-1, 1.25, -0.75}}},
                1, 1, 0);
    addQuadGrid(floor, Corners{{{-1, 0, 0.75}, {1, 0, 0.75}, {1, 0, -0.75}, {-1, 0, -0.75}}}, 1, 1,
                0);
    // A quarter of a metre wide, three quarters from the wall, with its back to the room.
    addQuadGrid(
        light,
        Corners{{{0.125, 0.625, 0}, {-0.125, 0.625, 0}, {-0.125, 0.875, 0}, {0.125, 0.875, 0}}}, 1,
        1, 0);
    const Material white = matteMaterial("White", glm::vec3(0.75f));
    return {makePart("Wall", std::move(wall), white),
            makePart("Floor", std::move(floor), matteMaterial("Floor", glm::vec3(0.75f))),
            makePart("Light", std::move(light), lightMaterial(20.0f))};
}

std::vector<ModelPart> chessFloor() {
    constexpr int kFields = 8;
    Mesh fields[2], wall, light;
    for (int row = 0; row < kFields; ++row)
        for (int column = 0; column < kFields; ++column) {
            const double x = column * 0.25 - 1.0, z = row * 0.25 - 1.0;
            // Every other field: the cells of their textures are not used twice.
            addQuadGrid(
                fields[(row + column) % 2],
                Corners{{{x, 0, z + 0.25}, {x + 0.25, 0, z + 0.25}, {x + 0.25, 0, z}, {x, 0, z}}},
                1, kFields, row * kFields + column);
        }
    addQuadGrid(
        wall,
        Corners{{{-0.75, 0, -0.25}, {0.75, 0, -0.25}, {0.75, 0.75, -0.25}, {-0.75, 0.75, -0.25}}},
        1, 1, 0);
    addQuadGrid(light,
                Corners{{{-0.2, 1.2, 0.2}, {0.2, 1.2, 0.2}, {0.2, 1.2, 0.6}, {-0.2, 1.2, 0.6}}}, 1,
                1, 0);
    Material green = matteMaterial("Green Wall", {0.1f, 0.6f, 0.15f});
    green.doubleSided = true;
    return {makePart("Light Fields", std::move(fields[0]),
                     matteMaterial("Light Fields", glm::vec3(0.8f))),
            makePart("Dark Fields", std::move(fields[1]),
                     matteMaterial("Dark Fields", glm::vec3(0.08f))),
            makePart("Green Wall", std::move(wall), green),
            makePart("Light", std::move(light), lightMaterial(20.0f))};
}

} // namespace patina::library
