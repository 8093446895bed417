// What tells where elements are too coarse, and division while light is shot.
#include "core/radiosity/Subdivision.h"
#include "core/job/Parallel.h"
#include "core/radiosity/Solve.h"
#include "core/radiosity/document/LitDocument.h"
#include "tests/core/radiosity/RadiosityScenes.h"
#include "tests/core/trace/CornellScene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <set>
#include <string>
#include <vector>

namespace patina::test {

using namespace radiosity;

namespace {

constexpr int kCells = 16; // along an edge of the floor
constexpr double kEdge = 1.0 / kCells;

Wall floorWall() {
    return {{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}}, glm::vec3(0.5f)};
}

glm::dvec3 centreOf(const DividedScene& scene, std::uint32_t element) { // world, metres
    return scene.scene.toWorld(glm::vec3(scene.elements.centre(element)));
}

// The unit floor, lit as told, and which of its elements are too coarse.
class Floor {
  public:
    explicit Floor(const std::function<double(const glm::dvec3&)>& light)
        : m_scene(divided(sceneOf({floorWall()}), {.maxArea = kEdge * kEdge * 1.001})) {
        EXPECT_EQ(m_scene->elements.size(), std::size_t{kCells * kCells});
        for (std::uint32_t e = 0; e < m_scene->elements.size(); ++e)
            m_scene->lit.direct[e] = glm::dvec3(light(centreOf(*m_scene, e)));
        m_none.irradiance.resize(m_scene->elements.size(), glm::dvec3(0.0));
        m_none.radiosity = m_none.irradiance;
    }
    // Of the elements that have others all around them.
    [[nodiscard]] std::size_t coarse(const DivisionSettings& settings) const {
        const auto found =
            tooCoarse(m_scene->scene, m_scene->elements, m_scene->lit, m_none, {}, settings, {});
        EXPECT_TRUE(found);
        EXPECT_TRUE(std::ranges::is_sorted(*found));
        return static_cast<std::size_t>(std::ranges::count_if(*found, [&](std::uint32_t e) {
            const glm::dvec3 c = centreOf(*m_scene, e);
            return std::min(c.x, c.y) > kEdge && std::max(c.x, c.y) < 1.0 - kEdge;
        }));
    }

  private:
    std::unique_ptr<DividedScene> m_scene;
    Solution m_none;
};

constexpr std::size_t kInner = std::size_t{(kCells - 2) * (kCells - 2)};

} // namespace

TEST(Subdivision, ByGradientDividesASlopeAndByTheNextOrderNot) {
    // By 1 / 16 of it from edge to edge of an element.
    const Floor slope([](const glm::dvec3& p) { return 100.0 + 10.0 * p.x; });
    const double change = 10.0 * kEdge / 105.0;
    EXPECT_EQ(slope.coarse({DivisionRule::Gradient, 0.94 * change}), kInner);
    EXPECT_EQ(slope.coarse({DivisionRule::Gradient, 1.06 * change}), 0u);
    for (const DivisionRule rule : {DivisionRule::L1, DivisionRule::L2, DivisionRule::Linf})
        EXPECT_EQ(slope.coarse({rule, 1e-6, kEdge * kEdge}), 0u) << name(rule);
}

// Of ½ κ (x² + y²) linear interpolation is off by u(x) + u(y), u(x) = ½ κ (h²/4 - x²), about an
// element's middle: κh²/4 at most, κh²/6 in the mean, .1748 κh² as the root of the mean square.
TEST(Subdivision, ByTheNextOrderIsTheErrorOfLinearInterpolation) {
    constexpr double kMean = 1000.0, kBend = 60.0;
    const Floor bowl([](const glm::dvec3& p) {
        const double x = p.x - 0.5, y = p.y - 0.5;
        return kMean + 0.5 * kBend * (x * x + y * y);
    });
    const double error = kBend * kEdge * kEdge / 4.0 / kMean, area = kEdge * kEdge;
    struct Norm {
        DivisionRule rule;
        double ofLargest;                 // the norm of the error over one element
        double unit(double first) const { // of elements that are as large as the first ones
            return rule == DivisionRule::L1   ? kEdge * kEdge / first
                   : rule == DivisionRule::L2 ? kEdge / std::sqrt(first)
                                              : 1.0;
        }
    };
    for (const Norm norm : {Norm{DivisionRule::Linf, 1.0}, Norm{DivisionRule::L1, 4.0 / 6.0},
                            Norm{DivisionRule::L2, 4.0 * 0.1748}})
        for (const double first : {area, 16.0 * area}) {
            const double share = error * norm.ofLargest * norm.unit(first);
            EXPECT_EQ(bowl.coarse({norm.rule, 0.96 * share, first}), kInner) << name(norm.rule);
            EXPECT_EQ(bowl.coarse({norm.rule, 1.04 * share, first}), 0u) << name(norm.rule);
            // What is still to come is more light of which it is a share.
            EXPECT_EQ(bowl.coarse({norm.rule, 0.96 * share, first, glm::dvec3(0.1 * kMean)}), 0u);
        }
}

