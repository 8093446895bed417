// The built-in meshes keep every promise that bakes and the renderer rely on.
#include "core/library/Library.h"
#include "core/library/Meshes.h"
#include "core/material/Material.h"
#include "core/mesh/UvUnwrap.h"

#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <gmock/gmock.h>
#include <map>
#include <set>

using namespace patina;

namespace {

struct Triangle {
    glm::dvec3 a, b, c;
    [[nodiscard]] glm::dvec3 cross() const { return glm::cross(b - a, c - a); }
};
Triangle triangle(const Mesh& mesh, std::size_t t) {
    const auto corner = [&](std::size_t k) {
        return glm::dvec3(mesh.positions[mesh.indices[3 * t + k]]);
    };
    return {corner(0), corner(1), corner(2)};
}
double area(const Mesh& mesh) {
    double sum = 0;
    for (std::size_t t = 0; t < mesh.triangleCount(); ++t)
        sum += 0.5 * glm::length(triangle(mesh, t).cross());
    return sum;
}
// By the divergence theorem; positive when closed and facing outwards.
double volume(const Mesh& mesh) {
    double sum = 0;
    for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
        const Triangle tri = triangle(mesh, t);
        sum += glm::dot(tri.a, glm::cross(tri.b, tri.c)) / 6.0;
    }
    return sum;
}
// Directed edges without their opposite, after joining vertices closer than 10 micrometres.
std::size_t openEdges(const Mesh& mesh) {
    using Key = std::array<long, 3>;
    std::map<Key, std::uint32_t> ids;
    std::vector<std::uint32_t> id;
    for (const glm::vec3& p : mesh.positions) {
        const Key key = {std::lround(p.x * 1e5), std::lround(p.y * 1e5), std::lround(p.z * 1e5)};
        id.push_back(ids.emplace(key, static_cast<std::uint32_t>(ids.size())).first->second);
    }
    std::multiset<std::pair<std::uint32_t, std::uint32_t>> edges;
    for (std::size_t t = 0; t < mesh.triangleCount(); ++t)
        for (std::size_t k = 0; k < 3; ++k)
            edges.emplace(id[mesh.indices[3 * t + k]], id[mesh.indices[3 * t + (k + 1) % 3]]);
    std::size_t open = 0;
    for (const auto& [from, to] : edges)
        open += edges.count({to, from}) != 1;
    return open;
}

std::vector<library::ModelPart> partsOf(const char* model) {
    return library::model(model).value();
}

void append(Mesh& all, const Mesh& mesh) {
    const auto start = static_cast<std::uint32_t>(all.positions.size());
    all.positions.insert(all.positions.end(), mesh.positions.begin(), mesh.positions.end());
    all.uvs.insert(all.uvs.end(), mesh.uvs.begin(), mesh.uvs.end());
    for (const std::uint32_t index : mesh.indices)
        all.indices.push_back(start + index);
}
Mesh joined(const std::vector<library::ModelPart>& parts) {
    Mesh all;
    for (const library::ModelPart& p : parts)
        append(all, *p.mesh);
    return all;
}

const library::ModelPart& part(const std::vector<library::ModelPart>& parts, const char* name) {
    for (const library::ModelPart& p : parts)
        if (p.name == name)
            return p;
    throw std::runtime_error(name);
}

class EveryModel : public testing::TestWithParam<const char*> {};

} // namespace

INSTANTIATE_TEST_SUITE_P(Library, EveryModel,
                         testing::Values("sphere", "rounded-cube", "torus-knot", "shader-ball",
                                         "cornell-box", "cornell-reference", "wall", "chess",
                                         "gallery", "plane", "sphere-grid", "glass-spheres"));

TEST_P(EveryModel, NeedsNoRepair) {
    for (const library::ModelPart& p : partsOf(GetParam())) {
        SCOPED_TRACE(p.name);
        EXPECT_EQ(p.mesh->name, p.name);
        EXPECT_EQ(p.material.name, p.materialName);
        EXPECT_EQ(p.material.id, 0u);
        Mesh copy = *p.mesh;
        const MeshRepairs repairs = sanitizeMesh(copy);
        EXPECT_EQ(repairs.droppedTriangles, 0u);
        EXPECT_EQ(repairs.invalidTriangles, 0u);
        EXPECT_EQ(repairs.repairedNormals, 0u);
        EXPECT_FALSE(repairs.generatedNormals || repairs.generatedTangents || repairs.generatedUvs);
        EXPECT_EQ(copy, *p.mesh);
    }
}

