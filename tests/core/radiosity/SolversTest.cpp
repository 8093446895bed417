// Solutions of the equation of radiosity that are known in closed form, by every solver.
// radiosity.* of the table of exact values that the numbers are from.
#include "core/job/Parallel.h"
#include "core/math/Sampling.h"
#include "core/radiosity/DirectSolution.h"
#include "core/radiosity/Gathering.h"
#include "core/radiosity/Shooting.h"
#include "core/radiosity/Solve.h"
#include "tests/core/radiosity/RadiosityScenes.h"

#include <array>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <numbers>
#include <string>

namespace patina::test {

using namespace radiosity;

namespace {

std::vector<FactorRow> cubeRows() {
    std::vector<FactorRow> rows(6);
    for (std::uint32_t e = 0; e < 6; ++e)
        for (std::uint32_t other = 0; other < 6; ++other)
            if (other != e)
                rows[e].shares.push_back(
                    {other, static_cast<float>(other == (e ^ 1) ? kOpposite : kAdjacent)});
    return rows;
}

Problem cubeProblem(const std::array<double, 6>& reflectance) {
    Problem problem;
    for (std::size_t e = 0; e < 6; ++e) {
        problem.areas.push_back(1.0);
        problem.reflectance.emplace_back(reflectance[e]);
        problem.emission.emplace_back(e == 0 ? 1.0 : 0.0);
    }
    return problem;
}

// A way to solve a problem whose rows say where light arrives.
struct Solver {
    const char* name;
    std::function<Solution(const Problem&, const std::vector<FactorRow>&)> solve;
};

Solution shootAll(const Problem& problem, const std::vector<FactorRow>& rows, ShootingRule rule,
                  bool overshoot) {
    Shooting shooting(problem, rule, overshoot);
    for (int shot = 0; shot < 200'000 && shooting.residual() > 1e-9; ++shot)
        for (const std::uint32_t e : shooting.next(1))
            shooting.shoot(e, rows[e]);
    return shooting.solution();
}

Solution gatherAll(const Problem& problem, const std::vector<FactorRow>& rows, Sweep sweep) {
    const FactorMatrix factors = FactorMatrix::fromRows(rows).reversed(problem.areas);
    Gathering gathering(problem, factors, sweep);
    for (int i = 0; i < 10'000 && (i == 0 || gathering.residual({}) > 1e-10); ++i)
        gathering.sweep({});
    return gathering.solution();
}

const std::array<Solver, 6> kSolvers{{
    {"progressive",
     [](const Problem& problem, const std::vector<FactorRow>& rows) {
         return shootAll(problem, rows, ShootingRule::Power, false);
     }},
    {"southwell",
     [](const Problem& problem, const std::vector<FactorRow>& rows) {
         return shootAll(problem, rows, ShootingRule::Residual, false);
     }},
    {"overshooting",
     [](const Problem& problem, const std::vector<FactorRow>& rows) {
         return shootAll(problem, rows, ShootingRule::Power, true);
     }},
    {"jacobi",
     [](const Problem& problem, const std::vector<FactorRow>& rows) {
         return gatherAll(problem, rows, Sweep::Jacobi);
     }},
    {"gaussSeidel",
     [](const Problem& problem, const std::vector<FactorRow>& rows) {
         return gatherAll(problem, rows, Sweep::GaussSeidel);
     }},
    {"direct",
     [](const Problem& problem, const std::vector<FactorRow>& rows) {
         return *directSolution(problem, FactorMatrix::fromRows(rows).reversed(problem.areas), {});
     }},
}};

class EverySolver : public ::testing::TestWithParam<Solver> {
  protected:
    [[nodiscard]] Solution solve(const Problem& problem, const std::vector<FactorRow>& rows) const {
        return GetParam().solve(problem, rows);
    }
};

TEST_P(EverySolver, LightsACubeOfSixPatches) {
    struct Case {
        double rho, ceiling, floor, wall;
    };
    for (const Case& k : {Case{0.25, 1.01587301794, 0.063452357715, 0.063501989419},
                          Case{0.5, 1.09090909811, 0.181745826108, 0.181836268946},
                          Case{0.75, 1.391304362, 0.521639830261, 0.521763951935},
                          Case{0.9, 2.37288137483, 1.52531055112, 1.52545201851}}) {
        std::array<double, 6> rho{};
        rho.fill(k.rho);
        const Problem problem = cubeProblem(rho);
        const Solution solution = solve(problem, cubeRows());
        double absorbed = 0.0;
        for (std::size_t e = 0; e < 6; ++e) {
            const double truth = e == 0 ? k.ceiling : (e == 1 ? k.floor : k.wall);
            EXPECT_NEAR(solution.radiosity[e].x, truth, 2e-6) << k.rho << " " << e;
            EXPECT_EQ(solution.radiosity[e].x, solution.radiosity[e].z);
            absorbed += (1.0 - k.rho) * solution.irradiance[e].y;
        }
        EXPECT_NEAR(absorbed, 1.0, 2e-6) << "all that is emitted";
    }
}

TEST_P(EverySolver, LightsACubeOfUnequalWalls) {
    const Problem problem = cubeProblem({0.78, 0.5, 0.63, 0.14, 0.7, 0.7});
    const std::array<double, 6> truth{1.16484865569,  0.201884337416, 0.248634710512,
                                      0.060514900879, 0.272838926087, 0.272838926087};
    const Solution solution = solve(problem, cubeRows());
    for (std::size_t e = 0; e < 6; ++e)
        EXPECT_NEAR(solution.radiosity[e].x, truth[e], 2e-6) << e;
}

TEST_P(EverySolver, LightsTwoInfinitePlatesAndConcentricSpheres) {
    Problem plates;
    plates.areas = {1.0, 1.0};
    plates.reflectance = {glm::dvec3(0.5), glm::dvec3(0.8)};
    plates.emission = {glm::dvec3(1.0), glm::dvec3(0.0)};
    std::vector<FactorRow> rows(2);
    rows[0].shares = {{1, 1.0f}};
    rows[1].shares = {{0, 1.0f}};
    Solution solution = solve(plates, rows);
    EXPECT_NEAR(solution.radiosity[0].x, 1.66666666667, 1e-6);
    EXPECT_NEAR(solution.radiosity[1].x, 1.33333333333, 1e-6);

    // Radii 1 and 2: the outer one sees itself, too.
    Problem spheres;
    spheres.areas = {1.0, 4.0};
    spheres.reflectance = {glm::dvec3(0.3), glm::dvec3(0.6)};
    spheres.emission = {glm::dvec3(1.0), glm::dvec3(0.0)};
    rows[1].shares = {{0, 0.25f}, {1, 0.75f}};
    solution = solve(spheres, rows);
    EXPECT_NEAR(solution.radiosity[0].x, 1.08910891089, 1e-5);
    EXPECT_NEAR(solution.radiosity[1].x, 0.29702970297, 1e-5);
}

TEST_P(EverySolver, AgreesWithAllOthersOnTheSameRows) {
    // Rows of few rays: far from reciprocal, and neither symmetric nor exactly closed.
    std::vector<Wall> walls = unitCube(0.6f);
    walls[2].reflectance = {0.8f, 0.1f, 0.3f};
    const auto scene = divided(sceneOf(walls), {0.34});
    const auto factors = scene->factors({FactorMethod::Rays, 64, 5});
    std::vector<FactorRow> rows(scene->elements.size());
    for (std::uint32_t e = 0; e < rows.size(); ++e)
        factors->row(e, rows[e]);
    const Solution exact = kSolvers.back().solve(scene->problem(), rows);
    const Solution solution = solve(scene->problem(), rows);
    for (std::size_t e = 0; e < rows.size(); ++e)
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(solution.radiosity[e][c], exact.radiosity[e][c], 1e-6) << e;
            EXPECT_NEAR(solution.irradiance[e][c], exact.irradiance[e][c], 1e-6) << e;
        }
}

TEST_P(EverySolver, FillsAnEnclosureEvenly) {
    // Every wall glows alike: B = e / (1 - ρ), whatever the factors are, so long as they are
    // closed.
    for (const auto& [rho, truth] :
         {std::pair(0.2f, 1.25), {0.5f, 2.0}, {0.8f, 5.0}, {0.95f, 20.0}}) {
        std::vector<Wall> walls = unitCube(rho);
        for (Wall& wall : walls)
            wall.emission = 1.0f;
        const auto scene = divided(sceneOf(walls), {});
        std::vector<FactorRow> rows(6);
        const auto factors = scene->factors({FactorMethod::Analytic, 4, 0});
        for (std::uint32_t e = 0; e < 6; ++e)
            factors->row(e, rows[e]);
        const Solution solution = solve(scene->problem(), rows);
        for (const glm::dvec3& B : solution.radiosity)
            EXPECT_NEAR(B.y, truth, 1e-5 * truth) << rho;
    }
}

INSTANTIATE_TEST_SUITE_P(Radiosity, EverySolver, ::testing::ValuesIn(kSolvers),
                         [](const auto& test) { return std::string(test.param.name); });

TEST(Shooting, TakesTheShotsOfTheTextbookInTheirOrder) {
    struct Shot {
        std::uint32_t face;
        std::array<double, 6> radiosity;
        double unshot;
    };
    const std::array<Shot, 6> truth{{
        {0,
         {1.0, 0.0999124478492, 0.100021888038, 0.100021888038, 0.100021888038, 0.100021888038},
         0.5},
        {2,
         {1.01000437809, 0.109916825936, 0.100021888038, 0.11001531971, 0.110026266124,
          0.110026266124},
         0.449989055981},
        {4,
         {1.02100941296, 0.120921860807, 0.111026922909, 0.121020354582, 0.110026266124,
          0.121019259701},
         0.394975922919},
        {3,
         {1.03311409731, 0.133026545164, 0.123118362775, 0.121020354582, 0.122130950481,
          0.133123944057},
         0.334465745628},
        {5,
         {1.04642940554, 0.146341853391, 0.136433671003, 0.134335662809, 0.135431689599,
          0.133123944057},
         0.2679037736},
        {1,
         {1.06105077834, 0.146341853391, 0.151071059478, 0.148973051284, 0.150069078074,
          0.147761332532},
         0.194732846904},
    }};
    const Problem problem = cubeProblem({0.5, 0.5, 0.5, 0.5, 0.5, 0.5});
    const std::vector<FactorRow> rows = cubeRows();
    // All faces are alike, so that both rules choose the same.
    for (const ShootingRule rule : {ShootingRule::Power, ShootingRule::Residual}) {
        Shooting shooting(problem, rule, false);
        for (const Shot& shot : truth) {
            const std::vector<std::uint32_t> next = shooting.next(1);
            ASSERT_EQ(next, std::vector<std::uint32_t>{shot.face});
            shooting.shoot(next[0], rows[next[0]]);
            double unshot = 0.0;
            for (std::uint32_t e = 0; e < 6; ++e) {
                EXPECT_NEAR(shooting.radiosity(e).x, shot.radiosity[e], 1e-7) << e;
                unshot += shooting.unshot(e).x;
            }
            EXPECT_NEAR(unshot, shot.unshot, 1e-6);
            EXPECT_NEAR(shooting.residual(), shot.unshot, 1e-6);
        }
    }
    // As the command and the editor solve, with room for all rows and for none.
    struct Factors : FormFactors {
        std::vector<FactorRow> rows = cubeRows();
        void row(std::uint32_t sender, FactorRow& row) const override { row = rows[sender]; }
    };
    for (const auto solver : {radiosity::Solver::Progressive, radiosity::Solver::Southwell})
        for (const std::size_t maxBytes : {std::size_t{0}, std::size_t{1}}) {
            SolveSettings settings;
            settings.solver = solver;
            settings.maxIterations = truth.size();
            settings.residual = 1e-9;
            settings.maxBytes = maxBytes;
            std::size_t seen = 0;
            const auto solved = radiosity::solve(
                problem, Factors(), settings, {},
                [&](std::uint64_t shots, double residual, const auto& solution) {
                    EXPECT_EQ(shots, seen + 1);
                    EXPECT_NEAR(residual, truth[seen].unshot, 1e-6);
                    for (std::size_t e = 0; e < 6; ++e)
                        EXPECT_NEAR(solution().radiosity[e].x, truth[seen].radiosity[e], 1e-7)
                            << name(solver) << ", shot " << shots;
                    ++seen;
                    return true;
                });
            ASSERT_TRUE(solved) << solved.error().text();
            EXPECT_EQ(seen, truth.size());
        }
}

// What a sender would shoot is kept from shot to shot: it is what a fresh look finds.
TEST(Shooting, RemembersWhatEachWouldShoot) {
    const auto scene = divided(sceneOf(unitCube(0.7f)), {0.05});
    const auto factors = scene->factors({FactorMethod::Rays, 16, 0});
    const Problem problem = scene->problem();
    for (const ShootingRule rule : {ShootingRule::Power, ShootingRule::Residual}) {
        Shooting shooting(problem, rule, false);
        FactorRow row;
        for (int shot = 0; shot < 200; ++shot) {
            const Shooting fresh(problem, rule, false, shooting.state());
            ASSERT_EQ(shooting.next(9), fresh.next(9)) << shot;
            ASSERT_DOUBLE_EQ(shooting.residual(), fresh.residual()) << shot;
            const std::uint32_t next = shooting.next(1).at(0);
            factors->row(next, row);
            shooting.shoot(next, row);
        }
    }
}

TEST(Shooting, KnowsWhereAllOfTheLightIs) {
    // An open box: some leaves it.
    std::vector<Wall> walls = unitCube(0.7f);
    walls.pop_back();
    const auto scene = divided(sceneOf(walls), {0.34});
    const auto factors = scene->factors({});
    Shooting shooting(scene->problem(), ShootingRule::Power, false);
    FactorRow row;
    double before = 1.0;
    for (int shot = 0; shot < 100; ++shot) {
        const std::uint32_t e = shooting.next(1).at(0);
        factors->row(e, row);
        shooting.shoot(e, row);
        const Shooting::Energy energy = shooting.energy();
        EXPECT_NEAR(energy.absorbed + energy.lost + energy.unshot, energy.emitted,
                    1e-6 * energy.emitted);
    }
    EXPECT_GT(shooting.energy().lost, 0.1);
    EXPECT_LT(shooting.residual(), before);
}

TEST(Shooting, OfManyAtATimeTakesTheLargestAndOfEqualsTheFirst) {
    Problem problem = cubeProblem({0.5, 0.5, 0.5, 0.5, 0.5, 0.5});
    problem.emission = {glm::dvec3(1), glm::dvec3(3), glm::dvec3(2),
                        glm::dvec3(3), glm::dvec3(0), glm::dvec3(2)};
    problem.areas[0] = 10.0;
    const Shooting byPower(problem, ShootingRule::Power, false);
    EXPECT_EQ(byPower.next(4), (std::vector<std::uint32_t>{0, 1, 3, 2}));
    const Shooting byResidual(problem, ShootingRule::Residual, false);
    EXPECT_EQ(byResidual.next(9), (std::vector<std::uint32_t>{1, 3, 2, 5, 0})) << "4 has nothing";
}

TEST(Shooting, AheadTakesFewerShotsInABrightRoom) {
    const auto scene = divided(sceneOf(unitCube(0.9f)), {0.25});
    const auto factors = scene->factors({FactorMethod::Analytic, 4, 0});
    std::array<std::uint64_t, 2> shots{};
    FactorRow row;
    for (const bool ahead : {false, true}) {
        Shooting shooting(scene->problem(), ShootingRule::Power, ahead);
        while (shooting.residual() > 0.02)
            for (const std::uint32_t e : shooting.next(1)) {
                factors->row(e, row);
                shooting.shoot(e, row);
            }
        shots[ahead] = shooting.shots();
    }
    EXPECT_LT(shots[1], 0.8 * static_cast<double>(shots[0]))
        << shots[1] << " instead of " << shots[0];
}

TEST(Gathering, IsTheSameOnAnyNumberOfThreads) {
    const auto scene = divided(sceneOf(unitCube(0.6f)), {0.05});
    const auto factors = scene->factors({FactorMethod::Rays, 16, 0});
    const auto matrix = FactorMatrix::compute(*factors, scene->elements.size(), 0, {});
    ASSERT_TRUE(matrix);
    std::vector<Solution> solutions;
    for (const int threads : {1, 2, 7}) {
        const ThreadLimit limit(threads);
        Gathering gathering(scene->problem(), *matrix, Sweep::Jacobi);
        for (int i = 0; i < 3; ++i)
            gathering.sweep({});
        solutions.push_back(gathering.solution());
    }
    EXPECT_EQ(solutions[0].radiosity, solutions[1].radiosity);
    EXPECT_EQ(solutions[0].radiosity, solutions[2].radiosity);
}

// A floor under an even sky, and all that is bright is below it: rays to what is bright find
// nothing, rays as the surface reflects do.
TEST(SceneProblem, KnowsASkyThatIsBrightElsewhere) {
    TraceInputs inputs =
        sceneOf({Wall{{{{-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}}}, glm::vec3(0.5f), 0.0f}});
    Image image(64, 32, 3, PixelType::F32, ColorEncoding::Linear);
    for (std::size_t y = 0; y < 32; ++y)
        for (std::size_t k = 0; k < 64 * 3; ++k)
            image.f32()[y * 64 * 3 + k] = y < 16 ? 1.0f : 200.0f;
    // The lookup spreads what is below over the horizon.
    for (std::size_t k = 0; k < 64 * 3; ++k)
        image.f32()[16 * 64 * 3 + k] = 1.0f;
    inputs.environments = {{std::make_shared<const Image>(image), 0.0f, glm::vec3(1.0f)}};
    const auto scene = divided(inputs, {0.5});
    for (const glm::dvec3& light : scene->lit.direct)
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(light[c], std::numbers::pi, 0.01 * std::numbers::pi);
}

// A sphere, a low disc and a rectangle over a floor.
std::array<Light, 3> lightsWithExtent() {
    Light sphere, disc, rectangle;
    sphere.type = LightType::Sphere;
    sphere.position = {0.3f, 0.6f, -0.2f};
    sphere.radius = 0.3f;
    disc.type = LightType::Directional;
    disc.elevationDeg = 2.0f; // a part of it is below the horizon
    disc.castsShadow = true;
    disc.shadowSoftness = 10.0f;
    rectangle.type = LightType::Rectangle;
    rectangle.position = {-0.4f, 0.5f, 0.1f};
    rectangle.width = 0.8f;
    rectangle.height = 0.5f;
    rectangle.elevationDeg = 60.0f;
    return {sphere, disc, rectangle};
}

Wall widePlane() {
    return {{{{-2, 0, 2}, {2, 0, 2}, {2, 0, -2}, {-2, 0, -2}}}, glm::vec3(0.5f), 0.0f};
}

// The closed forms against rays to all of the light.
TEST(LightSampler, IrradianceIsWhatItsRaysBring) {
    const std::array<Light, 3> lights = lightsWithExtent();
    const LightSampler sampler(lights);
    const glm::vec3 points[] = {
        {0, 0, 0}, {1.3f, 0, -0.8f}, {-0.9f, 0.1f, 0.7f}, {0.3f, 0.35f, -0.2f}};
    const glm::vec3 normals[] = {{0, 1, 0}, glm::normalize(glm::vec3(1, 1, 0.3f)), {-1, 0, 0}};
    for (std::size_t light = 0; light < lights.size(); ++light)
        for (const glm::vec3& point : points)
            for (const glm::vec3& normal : normals) {
                double sum = 0.0;
                constexpr std::uint32_t kRays = 1 << 16;
                for (std::uint32_t i = 0; i < kRays; ++i) {
                    const LightSample sample = sampler.sample(light, point, sobolOwen2D(i, 3));
                    if (sample.pdf > 0.0f)
                        sum += double{sample.light.x} *
                               std::max(double{glm::dot(normal, sample.direction)}, 0.0) /
                               double{sample.pdf};
                }
                const double exact = double{sampler.irradiance(light, point, normal).x};
                EXPECT_NEAR(exact, sum / kRays, 2e-3 * exact + 1e-4) << light;
            }
}

// By default settings. The mean over each element of what arrives at its points is known.
TEST(SceneProblem, LightsWithExtentArriveWithoutNoise) {
    for (Light light : lightsWithExtent()) {
        TraceInputs inputs = sceneOf({widePlane()});
        light.id = 7;
        inputs.lights = {light};
        const auto scene = divided(inputs, {.maxArea = 0.02}, {});
        const LightSampler& lights = scene->scene.lights();
        std::vector<double> means;
        double sum = 0.0;
        for (std::uint32_t e = 0; e < scene->elements.size(); ++e) {
            constexpr int kSide = 24;
            double mean = 0.0;
            for (int i = 0; i < kSide * kSide; ++i) {
                const glm::vec2 at((static_cast<float>(i % kSide) + 0.5f) / kSide,
                                   (static_cast<float>(i / kSide) + 0.5f) / kSide);
                const glm::vec3 point =
                    scene->scene.toWorld(glm::vec3(scene->elements.samplePosition(e, at)));
                mean += double{lights.irradiance(0, point, {0, 1, 0}).x};
            }
            means.push_back(mean / (kSide * kSide));
            sum += means.back();
        }
        const auto count = static_cast<double>(means.size());
        double squares = 0.0, most = 0.0;
        for (std::size_t e = 0; e < means.size(); ++e) {
            const double error = scene->lit.direct[e].x - means[e];
            squares += error * error;
            most = std::max(most, std::abs(error) / (means[e] + 0.05 * sum / count));
        }
        EXPECT_LT(std::sqrt(squares / count) / (sum / count), 0.005)
            << static_cast<int>(light.type);
        EXPECT_LT(most, 0.02) << static_cast<int>(light.type);
    }
}

// The closed form against rays as the path tracer chooses them, and a half that is hidden.
TEST(SceneProblem, ShadowsOfLightsWithExtentStayRight) {
    const Wall screen{
        {{{0, 0.1f, 1}, {0, 1.5f, 1}, {0, 1.5f, -1}, {0, 0.1f, -1}}}, glm::vec3(0.0f), 0.0f, true};
    Light sphere;
    sphere.id = 7;
    sphere.type = LightType::Sphere;
    sphere.position = {0.7f, 0.8f, 0.0f};
    sphere.radius = 0.25f;
    TraceInputs inputs = sceneOf({widePlane(), screen});
    inputs.lights = {sphere};
    const auto few = divided(inputs, {.maxArea = 0.05}, {.lightSamples = 64});
    const auto many = divided(inputs, {.maxArea = 0.05}, {.lightSamples = 16384, .seed = 5});
    double squares = 0.0, sum = 0.0;
    int dark = 0;
    for (std::uint32_t e = 0; e < few->elements.size(); ++e) {
        const double error = few->lit.direct[e].x - many->lit.direct[e].x;
        squares += error * error;
        sum += many->lit.direct[e].x;
        dark += many->lit.direct[e].x == 0.0 ? 1 : 0;
    }
    const auto count = static_cast<double>(few->elements.size());
    EXPECT_GT(dark, 10) << "behind the screen";
    EXPECT_LT(std::sqrt(squares / count) / (sum / count), 0.01);
}

TEST(DirectSolution, RefusesWhatHasNone) {
    Problem problem = cubeProblem({1, 1, 1, 1, 1, 1});
    std::vector<FactorRow> rows(6);
    for (std::uint32_t e = 0; e < 6; ++e)
        rows[e].shares = {{e ^ 1, 1.0f}};
    const auto solution = directSolution(problem, FactorMatrix::fromRows(rows), {});
    ASSERT_FALSE(solution);
    EXPECT_NE(solution.error().message.find("darker"), std::string::npos);

    problem.areas.resize(kMaxDirect + 1);
    const auto tooMany = directSolution(problem, {}, {});
    ASSERT_FALSE(tooMany);
    EXPECT_EQ(tooMany.error().kind, ErrorKind::Usage);
}

} // namespace
} // namespace patina::test
