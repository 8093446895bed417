// Radiosity of whole scenes against exact values: the Cornell box by every method and solver, and
// the cube whose continuous solution a division must converge to.
#include "core/radiosity/Reconstruction.h"
#include "core/radiosity/Solve.h"
#include "tests/core/radiosity/RadiosityScenes.h"
#include "tests/core/trace/CornellScene.h"

#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <string>
#include <tuple>

namespace patina::test {

using namespace radiosity;

namespace {

struct Truth {
    const char* name;
    bool blocks;
    glm::dvec3 position, normal; // mm
    double direct, directError;
    std::array<std::array<double, 6>, 1> indirect, indirectError;
};
const Truth kCornell[] = {
#include "tests/core/trace/CornellTruth.inc"
};

// The interpolated irradiance of a solution at a point of the world.
class SmoothLight {
  public:
    SmoothLight(const DividedScene& scene, const Solution& solution)
        : m_scene(scene)
        , m_mesh(litMesh(scene.elements, *scene.scene.geometry())) {
        std::vector<glm::dvec3> irradiance;
        for (std::uint32_t e = 0; e < scene.elements.size(); ++e)
            irradiance.push_back(scene.lit.irradiance(solution, e));
        m_values = vertexLight(m_mesh, scene.elements, irradiance);
    }

    [[nodiscard]] glm::dvec3 at(const glm::dvec3& point, const glm::dvec3& normal) const {
        ClosestRay ray;
        ray.ray.origin = m_scene.scene.toScene(point + 1e-3 * normal);
        ray.ray.direction = glm::vec3(-normal);
        m_scene.scene.rays()->intersect({&ray, 1});
        const std::uint32_t element = m_scene.elements.met(ray);
        double best = -1e300;
        glm::dvec3 result(-1.0);
        for (const LitMesh::Triangle& triangle : m_mesh.triangles) {
            if (triangle.element != element)
                continue;
            const auto corner = [&](std::size_t k) {
                return glm::dvec3(m_mesh.vertices[triangle.vertices[k]].position);
            };
            const glm::dvec3 x = corner(1) - corner(0), y = corner(2) - corner(0),
                             n = glm::cross(x, y), p = point - corner(0);
            const double b = glm::dot(glm::cross(p, y), n) / glm::dot(n, n),
                         c = glm::dot(glm::cross(x, p), n) / glm::dot(n, n);
            const double inside = std::min({1.0 - b - c, b, c});
            if (inside > best) {
                best = inside;
                const auto light = [&](std::size_t k) {
                    return m_values[m_mesh.vertices[triangle.vertices[k]].light];
                };
                result = (1.0 - b - c) * light(0) + b * light(1) + c * light(2);
            }
        }
        EXPECT_GT(best, -1e-3);
        return result;
    }
    [[nodiscard]] const LitMesh& mesh() const { return m_mesh; }

