// The Cornell box without its blocks, lit by its lamp. A lamp in the scene is not light of the
// environment, but bounces are followed from whatever direct light the walls get: here the
// lamp's, in closed form. The truth: 30 million random walks per point, which a deterministic
// radiosity solution of 28 × 28 patches a wall agrees with to 0.07 %.
#include "core/bake/bounce/Interreflection.h"
#include "core/library/Library.h"
#include "tests/reference/TruthTable.h"

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

using namespace patina;
using patina::reference::TruthTable;

namespace {

// Data sheet's millimetres to the built-in model's metres.
glm::dvec3 toWorld(const glm::dvec3& mm) {
    return {(278.0 - mm.x) / 1000.0, mm.y / 1000.0, (279.6 - mm.z) / 1000.0};
}

// Irradiance of the lamp, of radiance 1: Lambert's formula for polygons, wholly in front of all
// that it emits on.
double lampIrradiance(const glm::dvec3& position, const glm::dvec3& normal) {
    const std::array<glm::dvec3, 4> corners = {
        toWorld({343, 548.8, 227}), toWorld({343, 548.8, 332}), toWorld({213, 548.8, 332}),
        toWorld({213, 548.8, 227})};
    if (position.y > 0.5475) // the ceiling, and the upper rims of the walls
        return 0.0;
    double sum = 0.0;
    for (std::size_t i = 0; i < 4; ++i) {
        const glm::dvec3 a = glm::normalize(corners[i] - position),
                         b = glm::normalize(corners[(i + 1) % 4] - position);
        const glm::dvec3 edge = glm::cross(a, b);
        sum +=
            std::acos(std::min(1.0, glm::dot(a, b))) * glm::dot(edge / glm::length(edge), normal);
    }
    return 0.5 * std::abs(sum);
}

BakeInputs emptyBox() {
    BakeInputs inputs;
    const Result<std::vector<library::ModelPart>> parts = library::model("cornell-box");
    for (const library::ModelPart& part : *parts) {
        if (part.name == "Short Block" || part.name == "Tall Block")
            continue;
        BakeMesh& mesh = inputs.meshes.emplace_back();
        mesh.id = mesh.material = Id(inputs.meshes.size());
        mesh.mesh = part.mesh;
        mesh.surface = bakeSurface(part.material);
        if (part.name == "Light")
            mesh.surface.baseColor = glm::vec3(0.0f); // a black lamp
    }
    return inputs;
}

// Values between the vertices, at a point of the surface with this normal.
glm::dvec3 between(const BakeGeometry& geometry, const std::vector<glm::vec3>& values,
                   const glm::dvec3& world, const glm::dvec3& normal) {
    const glm::dvec3 p = (world - geometry.centre) * geometry.unitsPerMetre;
    std::size_t first = 0;
    for (const BakeGeometryMesh& mesh : geometry.meshes) {
        const std::vector<std::uint32_t>& indices = mesh.mesh->indices;
        for (std::size_t i = 0; i < indices.size(); i += 3) {
            const glm::dvec3 a(mesh.positions[indices[i]]), b(mesh.positions[indices[i + 1]]),
                c(mesh.positions[indices[i + 2]]);
            const glm::dvec3 cross = glm::cross(b - a, c - a);
            const double area = glm::length(cross);
            if (glm::dot(cross / area, normal) < 0.99 ||
                std::abs(glm::dot(cross / area, p - a)) > 1e-4)
                continue;
            const double u = glm::dot(glm::cross(c - a, a - p), cross) / (area * area),
                         v = glm::dot(glm::cross(a - b, a - p), cross) / (area * area);
            const double wb = u, wc = v, wa = 1.0 - u - v;
            if (std::min({wa, wb, wc}) < -1e-3)
                continue;
            return wa * glm::dvec3(values[first + indices[i]]) +
                   wb * glm::dvec3(values[first + indices[i + 1]]) +
                   wc * glm::dvec3(values[first + indices[i + 2]]);
        }
        first += mesh.positions.size();
    }
    ADD_FAILURE() << "no surface there";
    return glm::dvec3(0.0);
}

PrtSettings settings() {
    PrtSettings settings;
    settings.order = 1;
    settings.transfer = TransferKind::Interreflected;
    settings.bounceSamples = 1024;
    return settings;
}

} // namespace

