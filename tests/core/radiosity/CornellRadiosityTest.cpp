// Radiosity of whole scenes against exact values: the Cornell box by every method and solver, and
// the cube whose continuous solution a division must converge to.
#include "core/radiosity/FactorMatrix.h"
#include "core/radiosity/RadiosityPicture.h"
#include "core/radiosity/Solve.h"
#include "tests/core/radiosity/RadiosityScenes.h"
#include "tests/core/trace/CornellScene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace patina::test {

using namespace radiosity;

namespace {

// The interpolated irradiance of a solution at a point of the world.
class SmoothLight {
  public:
    SmoothLight(const DividedScene& scene, const Solution& solution)
        : m_scene(scene)
        , m_seen(scene.scene, scene.elements, scene.lit, solution) {}

    [[nodiscard]] glm::dvec3 at(const glm::dvec3& point, const glm::dvec3& normal) const {
        const ClosestRay ray =
            m_scene.scene.closest(m_scene.scene.toScene(point + 1e-3 * normal), glm::vec3(-normal));
        const std::uint32_t element = m_scene.elements.met(ray);
        EXPECT_NE(element, kNone);
        return glm::dvec3(m_seen.irradiance(element, m_scene.scene.toScene(point)));
    }

  private:
    const DividedScene& m_scene;
    SeenSolution m_seen;
};

void expectAsRandomWalksSay(const DividedScene& scene, const Solution& solution, bool blocks,
                            double tolerance = 0.02) {
    const SmoothLight light(scene, solution);
    int points = 0;
    for (const library::CornellPoint& truth : library::cornellPoints()) {
        if (truth.blocks != blocks)
            continue;
        ++points;
        const glm::dvec3 irradiance = light.at(truth.position / 1000.0, truth.normal);
        for (int c = 0; c < 3; ++c) {
            const double expected = truth.irradiance(static_cast<std::size_t>(c));
            EXPECT_NEAR(irradiance[c], expected, tolerance * expected) << truth.name << " " << c;
        }
    }
    EXPECT_EQ(points, blocks ? 14 : 8);
}

class CornellBox : public ::testing::TestWithParam<std::tuple<FactorMethod, Solver, bool>> {};

class CornellBoxOfPatches : public CornellBox {};

TEST_P(CornellBox, IsLitAsRandomWalksSay) {
    const auto [method, solver, blocks] = GetParam();
    // Some of the points are 2 cm from a block.
    const bool shooting = solver == Solver::Progressive;
    const double edge = blocks ? 0.025 : (method == FactorMethod::Rays && !shooting ? 0.04 : 0.06);
    const auto scene = divided(cornellBox(kCornellWalls[0], blocks), {edge}, {64, 1, false});
    // What arrives at an element when others shoot is a matter of luck, until many rays do.
    const int rays = shooting ? 1 << 13 : (blocks ? 1 << 12 : 1 << 10);
    const int resolution = method == FactorMethod::Rays         ? rays
                           : method == FactorMethod::Hemicube   ? 32
                           : method == FactorMethod::Paraboloid ? 64
                                                                : 16;
    const auto factors = scene->factors({method, resolution, 1});
    SolveSettings settings;
    settings.solver = solver;
    settings.residual = 1e-3;
    const auto solved = solve(scene->problem(), *factors, settings, {});
    ASSERT_TRUE(solved) << solved.error().text();
    EXPECT_TRUE(solved->report.converged);
    expectAsRandomWalksSay(*scene, solved->solution, blocks);
}

// Patches of 4 elements shoot, of 6 cm, and with blocks of 5 cm.
TEST_P(CornellBoxOfPatches, IsLitAsRandomWalksSay) {
    const auto [method, solver, blocks] = GetParam();
    const double edge = blocks ? 0.025 : 0.03;
    const auto scene =
        divided(cornellBox(kCornellWalls[0], blocks),
                {.maxArea = edge * edge, .patchArea = 4.0 * edge * edge}, {64, 1, false});
    // Next to blocks, patches are further off than noise.
    const int resolution = method == FactorMethod::Rays       ? 1 << 11
                           : method == FactorMethod::Hemicube ? 32
                                                              : 16;
    const auto factors = scene->factors({method, resolution, 1});
    SolveSettings settings;
    settings.solver = solver;
    settings.residual = 1e-3;
    const auto solved = solve(scene->problem(), *factors, settings, {});
    ASSERT_TRUE(solved) << solved.error().text();
    EXPECT_TRUE(solved->report.converged);
    EXPECT_LE(solved->report.rows, scene->problem().size() / 4);
    // A corner, or a point 2 cm from a block, sees of the nearest patch less than all of it.
    expectAsRandomWalksSay(*scene, solved->solution, blocks, blocks ? 0.05 : 0.03);
}

// Relative differences of two pictures of the box, lamp and its edges left out: of each pixel, of
// blocks of 4 × 4, whose noise is a quarter, and of the whole.
struct Apart {
    double pixels, blocks, whole;
};

Apart apart(const Image& picture, const Film& film) {
    const int size = film.width(), blocks = size / 4;
    const auto truthAt = [&](int x, int y) {
        return film.at(x, y).sum / static_cast<double>(film.at(x, y).samples);
    };
    const auto seesLamp = [&](int x, int y) {
        for (int dy = -1; dy <= 1; ++dy)
            for (int dx = -1; dx <= 1; ++dx)
                if (truthAt(std::clamp(x + dx, 0, size - 1), std::clamp(y + dy, 0, size - 1)).y >
                    0.1)
                    return true;
        return false;
    };
    double square = 0.0, sum = 0.0, difference = 0.0, count = 0.0;
    std::vector<double> blockSums(static_cast<std::size_t>(blocks * blocks), 0.0);
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            if (seesLamp(x, y))
                continue;
            const glm::dvec3 truth = truthAt(x, y);
            const float* drawn = picture.f32().data() + 4 * (y * size + x);
            for (int c = 0; c < 3; ++c) {
                const double d = drawn[c] - truth[c];
                square += d * d;
                difference += d;
                sum += truth[c];
                count += 1.0;
                blockSums[static_cast<std::size_t>(y / 4 * blocks + x / 4)] += d / 48.0;
            }
        }
    const double mean = sum / count;
    double blockSquare = 0.0;
    for (const double block : blockSums)
        blockSquare += block * block;
    return {std::sqrt(square / count) / mean,
            std::sqrt(blockSquare / static_cast<double>(blockSums.size())) / mean,
            std::abs(difference) / sum};
}