TEST_P(EveryModel, FramesItsSurface) {
    for (const library::ModelPart& p : partsOf(GetParam())) {
        SCOPED_TRACE(p.name);
        const Mesh& mesh = *p.mesh;
        ASSERT_EQ(mesh.normals.size(), mesh.positions.size());
        ASSERT_EQ(mesh.tangents.size(), mesh.positions.size());
        ASSERT_EQ(mesh.uvs.size(), mesh.positions.size());
        for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
            ASSERT_NEAR(glm::length(mesh.normals[i]), 1.0f, 1e-5f);
            ASSERT_NEAR(glm::length(glm::vec3(mesh.tangents[i])), 1.0f, 1e-4f);
            ASSERT_NEAR(glm::dot(glm::vec3(mesh.tangents[i]), mesh.normals[i]), 0.0f, 1e-4f);
            // No chart is mirrored: letters on it can be read.
            ASSERT_EQ(mesh.tangents[i].w, 1.0f) << "vertex " << i;
        }
        // Vertex normals lie on the side that counter-clockwise corners show, within the turn of
        // the coarsest arc.
        for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
            const glm::vec3 n = glm::vec3(glm::normalize(triangle(mesh, t).cross()));
            for (std::size_t k = 0; k < 3; ++k)
                ASSERT_GT(glm::dot(n, mesh.normals[mesh.indices[3 * t + k]]), 0.90f)
                    << "triangle " << t;
        }
    }
}

TEST_P(EveryModel, StandsOnTheGroundAndHasAnObjectsSize) {
    Bounds bounds;
    for (const library::ModelPart& p : partsOf(GetParam()))
        bounds.add(p.mesh->bounds());
    EXPECT_NEAR(bounds.min.y, 0.0f, 1e-6f);
    const float largest = std::max({bounds.size().x, bounds.size().y, bounds.size().z});
    EXPECT_GE(largest, 0.5f);
    EXPECT_LE(largest, GetParam() == std::string("gallery") ? 20.0f : 2.0f);
}

// Meshes that share a material share its texture: together they must not overlap.
TEST_P(EveryModel, HasRoomForABakeInItsTexture) {
    std::map<std::string, Mesh> byMaterial;
    for (const library::ModelPart& p : partsOf(GetParam())) {
        append(byMaterial[p.materialName], *p.mesh);
    }
    for (const auto& [name, mesh] : byMaterial) {
        SCOPED_TRACE(name);
        for (const glm::vec2& uv : mesh.uvs)
            ASSERT_TRUE(uv.x >= 0.0f && uv.x <= 1.0f && uv.y >= 0.0f && uv.y <= 1.0f)
                << uv.x << ", " << uv.y;
        EXPECT_FALSE(hasOverlappingUvs(mesh, 1024));
    }
}

TEST(LibraryMesh, SolidsAreClosed) {
    for (const char* name : {"sphere", "rounded-cube", "torus-knot", "shader-ball"}) {
        for (const library::ModelPart& p : partsOf(name)) {
            SCOPED_TRACE(p.name);
            // The liner closes the ball.
            EXPECT_EQ(openEdges(*p.mesh) == 0, p.name != "Ball" && p.name != "Liner");
        }
        const Mesh all = joined(partsOf(name));
        EXPECT_EQ(openEdges(all), 0u);
        EXPECT_GT(volume(all), 0.0);
    }
}

TEST(LibraryMesh, TheGridSpansMetallicAndRoughness) {
    const auto parts = partsOf("sphere-grid");
    ASSERT_EQ(parts.size(), 25u);
    for (const library::ModelPart& p : parts) {
        const Bounds bounds = p.mesh->bounds();
        EXPECT_NEAR(bounds.size().y, 0.36f, 1e-5f);
        const glm::vec3 center = bounds.center();
        // rougher to the right, more metallic upwards
        EXPECT_NEAR(p.material.perceptualRoughness, (center.x + 0.8f) / 1.6f, 1e-4f) << p.name;
        EXPECT_NEAR(p.material.metallic, (center.y - 0.18f) / 1.6f, 1e-4f) << p.name;
        EXPECT_EQ(p.material.baseColor, parts.front().material.baseColor);
        EXPECT_EQ(openEdges(*p.mesh), 0u);
    }
}