namespace {

// A square between the floor and a light above its middle, twice as high: it hides [.1, .9]².
std::vector<Wall> shadedFloor() {
    return {
        floorWall(),
        {{{{0.3f, 0.3f, 1}, {0.7f, 0.3f, 1}, {0.7f, 0.7f, 1}, {0.3f, 0.7f, 1}}}, glm::vec3(0.0f)}};
}

struct Place {
    int column, row;
};
Place placeOf(const DividedScene& scene, std::uint32_t e) {
    const glm::dvec3 c = centreOf(scene, e);
    return {static_cast<int>(c.x * kCells), static_cast<int>(c.y * kCells)};
}

} // namespace

TEST(Subdivision, ByVisibilityFindsTheEdgeOfAShadow) {
    TraceInputs inputs = sceneOf(shadedFloor());
    Light light;
    light.type = LightType::Point;
    light.position = {0.5f, 0.5f, 2.0f};
    light.intensity = 100.0f;
    inputs.lights = {light};
    const auto scene = divided(inputs, {.maxArea = kEdge * kEdge * 1.001});
    const ElementMesh& elements = scene->elements;
    const Solution none{std::vector<glm::dvec3>(elements.size(), glm::dvec3(0.0)),
                        std::vector<glm::dvec3>(elements.size(), glm::dvec3(0.0))};
    const auto found = tooCoarse(scene->scene, elements, scene->lit, none, {.glowByFactors = true},
                                 {DivisionRule::Visibility, 0.02}, {});
    ASSERT_TRUE(found);
    const std::set<std::uint32_t> coarse(found->begin(), found->end());
    for (std::uint32_t e = 0; e < elements.size(); ++e) {
        if (elements.face(e).mesh != 0) {
            EXPECT_FALSE(coarse.contains(e)) << "all of the square is lit";
            continue;
        }
        // .1 and .9 lie within the second cell and the last but one.
        const auto [column, row] = placeOf(*scene, e);
        const auto within = [](int i) { return i >= 1 && i <= kCells - 2; };
        const auto atEdge = [](int i) { return i == 1 || i == kCells - 2; };
        EXPECT_EQ(coarse.contains(e),
                  within(column) && within(row) && (atEdge(column) || atEdge(row)))
            << column << " " << row;
    }
}

TEST(Subdivision, ByVisibilityLooksAtWhatElementsSend) {
    std::vector<Wall> walls = shadedFloor();
    walls.push_back({{{{0.45f, 0.45f, 2}, {0.45f, 0.55f, 2}, {0.55f, 0.55f, 2}, {0.55f, 0.45f, 2}}},
                     glm::vec3(0.5f),
                     100.0f});
    const auto scene = divided(sceneOf(walls), {.maxArea = kEdge * kEdge * 1.001});
    const ElementMesh& elements = scene->elements;
    Solution sent;
    sent.radiosity = scene->problem().emission;
    sent.irradiance.resize(elements.size(), glm::dvec3(0.0));
    for (std::uint32_t e = 0; e < elements.size(); ++e) // what is not hidden
        if (elements.face(e).mesh == 0)
            sent.irradiance[e] = glm::dvec3(0.2);
    const auto found = tooCoarse(scene->scene, elements, scene->lit, sent, {.glowByFactors = true},
                                 {DivisionRule::Visibility, 0.05}, {});
    ASSERT_TRUE(found);
    const std::set<std::uint32_t> coarse(found->begin(), found->end());
    for (std::uint32_t e = 0; e < elements.size(); ++e) {
        if (elements.face(e).mesh != 0)
            continue;
        // The penumbra goes from .05 to .15.
        const auto [column, row] = placeOf(*scene, e);
        if (column == 1 && row > 2 && row < kCells - 3) {
            EXPECT_TRUE(coarse.contains(e)) << column << " " << row;
        }
        if (std::min(column, row) > 2 && std::max(column, row) < kCells - 3) {
            EXPECT_FALSE(coarse.contains(e)) << column << " " << row;
        }
    }
}

namespace {

TraceInputs roomWithShelf() {
    std::vector<Wall> walls = unitCube(0.7f);
    walls[2].reflectance = {0.8f, 0.3f, 0.1f};
    walls.push_back(
        {{{{0.2f, 0.2f, 0.4f}, {0.7f, 0.2f, 0.4f}, {0.7f, 0.6f, 0.4f}, {0.2f, 0.6f, 0.4f}}},
         glm::vec3(0.5f),
         0.0f,
         true});
    return sceneOf(walls);
}

RadiositySettings dynamicSettings(radiosity::Solver solver) {
    RadiositySettings settings;
    settings.maxArea = 0.06;
    settings.adaptive = 0.25;
    settings.dynamic = true;
    settings.factors.resolution = 64;
    settings.lightSamples = 16;
    settings.solve.solver = solver;
    settings.solve.residual = 1e-3;
    return settings;
}

double largestDifference(const std::vector<glm::dvec3>& a, const std::vector<glm::dvec3>& b) {
    double largest = 0.0;
    for (std::size_t e = 0; e < a.size(); ++e)
        largest = std::max(largest, magnitude(a[e] - b[e]));
    return largest;
}

} // namespace

