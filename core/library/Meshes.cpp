#include "core/library/Meshes.h"

#include "core/base/Check.h"
#include "core/library/Lathe.h"
#include "core/material/MaterialInputs.h"
#include "core/math/PortableMath.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

namespace patina::library {

namespace {

// Triangles of a grid of (columns + 1) × (rows + 1) vertices that starts at `start`; columns and
// rows run so that their cross product faces the viewer.
void addGridIndices(Mesh& mesh, std::uint32_t start, int columns, int rows) {
    const auto stride = static_cast<std::uint32_t>(columns) + 1u;
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < columns; ++x) {
            const std::uint32_t a =
                start + static_cast<std::uint32_t>(y) * stride + static_cast<std::uint32_t>(x);
            const std::uint32_t b = a + 1, c = a + stride, d = c + 1;
            mesh.indices.insert(mesh.indices.end(), {a, b, d, a, d, c});
        }
}

} // namespace

ModelPart makePart(const char* name, Mesh mesh, const Material& material) {
    mesh.name = name;
    computeTangents(mesh);
    return {name, std::make_shared<const Mesh>(std::move(mesh)), material.name, material};
}

void addQuadGrid(Mesh& mesh, const std::array<glm::dvec3, 4>& p, int steps, int cells, int cell) {
    const double size = 1.0 / cells, margin = cells == 1 ? 0.0 : 0.006;
    const glm::dvec2 corner((cell % cells) * size + margin,
                            static_cast<double>(cell / cells) * size + margin);
    const double scale = size - 2.0 * margin;
    // Corners that are not in one plane: the quad is the two triangles (0, 1, 2) and (0, 2, 3),
    // whose diagonal the grid follows; they share the mean normal.
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

Material matteMaterial(const char* name, const glm::vec3& color) {
    Material m;
    m.name = name;
    m.baseColor = color;
    m.perceptualRoughness = 1.0f;
    return m;
}

Material materialNamed(const char* partName, const char* materialName, glm::vec2 repeat) {
    Result<Material> result = material(materialName);
    CHECK(result.ok());
    Material m = std::move(result).value();
    m.name = partName;
    for (const MaterialInputInfo& info : kMaterialInputs)
        if (info.input != MaterialInput::Emissive) // none of them glows
            (m.*info.map).uvScale = repeat;
    return m;
}

Mesh makeSphere(int segments, int rings) {
    constexpr double kRadius = 0.5;
    const Profile profile = sphereProfile(kRadius, rings);
    Mesh mesh;
    addLathe(mesh, profile, 0, profile.size() - 1, segments, {},
             {glm::dmat3(1.0), {0, kRadius, 0}});
    return mesh;
}

Mesh makePlane(int steps) {
    Mesh mesh;
    for (int j = 0; j <= steps; ++j)
        for (int i = 0; i <= steps; ++i) {
            const float u = static_cast<float>(i) / static_cast<float>(steps);
            const float w = static_cast<float>(j) / static_cast<float>(steps); // to the back
            mesh.positions.push_back({2.0f * u - 1.0f, 0.0f, 1.0f - 2.0f * w});
            mesh.normals.push_back({0.0f, 1.0f, 0.0f});
            mesh.uvs.push_back({u, 1.0f - w});
        }
    addGridIndices(mesh, 0, steps, steps);
    return mesh;
}

// Each face is a grid on the cube's surface; what lies beyond the flat part is pulled onto the
// rounded edge, in steps of equal angle.
Mesh makeRoundedCube(int edgeSteps) {
    constexpr double kHalf = 0.5, kRound = 0.12, kFlat = kHalf - kRound;
    constexpr int kFlatSteps = 24;
    // Per axis: offset within the flat part, angle beyond it (-45°…45°), arc length for the UVs.
    struct Step {
        double flat, tangent, arc;
    };
    std::vector<Step> steps;
    for (int i = -edgeSteps; i <= -1; ++i) {
        const double turns = 0.125 * i / edgeSteps;
        steps.push_back(
            {-kFlat, sinTurns(turns) / cosTurns(turns), -kFlat + kRound * 2 * kPi * turns});
    }
    for (int i = 0; i <= kFlatSteps; ++i) {
        const double x = kFlat * (2.0 * i / kFlatSteps - 1.0);
        steps.push_back({x, 0.0, x});
    }
    for (int i = 1; i <= edgeSteps; ++i) {
        const double turns = 0.125 * i / edgeSteps;
        steps.push_back(
            {kFlat, sinTurns(turns) / cosTurns(turns), kFlat + kRound * 2 * kPi * turns});
    }
    const double arcEnd = steps.back().arc;

    struct Face {
        glm::dvec3 normal, right, up;
    };
    const std::array<Face, 6> faces = {{{{0, 0, 1}, {1, 0, 0}, {0, 1, 0}},
                                        {{1, 0, 0}, {0, 0, -1}, {0, 1, 0}},
                                        {{0, 0, -1}, {-1, 0, 0}, {0, 1, 0}},
                                        {{-1, 0, 0}, {0, 0, 1}, {0, 1, 0}},
                                        {{0, 1, 0}, {1, 0, 0}, {0, 0, -1}},
                                        {{0, -1, 0}, {1, 0, 0}, {0, 0, 1}}}};
    Mesh mesh;
    for (std::size_t f = 0; f < faces.size(); ++f) {
        const Face& face = faces[f];
        // 3 × 2 cells; each chart is a square with a margin around it.
        constexpr double kCell = 1.0 / 3.0, kMargin = 0.008;
        const glm::dvec2 center((static_cast<double>(f % 3) + 0.5) * kCell,
                                (static_cast<double>(f / 3) + 0.5) * kCell);
        const double scale = (0.5 * kCell - kMargin) / arcEnd;
        const auto start = static_cast<std::uint32_t>(mesh.positions.size());
        for (const Step& b : steps)
            for (const Step& a : steps) {
                const glm::dvec3 direction =
                    glm::normalize(face.normal + face.right * a.tangent + face.up * b.tangent);
                const glm::dvec3 p = face.normal * kFlat + face.right * a.flat + face.up * b.flat +
                                     direction * kRound;
                mesh.positions.push_back(glm::vec3(p + glm::dvec3(0.0, kHalf, 0.0)));
                mesh.normals.push_back(glm::vec3(direction));
                mesh.uvs.push_back(glm::vec2(center + glm::dvec2(a.arc, -b.arc) * scale));
            }
        const int n = static_cast<int>(steps.size()) - 1;
        addGridIndices(mesh, start, n, n);
    }
    return mesh;
}

// Centre line ((R + r cos 3t) cos 2t, (R + r cos 3t) sin 2t, r sin 3t); the tube's frame follows
// the direction away from the centre line's axis, which closes without a twist.
Mesh makeTorusKnot(int segments, int sides) {
    CHECK_LE(3, segments);
    CHECK_LE(3, sides);
    constexpr double kMajor = 0.42, kMinor = 0.19, kTube = 0.088;
    const auto center = [&](double t) {
        const double r = kMajor + kMinor * cosTurns(3.0 * t);
        return glm::dvec3(r * cosTurns(2.0 * t), r * sinTurns(2.0 * t), kMinor * sinTurns(3.0 * t));
    };
    Mesh mesh;
    double lowest = 1e9;
    for (int i = 0; i <= segments; ++i) {
        const double t = static_cast<double>(i % segments) / segments;
        const double r = kMajor + kMinor * cosTurns(3.0 * t),
                     dr = -3.0 * kMinor * sinTurns(3.0 * t);
        const double c = cosTurns(2.0 * t), s = sinTurns(2.0 * t);
        const glm::dvec3 tangent = glm::normalize(glm::dvec3(
            dr * c - 2.0 * r * s, dr * s + 2.0 * r * c, 3.0 * kMinor * cosTurns(3.0 * t)));
        const glm::dvec3 outward(c * cosTurns(3.0 * t), s * cosTurns(3.0 * t), sinTurns(3.0 * t));
        const glm::dvec3 binormal = glm::normalize(glm::cross(tangent, outward));
        const glm::dvec3 normal = glm::cross(binormal, tangent);
        for (int k = 0; k <= sides; ++k) {
            const double a = static_cast<double>(k % sides) / sides;
            const glm::dvec3 d = normal * cosTurns(a) + binormal * sinTurns(a);
            const glm::dvec3 p = center(t) + d * kTube;
            lowest = std::min(lowest, p.y);
            mesh.positions.push_back(glm::vec3(p));
            mesh.normals.push_back(glm::vec3(d));
            mesh.uvs.push_back({static_cast<float>(k) / static_cast<float>(sides),
                                1.0f - static_cast<float>(i) / static_cast<float>(segments)});
        }
    }
    // Rows run along the tube, columns around it.
    addGridIndices(mesh, 0, sides, segments);
    for (glm::vec3& p : mesh.positions)
        p.y -= static_cast<float>(lowest);
    return mesh;
}

std::span<const ModelRecipe> modelRecipes() {
    static constexpr std::array<ModelRecipe, 12> kRecipes = {{
        {"sphere", "Sphere", "A ball of 1 m.",
         [] {
             return std::vector{makePart("Sphere", makeSphere(128, 64),
                                         materialNamed("Sphere", "copper-patina", {4.0f, 2.0f}))};
         }},
        {"rounded-cube", "Rounded Cube", "A cube of 1 m with rounded edges.",
         [] {
             return std::vector{makePart("Rounded Cube", makeRoundedCube(10),
                                         materialNamed("Rounded Cube", "wood", {3.0f, 3.0f}))};
         }},
        {"torus-knot", "Torus Knot",
         "A knotted tube of 100,000 triangles: cavities and contact everywhere, for bakes.",
         [] {
             return std::vector{makePart("Torus Knot", makeTorusKnot(512, 98),
                                         materialNamed("Torus Knot", "gold", {1.0f, 12.0f}))};
         }},
        {"shader-ball", "Shader Ball",
         "A hollow ball with grooves and an inner core on a stepped stand: shows a material's "
         "highlights, edges, overhangs and self-shadowing at once.",
         shaderBall},
        {"cornell-box", "Cornell Box", "The measured box of Cornell University (55 cm).",
         cornellBox, Room::Box},
        {"cornell-reference", "Cornell Reference",
         "The Cornell box of undivided walls around a black light in its ceiling, whose light is "
         "known to six digits: for checking radiosity.",
         cornellReference, Room::Box},
        {"wall", "Wall",
         "A light aimed at a white wall above a white floor: a first scene for radiosity.",
         lightAtWall, Room::Open},
        {"chess", "Chess Floor",
         "A checkered floor below a light, and a green wall without thickness: its "
         "colour on the floor is light that the wall has sent.",
         chessFloor, Room::Open},
        {"gallery", "Gallery",
         "Six rooms behind doors on a corridor, two of them lit: light reaches the others by way "
         "of "
         "several surfaces.",
         gallery, Room::Box},
        {"plane", "Plane", "A square of 2 m, lying flat.",
         [] {
             return std::vector{makePart("Plane", makePlane(64),
                                         materialNamed("Plane", "concrete", {2.0f, 2.0f}))};
         }},
        {"sphere-grid", "Sphere Grid",
         "Twenty-five balls: rougher to the right, more metallic upwards; for comparing shading "
         "models and environments.",
         sphereGrid},
        {"glass-spheres", "Glass Spheres",
         "A mirror, a hollow and a coloured ball of glass on a checkered floor, with a lamp: what "
         "path tracing shows and the raster view cannot.",
         glassSpheres},
    }};
    return kRecipes;
}

} // namespace patina::library