// Pictures of the box with its blocks against that of paths: the same light, seen the same way.
TEST(CornellBoxPicture, IsThatOfPaths) {
    const auto scene = divided(cornellBox(kCornellWalls[0], true), {0.035}, {64, 1, false});
    const auto factors = scene->factors({FactorMethod::Rays, 1024, 1});
    const auto solved = solve(scene->problem(), *factors, {}, {});
    ASSERT_TRUE(solved);
    const SeenSolution seen(scene->scene, scene->elements, scene->lit, solved->solution);
    TraceView view;
    view.width = view.height = 32;
    view.camera.target = {0.278f, 0.2744f, 0.2796f};
    view.camera.yawDeg = 180.0f;
    view.camera.pitchDeg = 0.0f;
    view.camera.distance = 1.08f;
    view.camera.fovDeg = 39.3077f;
    Film film(view.width, view.height);
    ASSERT_TRUE(tracePaths(scene->scene, view, {}, film, 0, 1024, {}));
    const auto look = [&](const PictureSettings& settings) {
        const auto picture = seen.picture(view, settings, {});
        EXPECT_TRUE(picture);
        return apart(*picture, film);
    };
    const Apart gathered = look({Look::Gathered, 16, 64, 3}),
                smooth = look({Look::Smooth, 64, 1, 3}), flat = look({Look::Elements, 64, 1, 3});
    EXPECT_LT(gathered.blocks, 0.01);
    EXPECT_LT(gathered.whole, 0.002);
    EXPECT_LT(smooth.pixels, 0.04) << "paths of 1024 samples have noise, too";
    EXPECT_LT(smooth.blocks, 0.02);
    EXPECT_LT(smooth.whole, 0.002);
    EXPECT_LT(smooth.pixels, flat.pixels);
    EXPECT_LT(flat.whole, 0.003);
}