// The light that has been shot to coarse elements arrives at the finer ones as if they had been
// there from the beginning.
TEST(DynamicDivision, EndsInTheSolutionOfItsElements) {
    for (const auto solver : {radiosity::Solver::Progressive, radiosity::Solver::Southwell,
                              radiosity::Solver::Overshooting})
        for (const bool classic : {false, true})
            for (const double patchArea : {0.0, 0.1}) {
                if (solver != radiosity::Solver::Progressive && !(classic && patchArea > 0.0))
                    continue;
                RadiositySettings settings = dynamicSettings(solver);
                settings.classic = classic;
                settings.patchArea = patchArea;
                const auto scene = RadiosityScene::make(roomWithShelf(), settings, {});
                ASSERT_TRUE(scene) << scene.error().text();
                const ElementMesh& elements = (*scene)->elements();
                RadiositySettings even = settings;
                even.adaptive = 0.0;
                EXPECT_GT(elements.size(),
                          (*RadiosityScene::divide(roomWithShelf(), even, {}))->elements().size());
                const auto solved = (*scene)->solve(settings, {});
                ASSERT_TRUE(solved) << solved.error().text();
                EXPECT_TRUE(solved->report.converged);
                ASSERT_TRUE(solved->report.energy);
                const Shooting::Energy& energy = *solved->report.energy;
                EXPECT_NEAR((energy.absorbed + energy.lost + energy.unshot) / energy.emitted, 1.0,
                            1e-6);
                const auto factors =
                    makeFormFactors(elements, *(*scene)->scene().rays(), settings.factors);
                ASSERT_TRUE(factors);
                const auto anew = solve((*scene)->lit().problem, **factors, settings.solve, {});
                ASSERT_TRUE(anew);
                EXPECT_LT(largestDifference(solved->solution.radiosity, anew->solution.radiosity),
                          0.03 * anew->report.meanRadiosity)
                    << name(solver) << (classic ? " classic " : " ") << patchArea;
            }
}

// Of light that is still on its way elements differ by more than in the end, so that there are some
// more of them.
TEST(DynamicDivision, DividesNotMuchMoreThanWholeSolutionsDo) {
    for (const DivisionRule rule :
         {DivisionRule::Gradient, DivisionRule::Visibility, DivisionRule::Linf}) {
        RadiositySettings settings = dynamicSettings(radiosity::Solver::Progressive);
        settings.factors.method = FactorMethod::Analytic; // without noise, which divides nothing
        settings.factors.resolution = 4;
        settings.divideBy = rule;
        settings.adaptive = rule == DivisionRule::Linf ? 0.05 : 0.25;
        const auto shot = RadiosityScene::make(roomWithShelf(), settings, {});
        settings.dynamic = false;
        const auto after = RadiosityScene::make(roomWithShelf(), settings, {});
        ASSERT_TRUE(shot && after);
        const auto size = static_cast<double>((*shot)->elements().size());
        const double ratio = size / static_cast<double>((*after)->elements().size());
        EXPECT_GT(ratio, 0.5) << name(rule);
        EXPECT_LT(ratio, 2.5) << name(rule);
    }
}

TEST(DynamicDivision, IsTheSameForAnyNumberOfThreads) {
    const RadiositySettings settings = dynamicSettings(radiosity::Solver::Progressive);
    std::vector<Solved> all;
    for (const int threads : {1, 2, 7}) {
        const ThreadLimit limit(threads);
        const auto scene = RadiosityScene::make(roomWithShelf(), settings, {});
        ASSERT_TRUE(scene);
        auto solved = (*scene)->solve(settings, {});
        ASSERT_TRUE(solved);
        all.push_back(*std::move(solved));
        EXPECT_EQ(all.back().solution.radiosity, all.front().solution.radiosity) << threads;
        EXPECT_EQ(all.back().report.history, all.front().report.history) << threads;
    }
}

TEST(DynamicDivision, RefusesSolversThatDoNotShootAndTooManyElements) {
    for (const auto solver : {radiosity::Solver::GaussSeidel, radiosity::Solver::Jacobi,
                              radiosity::Solver::Direct, radiosity::Solver::Hierarchical}) {
        const auto scene = RadiosityScene::make(roomWithShelf(), dynamicSettings(solver), {});
        ASSERT_FALSE(scene);
        EXPECT_EQ(scene.error().kind, ErrorKind::Usage);
        EXPECT_NE(scene.error().message.find("southwell"), std::string::npos);
    }
    RadiositySettings settings = dynamicSettings(radiosity::Solver::Progressive);
    settings.maxElements = 150;
    const auto scene = RadiosityScene::make(roomWithShelf(), settings, {});
    ASSERT_FALSE(scene);
    EXPECT_EQ(scene.error().kind, ErrorKind::Usage);
}

} // namespace patina::test
