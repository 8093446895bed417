// Visibility, transfer and bounces where they are known in closed form, as a table for the docs.
#include "core/bake/Bake.h"
#include "core/bake/bounce/Interreflection.h"
#include "core/bake/transfer/TransferMeaning.h"
#include "core/light/Light.h"
#include "core/math/ZonalHarmonics.h"
#include "tests/core/bake/BakeTestScene.h"
#include "tests/reference/TruthTable.h"

#include <numbers>

using namespace patina;
using namespace patina::test;
using patina::reference::TruthTable;

namespace {

constexpr int kRays = 4096;
const std::string kDocs = PATINA_SOURCE_DIR "/docs/maths/transfer-truth.md";

// A floor that faces +z and ends at an endless wall in the plane x = 0.
BakeInputs floorAtWall() {
    Mesh floor = gridMesh(4, 4, [](double u, double v) { return glm::dvec3(u, v - 0.5, 0); });
    Mesh wall =
        gridMesh(1, 1, [](double u, double v) { return glm::dvec3(0, 1000 - 2000 * u, 1000 * v); });
    return sceneOf({std::move(floor), std::move(wall)});
}

// A vertical wall that ends at the height, facing +x.
Mesh wallAt(double x, double height, bool facesPlusX) {
    return gridMesh(1, 1, [=](double u, double v) {
        const double z = facesPlusX ? 1000 - 2000 * u : 2000 * u - 1000;
        return glm::dvec3(x, height * v, z);
    });
}

PrtSettings bounceSettings(int bounces, int rays) {
    PrtSettings settings;
    settings.order = 1;
    settings.samples = 1024;
    settings.transfer = TransferKind::Interreflected;
    settings.bounces = bounces;
    settings.bounceSamples = rays;
    settings.fitted = false;
    return settings;
}

double areaMean(const Mesh& mesh, const std::function<double(std::size_t)>& valueAt) {
    double sum = 0.0, area = 0.0;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const std::uint32_t* v = &mesh.indices[i];
        const double a = glm::length(glm::cross(mesh.positions[v[1]] - mesh.positions[v[0]],
                                                mesh.positions[v[2]] - mesh.positions[v[0]]));
        area += a;
        for (std::size_t c = 0; c < 3; ++c)
            sum += a / 3.0 * valueAt(v[c]);
    }
    return sum / area;
}

} // namespace

TEST(ClosedForms, Visibility) {
    TruthTable table;
    const auto at = [](const BakeInputs& inputs, const glm::vec3& point) {
        return double(valueAt(aoOf(inputs, kRays), inputs, 0, point));
    };
    table.add("disc of radius 1 at height 1, h² / (R² + h²)", 0.5,
              at(sceneOf({planeMesh(0.01, 2), discMesh(1.0, 1.0)}), {0, 0, 0}), 0.005);
    const BakeInputs above = sceneOf({planeMesh(1.0, 2), sphereMesh(1.0, 64, 32, {0, 1.5, 0})});
    const BakeArtifact shade = aoOf(above, kRays / 4);
    table.add("under a unit sphere at 1.5", 0.555555556,
              double(valueAt(shade, above, 0, {0, 0, 0})), 0.01);
    table.add("1 aside of that", 0.743984525, double(valueAt(shade, above, 0, {1, 0, 0})), 0.01);
    const BakeInputs resting = sceneOf({planeMesh(2.0, 8), sphereMesh(1.0, 64, 32, {0, 1, 0})});
    const BakeArtifact ball = aoOf(resting, kRays / 4);
    for (const auto& [x, truth] :
         {std::pair(0.5f, 0.284458247), std::pair(1.0f, 0.646446609), std::pair(2.0f, 0.910557281)})
        table.add("resting unit sphere, " + std::to_string(x).substr(0, 3) + " from its foot",
                  truth, double(valueAt(ball, resting, 0, {x, 0, 0})), 0.01);
    const BakeInputs canyon =
        sceneOf({gridMesh(4, 4, [](double u, double v) { return glm::dvec3(u, 0, 0.5 - v); }),
                 wallAt(0, 1, true), wallAt(1, 1, false)});
    table.add("canyon of width 1 and height 1, edge", 0.353553391, at(canyon, {0, 0, 0}), 0.005);
    table.add("canyon, centre", 0.447213596, at(canyon, {0.5f, 0, 0}), 0.005);
    const BakeInputs pit = sceneOf({planeMesh(0.01, 2), gridMesh(128, 1, [](double u, double v) {
                                        const double a = 2 * kPi * wrapped(u);
                                        return glm::dvec3(std::sin(a), v, std::cos(a));
                                    })});
    table.add("pit of radius 1 and depth 1, centre", 0.5, at(pit, {0, 0, 0}), 0.005);
    const BakeInputs bowl = sceneOf({bowlMesh(64, 32)});
    const BakeArtifact open = aoOf(bowl, 1024);
    table.add("hemispherical bowl, mean", 0.5,
              areaMean(*bowl.meshes[0].mesh,
                       [&](std::size_t v) { return double(open.vertices[0].values[v]); }),
              0.005);
    table.expectIn(kDocs);
}

