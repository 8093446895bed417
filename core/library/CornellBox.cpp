// The Cornell box: geometry in millimetres and reflectances as measured (Cornell University
// Program of Computer Graphics, "Cornell Box Data"; spectra reduced to linear sRGB under D65).
#include "core/library/Meshes.h"
#include "core/material/Material.h"

#include <array>
#include <cmath>
#include <glm/geometric.hpp>

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

// The sheet looks along +Z into the opening at z = 0; here the opening faces +Z.
glm::dvec3 toWorld(const glm::dvec3& mm) {
    return {(278.0 - mm.x) / 1000.0, mm.y / 1000.0, (279.6 - mm.z) / 1000.0};
}

// Cell `cell` of a layout of cells × cells squares, with a margin.
void addQuad(Mesh& mesh, const Quad& quad, int steps, int cells, int cell) {
    const double size = 1.0 / cells, margin = cells == 1 ? 0.0 : 0.006;
    const glm::dvec2 corner((cell % cells) * size + margin,
                            static_cast<double>(cell / cells) * size + margin);
    const double scale = size - 2.0 * margin;
    std::array<glm::dvec3, 4> p;
    for (std::size_t i = 0; i < 4; ++i)
        p[i] = toWorld(quad[i]);
    // The left wall's corners are not in one plane: the wall is the two triangles (0, 1, 2) and
    // (0, 2, 3), whose diagonal the grid follows; they share the mean normal (0.3° off each).
    const glm::dvec3 normal = glm::normalize(glm::normalize(glm::cross(p[1] - p[0], p[2] - p[0])) +
                                             glm::normalize(glm::cross(p[2] - p[0], p[3] - p[0])));
    const auto start = static_cast<std::uint32_t>(mesh.positions.size());
    for (int j = 0; j <= steps; ++j)
        for (int i = 0; i <= steps; ++i) {
            const double s = static_cast<double>(i) / steps, t = static_cast<double>(j) / steps;
            const glm::dvec3 position = s >= t ? p[0] + (p[1] - p[0]) * s + (p[2] - p[1]) * t
                                               : p[0] + (p[3] - p[0]) * t + (p[2] - p[3]) * s;
            mesh.positions.push_back(glm::vec3(position));
            mesh.normals.push_back(glm::vec3(normal));
            mesh.uvs.push_back(glm::vec2(corner + glm::dvec2(s, 1.0 - t) * scale));
        }
    const auto stride = static_cast<std::uint32_t>(steps) + 1u;
    for (int j = 0; j < steps; ++j)
        for (int i = 0; i < steps; ++i) {
            const std::uint32_t a =
                start + static_cast<std::uint32_t>(j) * stride + static_cast<std::uint32_t>(i);
            const std::uint32_t b = a + 1, c = a + stride + 1, d = a + stride;
            mesh.indices.insert(mesh.indices.end(), {a, b, c, a, c, d});
        }
}

Material plainMaterial(const char* name, const glm::vec3& color) {
    Material m;
    m.name = name;
    m.baseColor = color;
    m.perceptualRoughness = 1.0f;
    return m;
}

} // namespace

std::vector<ModelPart> cornellBox() {
    constexpr int kWallSteps = 32, kBlockSteps = 12, kLightSteps = 8;
    const Material white = plainMaterial("White", {0.738239f, 0.735992f, 0.738601f});
    const Material red = plainMaterial("Red", {0.493880f, 0.048870f, 0.051155f});
    const Material green = plainMaterial("Green", {0.068413f, 0.398461f, 0.086545f});
    // The lamp's spectrum in linear sRGB, relative to its green; 0.78 is its reflectance. The
    // strength is a choice: the data sheet's scale is arbitrary.
    Material light = plainMaterial("Light", glm::vec3(0.78f));
    light.emissive = {1.908584f, 1.0f, 0.255261f};
    light.emissiveStrength = 10.85455f;

    // Parts that share the white material share its unit square: 4 × 4 cells.
    Mesh room, shortBlock, tallBlock, redWall, greenWall, lamp;
    addQuad(room, kFloor, kWallSteps, 4, 0);
    addQuad(room, kCeiling, kWallSteps, 4, 1);
    addQuad(room, kBackWall, kWallSteps, 4, 2);
    for (int i = 0; i < 5; ++i) {
        addQuad(shortBlock, kShortBlock[static_cast<std::size_t>(i)], kBlockSteps, 4, 3 + i);
        addQuad(tallBlock, kTallBlock[static_cast<std::size_t>(i)], kBlockSteps, 4, 8 + i);
    }
    addQuad(redWall, kLeftWall, kWallSteps, 1, 0);
    addQuad(greenWall, kRightWall, kWallSteps, 1, 0);
    addQuad(lamp, kLight, kLightSteps, 1, 0);
    return {makePart("Room", std::move(room), white),
            makePart("Left Wall", std::move(redWall), red),
            makePart("Right Wall", std::move(greenWall), green),
            makePart("Short Block", std::move(shortBlock), white),
            makePart("Tall Block", std::move(tallBlock), white),
            makePart("Light", std::move(lamp), light)};
}

} // namespace patina::library