// From above, a ceiling is not there: its back only absorbs, and hides nothing from a camera.
TEST(RadiosityPicture, LooksThroughBacksAsAllPicturesDo) {
    const auto scene = divided(sceneOf(unitCube(0.5f)), {0.5}, {64, 1, false});
    const auto factors = scene->factors({});
    const auto solved = solve(scene->problem(), *factors, {}, {});
    ASSERT_TRUE(solved);
    const SeenSolution seen(scene->scene, scene->elements, scene->lit, solved->solution);
    TraceView view;
    view.width = view.height = 5;
    view.camera.target = glm::vec3(0.5f);
    view.camera.yawDeg = view.camera.pitchDeg = 0.0f;
    view.camera.distance = 3.0f;
    view.transparent = true;
    const auto picture = seen.picture(view, {Look::Elements}, {});
    ASSERT_TRUE(picture);
    const float* middle = picture->f32().data() + 4 * 12;
    EXPECT_EQ(middle[3], 1.0f);
    EXPECT_GT(middle[0], 0.01f) << "the wall across, by way of the back of the nearer one";
}

// All rows of form factors, computed once.
class KeptRows : public FormFactors {
  public:
    KeptRows(const FormFactors& factors, std::size_t senders) {
        auto computed = FactorMatrix::compute(factors, senders, 0, {});
        EXPECT_TRUE(computed);
        m_rows = *std::move(computed);
    }
    void row(std::uint32_t sender, FactorRow& row) const override { row = m_rows.whole(sender); }

  private:
    FactorMatrix m_rows;
};

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
    std::array<std::array<double, 2>, 2> errors{}; // [bright][fine]
    for (const bool fine : {false, true}) {
        // Form factors are of the division alone: both reflectances have the same.
        const auto division = divided(sceneOf(unitCube(0.5f)), {fine ? 0.067 : 0.26});
        const KeptRows factors(*division->factors({FactorMethod::Analytic, 1, 0}),
                               division->elements.size());
        for (const bool bright : {false, true}) {
            const auto scene = divided(sceneOf(unitCube(bright ? 0.8f : 0.5f)),
                                       {fine ? 0.067 : 0.26}, {64, 0, false});
            ASSERT_EQ(scene->elements.size(), division->elements.size());
            SolveSettings settings;
            settings.residual = 1e-6;
            const auto solved = solve(scene->problem(), factors, settings, {});
            ASSERT_TRUE(solved);
            const SmoothLight light(*scene, solved->solution);
            for (const Place& place : places) {
                const double truth = bright ? place.eighty : place.half;
                const double error = std::abs(light.at(place.position, place.normal).y / truth - 1);
                errors[bright][fine] = std::max(errors[bright][fine], error);
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
    }
    for (const auto& [coarse, fine] : errors) {
        EXPECT_LT(fine, 0.01);
        EXPECT_LT(fine, 0.5 * coarse);
    }
}

std::string
nameOfBox(const ::testing::TestParamInfo<std::tuple<FactorMethod, Solver, bool>>& test) {
    return std::string(name(std::get<0>(test.param))) + "_" +
           std::string(name(std::get<1>(test.param))) +
           (std::get<2>(test.param) ? "_blocks" : "_empty");
}

INSTANTIATE_TEST_SUITE_P(
    Radiosity, CornellBoxOfPatches,
    ::testing::Values(std::tuple(FactorMethod::Rays, Solver::Progressive, false),
                      std::tuple(FactorMethod::Rays, Solver::Overshooting, true),
                      std::tuple(FactorMethod::Hemicube, Solver::Progressive, false),
                      std::tuple(FactorMethod::Analytic, Solver::Southwell, false)),
    nameOfBox);
INSTANTIATE_TEST_SUITE_P(
    Radiosity, CornellBox,
    ::testing::Values(std::tuple(FactorMethod::Rays, Solver::GaussSeidel, false),
                      std::tuple(FactorMethod::Rays, Solver::Progressive, false),
                      std::tuple(FactorMethod::Rays, Solver::GaussSeidel, true),
                      std::tuple(FactorMethod::Hemicube, Solver::Jacobi, false),
                      std::tuple(FactorMethod::Hemicube, Solver::Overshooting, false),
                      std::tuple(FactorMethod::Paraboloid, Solver::GaussSeidel, false),
                      std::tuple(FactorMethod::Analytic, Solver::Southwell, false),
                      std::tuple(FactorMethod::Analytic, Solver::Direct, false)),
    nameOfBox);

} // namespace
} // namespace patina::test