// Light of a disc of half-angle 20° on a floor at a wall: what bands leave out is part of the
// truth. Irradiance, that is pi times the transfer.
TEST(ClosedForms, TransferBesideAWall) {
    TruthTable table;
    const BakeInputs inputs = floorAtWall();
    const BakeArtifact artifact = prtOf(inputs, 6, kRays);
    const std::size_t first = vertexAt(*inputs.meshes[0].mesh, {0, 0, 0}) * 36;
    const std::span<const float> t(artifact.vertices[0].values.data() + first, 36);
    for (const auto& [name, i, truth] :
         {std::tuple("T_0,0", 0, 0.443113463), std::tuple("T_1,0", 2, 0.511663354),
          std::tuple("T_1,1", 3, -0.325735008), std::tuple("T_2,1", 7, -0.429042765),
          std::tuple("T_3,1", 13, -0.304697200), std::tuple("T_3,3", 15, 0.078672479)})
        table.add(std::string("floor at a wall, ") + name, truth, kPi * t[std::size_t(i)], 0.004);
    const glm::vec3 bent = bentNormal(t, {0, 0, 1});
    table.add("its bent normal, away from the wall", 0.537029272, bent.x, 0.005);
    table.add("its bent normal, up", 0.843563608, bent.z, 0.005);

    const double s = std::sqrt(0.5);
    struct Light {
        const char* name;
        glm::dvec3 direction;
        double truth[5]; // orders 2 … 6
    };
    const Light lights[] = {
        {"open side", {s, 0, s}, {0.153688017, 0.248115222, 0.289310744, 0.286494610, 0.269868625}},
        {"zenith", {0, 0, 1}, {0.139239437, 0.193197840, 0.193197840, 0.180324084, 0.180324084}},
        {"behind the wall",
         {-s, 0, s},
         {0.070972237, 0.003524233, -0.037671289, -0.024395228, -0.007769244}}};
    for (const Light& light : lights)
        for (int order = 2; order <= 6; ++order) {
            std::vector<double> coefficients(std::size_t(order * order), 0.0);
            addZonal(zonalCap(20.0 * kPi / 180.0), light.direction, 1.0, coefficients);
            double sum = 0.0;
            for (std::size_t i = 0; i < coefficients.size(); ++i)
                sum += coefficients[i] * double(t[i]);
            table.add("disc of 20°, " + std::string(light.name) + ", " + std::to_string(order) +
                          " bands",
                      light.truth[order - 2], kPi * sum, 0.003);
        }
    table.expectIn(kDocs);
}

TEST(ClosedForms, BouncesInABowl) {
    TruthTable table;
    const Mesh mesh = sanitized(bowlMesh(64, 32));
    const glm::vec3 albedo(0.5f, 0.8f, 1.0f);
    BakeInputs inputs = sceneOf({mesh});
    inputs.meshes[0].surface.baseColor = albedo;
    for (const int bounces : {1, 2, 64}) {
        TileSink sink;
        const Result<BakeArtifact> artifact =
            bakePrtVertex(inputs, bounceSettings(bounces, 256), sink, {});
        ASSERT_TRUE(artifact.ok());
        for (int c = 0; c < 3; ++c) {
            const double rho = std::round(100.0 * double(albedo[c])) / 100.0;
            const double shown = areaMean(mesh, [&](std::size_t v) {
                const VertexBake& bake = artifact->vertices[0];
                return rho * 3.5449077 *
                       double(bake.values[v] + bake.bounced[3 * v + std::size_t(c)]);
            });
            // rho/2 (1 + rho/2 + …)
            const double truth = rho / 2 * (1 - std::pow(rho / 2, bounces + 1)) / (1 - rho / 2);
            char name[64];
            std::snprintf(name, sizeof name, "white sky in a bowl of albedo %.2f, %d bounce%s", rho,
                          bounces, bounces == 1 ? "" : "s");
            table.add(name, truth, shown, 0.01 * truth);
        }
    }
    table.expectIn(kDocs);
}

TEST(ClosedForms, BouncesInASphere) {
    TruthTable table;
    Mesh sphere = sphereMesh(1.0, 32, 16);
    for (std::size_t i = 0; i < sphere.indices.size(); i += 3)
        std::swap(sphere.indices[i + 1], sphere.indices[i + 2]);
    for (const glm::vec3& position : sphere.positions)
        sphere.normals.push_back(-glm::normalize(position));
    BakeInputs inputs = sceneOf({std::move(sphere)});
    inputs.meshes[0].surface.baseColor = {0.18f, 0.5f, 0.8f};
    const Result<BakeGeometry> geometry = makeBakeGeometry(inputs, {});
    const Result<RayScene> scene = RayScene::build(*geometry, {});
    const Result<HitSourcePtr> hits = traceHits(*scene, *geometry, bounceSettings(64, 64), {});
    ASSERT_TRUE(hits.ok());
    BounceSolver solver(*hits);
    solver.setSurfaces(surfacesOf((*hits)->elements(), inputs), {});
    const std::vector<glm::vec3> direct((*hits)->elements().fronts(), glm::vec3(1.0f));
    const Result<std::vector<glm::vec3>> bounced = solver.solveLight(direct, {}, 64, {});
    ASSERT_TRUE(bounced.ok());
    // e / (1 - rho)
    table.add("closed sphere of albedo 0.18", 1.219512195, 1.0 + double((*bounced)[7].r), 0.0001);
    table.add("closed sphere of albedo 0.50", 2.0, 1.0 + double((*bounced)[7].g), 0.0002);
    table.add("closed sphere of albedo 0.80", 5.0, 1.0 + double((*bounced)[7].b), 0.0005);
    table.expectIn(kDocs);
}