  private:
    const DividedScene& m_scene;
    LitMesh m_mesh;
    std::vector<glm::dvec3> m_values;
};

class CornellBox : public ::testing::TestWithParam<std::tuple<FactorMethod, Solver, bool>> {};

TEST_P(CornellBox, IsLitAsRandomWalksSay) {
    const auto [method, solver, blocks] = GetParam();
    // Some of the points are 2 cm from a block.
    const bool shooting = solver == Solver::Progressive;
    const double edge = blocks ? 0.025 : (method == FactorMethod::Rays && !shooting ? 0.04 : 0.06);
    const auto scene = divided(cornellBox(kCornellWalls[0], blocks), {edge}, {64, 1, false});
    // What arrives at an element when others shoot is a matter of luck, until many rays do.
    const int rays = shooting ? 1 << 14 : 1 << 12;
    const int resolution =
        method == FactorMethod::Rays ? rays : (method == FactorMethod::Hemicube ? 32 : 16);
    const auto factors = scene->factors({method, resolution, 1});
    SolveSettings settings;
    settings.solver = solver;
    settings.residual = 1e-3;
    const auto solved = solve(scene->problem(), *factors, settings, {});
    ASSERT_TRUE(solved) << solved.error().text();
    EXPECT_TRUE(solved->report.converged);
    const SmoothLight light(*scene, solved->solution);
    int points = 0;
    for (const Truth& truth : kCornell) {
        if (truth.blocks != blocks)
            continue;
        ++points;
        const glm::dvec3 irradiance = light.at(truth.position / 1000.0, truth.normal);
        for (int c = 0; c < 3; ++c) {
            const double expected = truth.direct + truth.indirect[0][static_cast<std::size_t>(c)];
            EXPECT_NEAR(irradiance[c], expected, 0.02 * expected) << truth.name << " " << c;
        }
    }
    EXPECT_EQ(points, blocks ? 14 : 8);
}

// The irradiance of points and the mean over a wall, as the division gets finer.
// radiosity.cube_continuous: the inside of a unit cube whose ceiling sends 1 W/m² out.
TEST(Cube, DividedFinelyIsLitAsTheContinuousOne) {
    struct Place {
        glm::dvec3 position, normal;
        double half, eighty; // irradiance for a reflectance of .5 and .8
    };
    const std::array<Place, 5> places{{
        {{0.5, 0.5, 0}, {0, 0, 1}, 0.3952091, 0.8914367},
        {{0.1, 0.1, 0}, {0, 0, 1}, 0.2968102, 0.7662476},
        {{0, 0.5, 0.5}, {1, 0, 0}, 0.3553038, 0.8546612},
        {{0, 0.5, 0.9}, {1, 0, 0}, 0.5846518, 1.0900284},
        {{0.5, 0.5, 1}, {0, 0, -1}, 0.1835722, 0.6901189},
    }};
    for (const bool bright : {false, true}) {
        std::array<double, 2> errors{};
        for (const bool fine : {false, true}) {
            const auto scene = divided(sceneOf(unitCube(bright ? 0.8f : 0.5f)),
                                       {fine ? 0.067 : 0.26}, {64, 0, false});
            const auto factors = scene->factors({FactorMethod::Analytic, 1, 0});
            SolveSettings settings;
            settings.residual = 1e-6;
            const auto solved = solve(scene->problem(), *factors, settings, {});
            ASSERT_TRUE(solved);
            const SmoothLight light(*scene, solved->solution);
            for (const Place& place : places) {
                const double truth = bright ? place.eighty : place.half;
                const double error = std::abs(light.at(place.position, place.normal).y / truth - 1);
                errors[fine] = std::max(errors[fine], error);
            }
            // Means of floor, wall and ceiling do not depend on the division much.
            double floor = 0.0, wall = 0.0, ceiling = 0.0;
            for (std::uint32_t e = 0; e < scene->elements.size(); ++e) {
                const glm::dvec3 n = scene->elements.face(e).normal;
                const double power =
                    scene->elements.area(e) * scene->lit.irradiance(solved->solution, e).x;
                (n.z > 0.5 ? floor : (n.z < -0.5 ? ceiling : wall)) += power;
            }
            const double tolerance = fine ? 2e-3 : 1e-2;
            EXPECT_NEAR(floor, bright ? 0.826394696698 : 0.342410196698, tolerance);
            EXPECT_NEAR(wall / 4.0, bright ? 0.860212548075 : 0.362258448075, tolerance);
            EXPECT_NEAR(ceiling, bright ? 0.7343341 : 0.208705, tolerance);
        }
        EXPECT_LT(errors[1], 0.01);
        EXPECT_LT(errors[1], 0.5 * errors[0]);
    }
}

INSTANTIATE_TEST_SUITE_P(
    Radiosity, CornellBox,
    ::testing::Values(std::tuple(FactorMethod::Rays, Solver::GaussSeidel, false),
                      std::tuple(FactorMethod::Rays, Solver::Progressive, false),
                      std::tuple(FactorMethod::Rays, Solver::GaussSeidel, true),
                      std::tuple(FactorMethod::Hemicube, Solver::Jacobi, false),
                      std::tuple(FactorMethod::Hemicube, Solver::Overshooting, false),
                      std::tuple(FactorMethod::Analytic, Solver::Southwell, false),
                      std::tuple(FactorMethod::Analytic, Solver::Direct, false)),
    [](const auto& test) {
        return std::string(name(std::get<0>(test.param))) + "_" +
               std::string(name(std::get<1>(test.param))) +
               (std::get<2>(test.param) ? "_blocks" : "_empty");
    });

} // namespace
} // namespace patina::test