// Closed: what the walls enclose is the air of the rooms, the corridor and the doorways.
TEST(LibraryMesh, TheGalleryIsSixRoomsOfWhichTwoAreLit) {
    const auto parts = partsOf("gallery");
    std::size_t triangles = 0;
    for (const library::ModelPart& p : parts)
        triangles += p.mesh->triangleCount();
    EXPECT_LE(triangles, 2000u);
    EXPECT_EQ(part(parts, "Lights").mesh->triangleCount(), 4u);
    for (const library::ModelPart& p : parts)
        EXPECT_EQ(p.material.emissive != glm::vec3(0.0f), p.name == "Lights") << p.name;
    // Walls, floors and ceilings enclose the air of six rooms, the corridor and six doorways.
    Mesh rooms = *part(parts, "Walls").mesh;
    append(rooms, *part(parts, "Floor").mesh);
    EXPECT_NEAR(-volume(rooms), 6 * 4.0 * 5.0 * 3.0 + 2.0 * 12.4 * 3.0 + 6 * 0.2 * 1.0 * 2.1, 1e-3);
}

// Each ball is a closed body, the hollow's wall faces what it holds, and they do not meet.
TEST(LibraryMesh, TheGlassSpheresAreBodiesOfGlass) {
    const auto parts = partsOf("glass-spheres");
    double outside = 0.0, inside = 0.0;
    for (const library::ModelPart& p : parts) {
        const bool field = p.name.ends_with("Fields");
        EXPECT_EQ(openEdges(*p.mesh) == 0, !field) << p.name;
        if (field)
            continue;
        EXPECT_GT(p.mesh->bounds().min.y, 0.0f) << p.name;
        if (p.name == "Hollow Sphere, Inside")
            inside = volume(*p.mesh);
        else
            EXPECT_GT(volume(*p.mesh), 0.0) << p.name;
        if (p.name == "Hollow Sphere, Outside")
            outside = volume(*p.mesh);
    }
    EXPECT_LT(inside, 0.0);
    EXPECT_GT(outside + inside, 0.0);
    for (const char* name :
         {"Hollow Sphere, Outside", "Hollow Sphere, Inside", "Coloured Sphere"}) {
        const Material& m = part(parts, name).material;
        EXPECT_EQ(m.transmission, 1.0f);
        EXPECT_FALSE(m.thinWalled);
    }
}

TEST(LibraryMesh, SizesAreWhatTheFormulasSay) {
    constexpr double kPi = 3.14159265358979;
    const Mesh sphere = library::makeSphere(128, 64);
    EXPECT_NEAR(volume(sphere), kPi / 6.0, 0.002 * kPi / 6.0);
    for (const glm::vec3& p : sphere.positions)
        ASSERT_NEAR(glm::length(p - glm::vec3(0.0f, 0.5f, 0.0f)), 0.5f, 1e-6f);

    // A cube of side a = 1 - 2r, six slabs, twelve quarter cylinders, a ball.
    const double r = 0.12, a = 1.0 - 2.0 * r;
    EXPECT_NEAR(volume(library::makeRoundedCube(10)),
                a * a * a + 6 * a * a * r + 3 * kPi * r * r * a + 4.0 / 3.0 * kPi * r * r * r,
                1e-3);

    // A tube's volume is its section times the length of its centre line (Pappus).
    const Mesh knot = library::makeTorusKnot(512, 98);
    EXPECT_EQ(knot.triangleCount(), 2u * 512u * 98u);
    EXPECT_EQ(library::makeTorusKnot(7, 5).triangleCount(), 70u);
    double length = 0;
    const auto center = [](double t) {
        const double d = 0.42 + 0.19 * std::cos(3 * t);
        return glm::dvec3(d * std::cos(2 * t), d * std::sin(2 * t), 0.19 * std::sin(3 * t));
    };
    for (int i = 0; i < 4096; ++i)
        length += glm::length(center(2 * kPi * (i + 1) / 4096) - center(2 * kPi * i / 4096));
    const double expected = kPi * 0.088 * 0.088 * length;
    EXPECT_NEAR(volume(knot), expected, 0.003 * expected);
    EXPECT_NEAR(area(library::makePlane(8)), 4.0, 1e-6);
}

