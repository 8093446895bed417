// The Cornell box: geometry in millimetres and reflectances as measured (Cornell University
// Program of Computer Graphics, "Cornell Box Data"; spectra reduced to linear sRGB under D65).
#include "core/library/CornellPoints.h"
#include "core/library/Meshes.h"
#include "core/material/Material.h"

#include <array>
#include <utility>

namespace patina::library {

namespace {

using Quad = std::array<glm::dvec3, 4>; // winding of the data sheet: counter-clockwise inside

constexpr Quad kFloor = {{{552.8, 0, 0}, {0, 0, 0}, {0, 0, 559.2}, {549.6, 0, 559.2}}};
constexpr Quad kCeiling = {
    {{556, 548.8, 0}, {556, 548.8, 559.2}, {0, 548.8, 559.2}, {0, 548.8, 0}}};
constexpr Quad kBackWall = {
    {{549.6, 0, 559.2}, {0, 0, 559.2}, {0, 548.8, 559.2}, {556, 548.8, 559.2}}};
constexpr Quad kRightWall = {{{0, 0, 559.2}, {0, 0, 0}, {0, 548.8, 0}, {0, 548.8, 559.2}}};
constexpr Quad kLeftWall = {
    {{552.8, 0, 0}, {549.6, 0, 559.2}, {556, 548.8, 559.2}, {556, 548.8, 0}}};
// The sheet puts the light into the ceiling's plane without cutting a hole: lowered by 0.5 mm.
constexpr Quad kLight = {
    {{343, 548.3, 227}, {343, 548.3, 332}, {213, 548.3, 332}, {213, 548.3, 227}}};
constexpr std::array<Quad, 5> kShortBlock = {{
    {{{130, 165, 65}, {82, 165, 225}, {240, 165, 272}, {290, 165, 114}}},
    {{{290, 0, 114}, {290, 165, 114}, {240, 165, 272}, {240, 0, 272}}},
    {{{130, 0, 65}, {130, 165, 65}, {290, 165, 114}, {290, 0, 114}}},
    {{{82, 0, 225}, {82, 165, 225}, {130, 165, 65}, {130, 0, 65}}},
    {{{240, 0, 272}, {240, 165, 272}, {82, 165, 225}, {82, 0, 225}}},
}};
constexpr std::array<Quad, 5> kTallBlock = {{
    {{{423, 330, 247}, {265, 330, 296}, {314, 330, 456}, {472, 330, 406}}},
    {{{423, 0, 247}, {423, 330, 247}, {472, 330, 406}, {472, 0, 406}}},
    {{{472, 0, 406}, {472, 330, 406}, {314, 330, 456}, {314, 0, 456}}},
    {{{314, 0, 456}, {314, 330, 456}, {265, 330, 296}, {265, 0, 296}}},
    {{{265, 0, 296}, {265, 330, 296}, {423, 330, 247}, {423, 0, 247}}},
}};

void addQuad(Mesh& mesh, const Quad& quad, int steps, int cells, int cell) {
    std::array<glm::dvec3, 4> p;
    for (std::size_t i = 0; i < 4; ++i)
        p[i] = cornellPosition(quad[i]);
    addQuadGrid(mesh, p, steps, cells, cell);
}

struct Box {
    Mesh room, shortBlock, tallBlock, redWall, greenWall, lamp;

    std::vector<ModelPart> parts(const Material& light) {
        const Material white = matteMaterial("White", kCornellWalls[0].white);
        const Material red = matteMaterial("Red", kCornellWalls[0].red);
        const Material green = matteMaterial("Green", kCornellWalls[0].green);
        return {makePart("Room", std::move(room), white),
                makePart("Left Wall", std::move(redWall), red),
                makePart("Right Wall", std::move(greenWall), green),
                makePart("Short Block", std::move(shortBlock), white),
                makePart("Tall Block", std::move(tallBlock), white),
                makePart("Light", std::move(lamp), light)};
    }
};

} // namespace

std::vector<ModelPart> cornellBox() {
    constexpr int kWallSteps = 32, kBlockSteps = 12, kLightSteps = 8;
    // The lamp's spectrum in linear sRGB, relative to its green; 0.78 is its reflectance. The
    // strength is a choice: the data sheet's scale is arbitrary.
    Material light = matteMaterial("Light", glm::vec3(0.78f));
    light.emissive = {1.908584f, 1.0f, 0.255261f};
    light.emissiveStrength = 10.85455f;

    // Parts that share the white material share its unit square: 4 × 4 cells.
    Box box;
    addQuad(box.room, kFloor, kWallSteps, 4, 0);
    addQuad(box.room, kCeiling, kWallSteps, 4, 1);
    addQuad(box.room, kBackWall, kWallSteps, 4, 2);
    for (int i = 0; i < 5; ++i) {
        addQuad(box.shortBlock, kShortBlock[static_cast<std::size_t>(i)], kBlockSteps, 4, 3 + i);
        addQuad(box.tallBlock, kTallBlock[static_cast<std::size_t>(i)], kBlockSteps, 4, 8 + i);
    }
    addQuad(box.redWall, kLeftWall, kWallSteps, 1, 0);
    addQuad(box.greenWall, kRightWall, kWallSteps, 1, 0);
    addQuad(box.lamp, kLight, kLightSteps, 1, 0);
    return box.parts(light);
}

std::vector<ModelPart> cornellReference() {
    Material light = matteMaterial("Light", glm::vec3(0.0f));
    light.emissive = glm::vec3(1.0f);
    // The ceiling has a hole where the lamp is, in its plane.
    const double y = 548.8, z = 559.2;
    const std::array<Quad, 4> ceiling{
        {{{{556, y, 0}, {556, y, 227}, {0, y, 227}, {0, y, 0}}},
         {{{556, y, 332}, {556, y, z}, {0, y, z}, {0, y, 332}}},
         {{{556, y, 227}, {556, y, 332}, {343, y, 332}, {343, y, 227}}},
         {{{213, y, 227}, {213, y, 332}, {0, y, 332}, {0, y, 227}}}}};
    const Quad lampQuad{{{343, y, 227}, {343, y, 332}, {213, y, 332}, {213, y, 227}}};
    Box box;
    addQuad(box.room, kFloor, 1, 4, 0);
    addQuad(box.room, kBackWall, 1, 4, 1);
    for (int i = 0; i < 4; ++i)
        addQuad(box.room, ceiling[static_cast<std::size_t>(i)], 1, 4, 2 + i);
    for (int i = 0; i < 5; ++i) {
        addQuad(box.shortBlock, kShortBlock[static_cast<std::size_t>(i)], 1, 4, 6 + i);
        addQuad(box.tallBlock, kTallBlock[static_cast<std::size_t>(i)], 1, 4, 11 + i);
    }
    addQuad(box.redWall, kLeftWall, 1, 1, 0);
    addQuad(box.greenWall, kRightWall, 1, 1, 0);
    addQuad(box.lamp, lampQuad, 1, 1, 0);
    return box.parts(light);
}

} // namespace patina::library