TEST(CornellBox, IrradianceByWayOfTheWalls) {
    const BakeInputs inputs = emptyBox();
    const Result<BakeGeometry> geometry = makeBakeGeometry(inputs, {});
    const Result<RayScene> scene = RayScene::build(*geometry, {});
    const Result<HitSourcePtr> hits = traceHits(*scene, *geometry, settings(), {});
    ASSERT_TRUE(hits.ok());
    BounceSolver solver(*hits);
    solver.setSurfaces(surfacesOf((*hits)->elements(), inputs), {});
    std::vector<glm::vec3> direct;
    for (const BakeGeometryMesh& mesh : geometry->meshes)
        for (std::size_t v = 0; v < mesh.positions.size(); ++v)
            direct.emplace_back(
                float(lampIrradiance(glm::dvec3(mesh.positions[v]) / geometry->unitsPerMetre +
                                         geometry->centre,
                                     glm::dvec3(mesh.normals[v])) /
                      std::numbers::pi));
    const Result<std::vector<glm::vec3>> bounced = solver.solveLight(direct, {}, 24, {});
    ASSERT_TRUE(bounced.ok());

    struct Point {
        const char* name;
        glm::dvec3 place, normal; // of the data sheet
        double direct;
        std::array<double, 3> indirect;
    };
    const Point points[] = {
        {"floor, centre", {278, 0, 279.6}, {0, 1, 0}, 0.0446324, {0.0143666, 0.0126342, 0.0087326}},
        {"floor, by the red wall",
         {400, 0, 100},
         {0, 1, 0},
         0.0336093,
         {0.0109812, 0.0074403, 0.0052344}},
        {"floor, by the green wall",
         {100, 0, 450},
         {0, 1, 0},
         0.0311845,
         {0.0140210, 0.0167108, 0.0107157}},
        {"back wall, centre",
         {278, 274.4, 559.2},
         {0, 0, -1},
         0.0436532,
         {0.0149674, 0.0132362, 0.0093614}},
        {"green wall, centre",
         {0, 274.4, 279.6},
         {1, 0, 0},
         0.0441813,
         {0.0211537, 0.0158048, 0.0141329}},
        {"ceiling", {100, 548.8, 100}, {0, -1, 0}, 0.0, {0.0122858, 0.0143974, 0.0096155}}};
    TruthTable table;
    for (const Point& point : points) {
        const glm::dvec3 world = toWorld(point.place),
                         normal(-point.normal.x, point.normal.y, -point.normal.z);
        EXPECT_NEAR(lampIrradiance(world, normal), point.direct, 2e-5 * 0.05) << point.name;
        const glm::dvec3 found = std::numbers::pi * between(*geometry, *bounced, world, normal);
        const char* channels[] = {"red", "green", "blue"};
        for (int c = 0; c < 3; ++c) {
            const double truth = point.indirect[std::size_t(c)];
            table.add("Cornell box, " + std::string(point.name) + ", " + channels[c], truth,
                      found[c], 0.02 * truth);
        }
    }
    table.expectIn(PATINA_SOURCE_DIR "/docs/maths/transfer-truth.md");
}

// What s sends to t is what t sends to s: ∫ t G s dA = ∫ s G t dA for any light s and t of the
// surfaces, G being one bounce off white; and no more comes than is sent.
TEST(CornellBox, BouncesAreReciprocalAndLoseEnergy) {
    BakeInputs inputs;
    const Result<std::vector<library::ModelPart>> parts = library::model("cornell-box");
    for (const library::ModelPart& part : *parts) {
        BakeMesh& mesh = inputs.meshes.emplace_back();
        mesh.id = mesh.material = Id(inputs.meshes.size());
        mesh.mesh = part.mesh;
        mesh.surface.baseColor = glm::vec3(1.0f);
    }
    const Result<BakeGeometry> geometry = makeBakeGeometry(inputs, {});
    const Result<RayScene> scene = RayScene::build(*geometry, {});
    PrtSettings few = settings();
    few.bounceSamples = 256;
    const Result<HitSourcePtr> hits = traceHits(*scene, *geometry, few, {});
    ASSERT_TRUE(hits.ok());
    BounceSolver solver(*hits);
    solver.setSurfaces(surfacesOf((*hits)->elements(), inputs), {});

    // Three lights at once: one colour each.
    std::vector<glm::vec3> sent;
    std::vector<double> areas;
    for (const BakeGeometryMesh& mesh : geometry->meshes) {
        const std::size_t first = areas.size();
        for (const glm::vec3& p : mesh.positions)
            sent.emplace_back(1.0f + p.x, 0.5f + p.y * p.y, p.z > 0.0f ? 0.2f : 1.0f);
        areas.resize(first + mesh.positions.size(), 0.0);
        const std::vector<std::uint32_t>& indices = mesh.mesh->indices;
        for (std::size_t i = 0; i < indices.size(); ++i) {
            const std::uint32_t* t = indices.data() + i / 3 * 3;
            areas[first + indices[i]] +=
                glm::length(glm::cross(mesh.positions[t[1]] - mesh.positions[t[0]],
                                       mesh.positions[t[2]] - mesh.positions[t[0]])) /
                6.0;
        }
    }
    const Result<std::vector<glm::vec3>> received = solver.solveLight(sent, {}, 1, {});
    ASSERT_TRUE(received.ok());
    for (const auto& [s, t] : {std::pair(0, 1), std::pair(1, 2), std::pair(2, 0)}) {
        double there = 0.0, back = 0.0;
        for (std::size_t e = 0; e < areas.size(); ++e) {
            there += areas[e] * double(sent[e][t]) * double((*received)[e][s]);
            back += areas[e] * double(sent[e][s]) * double((*received)[e][t]);
        }
        EXPECT_NEAR(there / back, 1.0, 0.01);
    }
    for (int c = 0; c < 3; ++c) {
        double out = 0.0, in = 0.0;
        for (std::size_t e = 0; e < areas.size(); ++e) {
            out += areas[e] * double(sent[e][c]);
            in += areas[e] * double((*received)[e][c]);
        }
        EXPECT_LT(in, out);
        EXPECT_GT(in, 0.3 * out);
    }
}