TEST(LibraryMesh, ShaderBallHasItsPartsAtAModestCost) {
    const auto parts = partsOf("shader-ball");
    std::size_t triangles = 0;
    for (const char* name : {"Ball", "Core", "Stand", "Liner", "Floor"})
        triangles += part(parts, name).mesh->triangleCount();
    EXPECT_EQ(parts.size(), 5u);
    EXPECT_GE(triangles, 60'000u);
    EXPECT_LE(triangles, 120'000u);
    // The ball is hollow: a shell of about 5 cm, less than half of the full ball's volume.
    const double full = 4.0 / 3.0 * 3.14159 * std::pow(0.55, 3);
    EXPECT_LT(volume(joined({part(parts, "Ball"), part(parts, "Liner")})), 0.5 * full);
    // Nothing sinks into the floor.
    EXPECT_GT(part(parts, "Stand").mesh->bounds().min.y, part(parts, "Floor").mesh->bounds().max.y);
    EXPECT_GT(part(parts, "Ball").mesh->bounds().min.y, part(parts, "Floor").mesh->bounds().max.y);
}

// Cornell Box Data: floor 552.8 / 549.6 × 559.2 mm, lamp 130 × 105 mm, block heights 165 and 330.
TEST(LibraryMesh, CornellBoxIsAsMeasured) {
    const auto parts = partsOf("cornell-box");
    EXPECT_NEAR(area(*part(parts, "Light").mesh), 13650e-6, 1e-9);
    EXPECT_NEAR(area(*part(parts, "Right Wall").mesh), 0.5592 * 0.5488, 1e-7);
    // Floor, ceiling and back wall: two trapezia and a rectangle.
    EXPECT_NEAR(area(*part(parts, "Room").mesh),
                308231.04e-6 + 0.556 * 0.5592 + 0.5 * (0.5496 + 0.556) * 0.5488, 1e-6);
    EXPECT_NEAR(part(parts, "Short Block").mesh->bounds().max.y, 0.165f, 1e-6f);
    EXPECT_NEAR(part(parts, "Tall Block").mesh->bounds().max.y, 0.330f, 1e-6f);
    EXPECT_NEAR(part(parts, "Light").mesh->bounds().min.y, 0.5488f, 0.001f);
    EXPECT_LT(part(parts, "Light").mesh->bounds().max.y, 0.5488f);

    // Seen from +Z the red wall is on the left, and all walls face the room.
    EXPECT_LT(part(parts, "Left Wall").mesh->bounds().max.x, -0.27f);
    EXPECT_GT(part(parts, "Right Wall").mesh->bounds().min.x, 0.27f);
    const glm::vec3 middle(0.0f, 0.27f, 0.0f);
    for (const char* name : {"Room", "Left Wall", "Right Wall", "Light"}) {
        const Mesh& mesh = *part(parts, name).mesh;
        for (std::size_t i = 0; i < mesh.positions.size(); ++i)
            ASSERT_GT(glm::dot(mesh.normals[i], middle - mesh.positions[i]), 0.0f) << name;
    }
    const Mesh& room = *part(parts, "Room").mesh;
    EXPECT_NEAR(room.bounds().min.z, -0.2796f, 1e-6f); // the back wall; the opening faces +Z

    EXPECT_EQ(part(parts, "Left Wall").material.baseColor,
              glm::vec3(0.493880f, 0.048870f, 0.051155f));
    EXPECT_EQ(part(parts, "Right Wall").material.baseColor,
              glm::vec3(0.068413f, 0.398461f, 0.086545f));
    EXPECT_EQ(part(parts, "Room").material.baseColor, glm::vec3(0.738239f, 0.735992f, 0.738601f));
    EXPECT_EQ(part(parts, "Tall Block").materialName, part(parts, "Room").materialName);
    // Lamp spectrum in linear sRGB: 20.7168, 10.8546, 2.7707.
    const Material& light = part(parts, "Light").material;
    EXPECT_NEAR(light.emissive.r * light.emissiveStrength, 20.7168f, 1e-3f);
    EXPECT_NEAR(light.emissive.g * light.emissiveStrength, 10.8546f, 1e-3f);
    EXPECT_NEAR(light.emissive.b * light.emissiveStrength, 2.7707f, 1e-3f);
}
