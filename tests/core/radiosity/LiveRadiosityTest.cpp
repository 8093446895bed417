// Radiosity that follows edits: the same as from nothing, at the cost of what was edited.
#include "core/radiosity/document/LiveRadiosity.h"
#include "core/document/Document.h"
#include "core/light/Lights.h"
#include "core/radiosity/document/Convergence.h"
#include "core/radiosity/document/EnergyFlow.h"
#include "core/radiosity/document/RadiositySteps.h"
#include "tests/core/radiosity/RadiosityScenes.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <gtest/gtest.h>

namespace patina::test {

using namespace radiosity;

namespace {

Light sphereLight(Id id, const glm::vec3& position, float radius = 0.1f) {
    Light light;
    light.id = id;
    light.type = LightType::Sphere;
    light.position = position;
    light.radius = radius;
    light.intensity = 20.0f;
    return light;
}

// A unit cube of grey walls, a glowing ceiling and two lights.
TraceInputs room() {
    static const TraceInputs kRoom = [] { // whose meshes are the same ones each time
        std::vector<Wall> walls = unitCube(0.5f);
        walls[0].emission = 0.3f;
        return sceneOf(walls);
    }();
    TraceInputs inputs = kRoom;
    inputs.lights = {sphereLight(101, {0.3f, 0.6f, 0.4f}), sphereLight(102, {0.7f, 0.3f, 0.6f})};
    inputs.lights[1].color = {1.0f, 0.5f, 0.2f};
    return inputs;
}

RadiositySettings coarse() {
    RadiositySettings settings;
    settings.maxArea = 0.02;
    settings.solve.residual = 1e-6;
    settings.lightSamples = 32;
    settings.factors.resolution = 64;
    return settings;
}

LiveRadiosityPtr follow(const TraceInputs& inputs, const LiveRadiosityPtr& before = nullptr,
                        const LiveRadiosityObserver& observer = {},
                        const RadiositySettings& settings = coarse()) {
    const auto live = followRadiosity(inputs, settings, before, {}, observer);
    EXPECT_TRUE(live) << live.error().text();
    EXPECT_TRUE((*live)->solved);
    return *live;
}

// Largest difference of irradiance, by the largest irradiance.
double difference(const LiveRadiosity& a, const LiveRadiosity& b) {
    double most = 0.0, largest = 0.0;
    for (std::uint32_t e = 0; e < a.elements().size(); ++e) {
        const glm::dvec3 x = a.lit.irradiance(a.solution, e), y = b.lit.irradiance(b.solution, e);
        largest = std::max(largest, magnitude(x));
        most = std::max(most, magnitude(x - y));
    }
    return most / largest;
}

TEST(LiveRadiosity, FindsWhatTheSolverFinds) {
    const TraceInputs inputs = room();
    const LiveRadiosityPtr live = follow(inputs);
    const auto scene = RadiosityScene::make(inputs, coarse(), {});
    ASSERT_TRUE(scene);
    const auto solved = (*scene)->solve(coarse(), {});
    ASSERT_TRUE(solved);
    ASSERT_EQ(live->elements().size(), (*scene)->elements().size());
    ASSERT_EQ(live->sources.size(), 3u) << "the ceiling and two lights";
    for (std::uint32_t e = 0; e < live->elements().size(); ++e) {
        const glm::dvec3 expected = (*scene)->lit().irradiance(solved->solution, e);
        EXPECT_LT(magnitude(live->lit.irradiance(live->solution, e) - expected),
                  2e-4 * magnitude(expected));
    }
}

TEST(LiveRadiosity, EverySolverFindsTheSame) {
    const LiveRadiosityPtr gathered = follow(room());
    LiveRadiosityPtr before = gathered;
    for (const Solver solver : {Solver::Jacobi, Solver::Progressive, Solver::Southwell,
                                Solver::Overshooting, Solver::Direct}) {
        RadiositySettings settings = coarse();
        settings.solve.solver = solver;
        std::vector<LiveRadiosityPtr> told;
        const LiveRadiosityPtr live = follow(
            room(), before, [&](const LiveRadiosityPtr& on) { told.push_back(on); }, settings);
        EXPECT_EQ(live->shape, gathered->shape) << name(solver) << " divides nothing anew";
        EXPECT_EQ(live->factors, gathered->factors) << name(solver);
        ASSERT_FALSE(told.empty()) << name(solver) << " solves anew";
        // As on the command line. (Noisy rows are not the same the other way round: what is shot
        // along them differs from what is gathered.)
        const auto scene = RadiosityScene::make(room(), settings, {});
        ASSERT_TRUE(scene);
        const auto solved = (*scene)->solve(settings, {});
        ASSERT_TRUE(solved);
        for (std::uint32_t e = 0; e < live->elements().size(); ++e) {
            const glm::dvec3 expected = (*scene)->lit().irradiance(solved->solution, e);
            EXPECT_LT(magnitude(live->lit.irradiance(live->solution, e) - expected),
                      2e-4 * magnitude(expected))
                << name(solver);
        }
        EXPECT_LT(difference(*live, *gathered), shoots(solver) ? 0.1 : 1e-4) << name(solver);
        EXPECT_GT(live->sweeps, 0) << name(solver);
        before = live;
    }
}

TEST(LiveRadiosity, AnotherMethodKeepsTheElementsAndFindsOtherFactors) {
    const LiveRadiosityPtr rays = follow(room());
    for (const auto& [method, resolution] :
         {std::pair(FactorMethod::Hemicube, 16), std::pair(FactorMethod::Analytic, 2)}) {
        RadiositySettings settings = coarse();
        settings.factors.method = method;
        settings.factors.resolution = resolution;
        const LiveRadiosityPtr live = follow(room(), rays, {}, settings);
        EXPECT_EQ(live->shape, rays->shape) << name(method);
        EXPECT_NE(live->factors, rays->factors) << name(method);
        // As on the command line.
        const LiveRadiosityPtr anew = follow(room(), nullptr, {}, settings);
        EXPECT_LT(difference(*live, *anew), 1e-12) << name(method);
        EXPECT_LT(difference(*live, *rays), 0.1) << name(method);
    }
}

TEST(LiveRadiosity, LinksAreKeptOfEachSourceAndNoRows) {
    RadiositySettings settings = coarse();
    settings.solve.residual = 1e-5;
    settings.solve.solver = Solver::Hierarchical;
    settings.factors.resolution = 1024;
    const LiveRadiosityPtr before = follow(room(), nullptr, {}, settings);
    EXPECT_EQ(before->factors, nullptr);
    for (const RadiositySource& source : before->sources) {
        ASSERT_NE(source.links, nullptr);
        EXPECT_FALSE(source.links->links.empty());
        EXPECT_EQ(source.links->tree, before->sources[0].links->tree) << "one tree for all";
    }
    RadiositySettings gathering = settings;
    gathering.solve.solver = Solver::GaussSeidel;
    EXPECT_LT(difference(*before, *follow(room(), nullptr, {}, gathering)), 0.1);
    // Each source is solved alone: the mixer scales it, and its links stay.
    TraceInputs inputs = room();
    inputs.lights[0].gainEv = 1.0f;
    const LiveRadiosityPtr after = follow(inputs, before, {}, settings);
    for (std::size_t s = 0; s < after->sources.size(); ++s)
        EXPECT_EQ(after->sources[s].links, before->sources[s].links);
    // A colour takes other links, in the same tree or one like it.
    inputs.materials[inputs.meshes[2].material].baseColor = {0.9f, 0.1f, 0.1f};
    const LiveRadiosityPtr colored = follow(inputs, after, {}, settings);
    EXPECT_NE(colored->sources[0].links, after->sources[0].links);
    EXPECT_LT(difference(*colored, *follow(inputs, nullptr, {}, settings)), 1e-6);
}

TEST(LiveRadiosity, TheDirectSolverRefusesBeforeItFindsFormFactors) {
    RadiositySettings settings = coarse();
    settings.maxArea = 0.002;
    settings.solve.solver = Solver::Direct;
    const auto live = followRadiosity(room(), settings, nullptr, {});
    ASSERT_FALSE(live);
    EXPECT_EQ(live.error().kind, ErrorKind::Usage);
    EXPECT_NE(live.error().message.find("2048"), std::string::npos) << live.error().message;
}

TEST(RadiosityStepsRule, StepsShootByTheRuleOfTheSolver) {
    RadiositySettings settings = coarse();
    settings.classic = true;
    for (const Solver solver : {Solver::Progressive, Solver::Southwell, Solver::Overshooting}) {
        settings.solve.solver = solver;
        const LiveRadiosityPtr live = follow(room(), nullptr, {}, settings);
        Shooting shooting(live->lit.problem, shootingRule(solver), solver == Solver::Overshooting);
        RadiositySteps steps(live);
        for (int i = 0; i < 20; ++i) {
            ASSERT_EQ(steps.next(), shooting.next(1).front()) << name(solver);
            shooting.shoot(*steps.next(), live->factors->matrix.whole(*steps.next()));
            steps.goTo(steps.done() + 1);
            EXPECT_EQ(steps.solution().radiosity, shooting.solution().radiosity) << name(solver);
        }
    }
}

TEST(LiveRadiosity, TellsOfTheDirectLightFirst) {
    std::vector<LiveRadiosityPtr> told;
    const LiveRadiosityPtr live =
        follow(room(), nullptr, [&](const LiveRadiosityPtr& picture) { told.push_back(picture); });
    ASSERT_FALSE(told.empty());
    EXPECT_FALSE(told.front()->solved);
    EXPECT_EQ(told.front()->factors, nullptr);
    EXPECT_EQ(told.front()->shape, live->shape) << "meshes are drawn on";
    for (std::uint32_t e = 0; e < live->elements().size(); ++e) {
        EXPECT_EQ(told.front()->lit.irradiance(told.front()->solution, e), live->lit.direct[e]);
        EXPECT_GT(magnitude(live->lit.irradiance(live->solution, e)),
                  magnitude(live->lit.direct[e]));
    }
}

TEST(LiveRadiosity, AnEditedColourKeepsElementsAndFormFactors) {
    const LiveRadiosityPtr before = follow(room());
    TraceInputs inputs = room();
    inputs.materials[inputs.meshes[2].material].baseColor = {0.9f, 0.1f, 0.1f};
    const LiveRadiosityPtr after = follow(inputs, before);
    EXPECT_EQ(after->shape, before->shape);
    EXPECT_EQ(after->factors, before->factors);
    EXPECT_GT(difference(*after, *before), 0.01);
    EXPECT_LT(difference(*after, *follow(inputs)), 1e-12);
    for (std::size_t s = 0; s < after->sources.size(); ++s)
        EXPECT_EQ(after->sources[s].direct, before->sources[s].direct) << "no ray for direct light";
}

TEST(LiveRadiosity, TheMixerScalesWhatIsSolved) {
    const LiveRadiosityPtr before = follow(room());
    TraceInputs inputs = room();
    inputs.lights[0].gainEv = 1.5f;
    inputs.lights[0].tint = {1.0f, 0.4f, 0.3f};
    inputs.lights[1].usesTemperature = true;
    inputs.lights[1].temperatureK = 3000.0f;
    bool told = false;
    const LiveRadiosityPtr after =
        follow(inputs, before, [&](const LiveRadiosityPtr&) { told = true; });
    EXPECT_FALSE(told) << "there is nothing to wait for";
    for (std::size_t s = 0; s < after->sources.size(); ++s)
        EXPECT_EQ(after->sources[s].bounced, before->sources[s].bounced);
    EXPECT_LT(difference(*after, *follow(inputs)), 1e-12);
    EXPECT_GT(difference(*after, *before), 0.1);
}

TEST(LiveRadiosity, ALightThatIsMutedComesBackAsItWas) {
    const LiveRadiosityPtr both = follow(room());
    TraceInputs inputs = room();
    inputs.lights.erase(inputs.lights.begin());
    const LiveRadiosityPtr one = follow(inputs, both);
    ASSERT_EQ(one->sources.size(), 2u);
    ASSERT_EQ(one->switchedOff.size(), 1u);
    EXPECT_LT(difference(*one, *follow(inputs)), 1e-12);
    bool told = false;
    const LiveRadiosityPtr back =
        follow(room(), one, [&](const LiveRadiosityPtr&) { told = true; });
    EXPECT_FALSE(told);
    EXPECT_TRUE(back->switchedOff.empty());
    EXPECT_EQ(difference(*back, *both), 0.0);

    // Recoloured while it was off, everything else stays known.
    inputs.materials[inputs.meshes[2].material].baseColor = glm::vec3(0.1f);
    TraceInputs recoloured = room();
    recoloured.materials = inputs.materials;
    const LiveRadiosityPtr later = follow(recoloured, follow(inputs, one));
    EXPECT_LT(difference(*later, *follow(recoloured)), 1e-12);
}

TEST(LiveRadiosity, OfALightThatMovesOnlyItsOwnIsSolvedAnew) {
    const LiveRadiosityPtr before = follow(room());
    TraceInputs inputs = room();
    inputs.lights[0].position.x = 0.6f;
    const LiveRadiosityPtr after = follow(inputs, before);
    EXPECT_EQ(after->factors, before->factors);
    EXPECT_EQ(after->sources[0].bounced, before->sources[0].bounced);
    EXPECT_NE(after->sources[1].bounced, before->sources[1].bounced);
    EXPECT_EQ(after->sources[2].bounced, before->sources[2].bounced);
    EXPECT_LT(difference(*after, *follow(inputs)), 1e-12);
}

// As where an edit comes while the one before is being solved.
TEST(LiveRadiosity, WhatWasOnItsWayIsSolvedToItsEnd) {
    LiveRadiosity partly = *follow(room());
    for (RadiositySource& source : partly.sources) {
        for (glm::dvec3& light : source.bounced)
            light *= 0.5;
        source.residual = 0.1;
    }
    partly.solved = false;
    TraceInputs inputs = room();
    inputs.lights[0].intensity *= 2.0f;
    const auto before = std::make_shared<const LiveRadiosity>(std::move(partly));
    EXPECT_LT(difference(*follow(inputs, before), *follow(inputs)), 1e-12);
    // A residual that is asked to be smaller is come to, too.
    RadiositySettings exact = coarse();
    exact.solve.residual = 1e-9;
    const LiveRadiosityPtr finer = follow(room(), follow(room()), {}, exact);
    EXPECT_LE(finer->residual, 1e-9);
}

TEST(LiveRadiosity, GlowThatIsEditedIsCollectedAnew) {
    const LiveRadiosityPtr before = follow(room());
    TraceInputs inputs = room();
    inputs.materials[inputs.meshes[0].material].emissive *= 3.0f;
    const LiveRadiosityPtr after = follow(inputs, before);
    EXPECT_EQ(after->shape, before->shape);
    EXPECT_EQ(after->sources[1].direct, before->sources[1].direct);
    EXPECT_LT(difference(*after, *follow(inputs)), 1e-12);
    EXPECT_GT(difference(*after, *before), 0.01);

    RadiositySettings classic = coarse();
    classic.classic = true;
    const LiveRadiosityPtr shot = follow(room(), nullptr, {}, classic);
    EXPECT_LT(difference(*follow(inputs, shot, {}, classic), *follow(inputs, nullptr, {}, classic)),
              1e-12);
}

TEST(LiveRadiosity, OtherShapesSidesOrSettingsBeginAnew) {
    const LiveRadiosityPtr before = follow(room());
    TraceInputs moved = room();
    moved.meshes[1].transform[3].y -= 0.2f;
    TraceInputs sides = room();
    sides.materials[sides.meshes[1].material].doubleSided = true;
    for (const TraceInputs& inputs : {moved, sides}) {
        const LiveRadiosityPtr after = follow(inputs, before);
        EXPECT_NE(after->shape, before->shape);
        EXPECT_EQ(difference(*after, *follow(inputs)), 0.0);
    }
    RadiositySettings finer = coarse();
    finer.maxArea = 0.01;
    EXPECT_GT(follow(room(), before, {}, finer)->elements().size(), before->elements().size());
    finer = coarse();
    finer.adaptive = 0.3;
    EXPECT_GT(follow(room(), before, {}, finer)->elements().size(), before->elements().size());
}

TEST(LiveRadiosity, ManyLightsAreSolvedTogether) {
    TraceInputs inputs = room();
    inputs.lights.clear();
    for (Id i = 0; i < 20; ++i)
        inputs.lights.push_back(
            sphereLight(200 + i, {0.2f + 0.03f * static_cast<float>(i), 0.5f, 0.5f}, 0.02f));
    const LiveRadiosityPtr live = follow(inputs);
    EXPECT_EQ(live->sources.size(), 17u) << "glow, fifteen lights, the rest";
    const auto scene = RadiosityScene::make(inputs, coarse(), {});
    const auto solved = (*scene)->solve(coarse(), {});
    for (std::uint32_t e = 0; e < live->elements().size(); ++e) {
        const glm::dvec3 expected = (*scene)->lit().irradiance(solved->solution, e);
        EXPECT_LT(magnitude(live->lit.irradiance(live->solution, e) - expected),
                  2e-4 * magnitude(expected));
    }
    // The last one is dimmed: its group is solved anew.
    TraceInputs dimmed = inputs;
    dimmed.lights.back().intensity *= 0.5f;
    EXPECT_LT(difference(*follow(dimmed, live), *follow(dimmed)), 1e-12);
}

TEST(LiveRadiosity, WithoutLightEverythingIsBlack) {
    TraceInputs inputs = sceneOf(unitCube(0.5f));
    for (Material& material : inputs.materials)
        material.emissive = glm::vec3(0.0f);
    const LiveRadiosityPtr live = follow(inputs);
    const ShownRadiosityPtr shown = shownRadiosity(*live, live->solution);
    for (const glm::vec3& light : shown->irradiance)
        EXPECT_EQ(light, glm::vec3(0.0f));
    EXPECT_EQ(live->residual, 0.0);
    EXPECT_FALSE(followRadiosity({}, coarse(), nullptr, {})) << "no mesh";
}

TEST(LiveRadiosity, CancellingLeavesNothing) {
    JobControl control;
    control.cancel();
    const auto live = followRadiosity(room(), coarse(), nullptr, control.context());
    ASSERT_FALSE(live);
    EXPECT_EQ(live.error().kind, ErrorKind::Cancelled);
}

TEST(ShownRadiosity, HasANumberForEveryVertexThatIsDrawn) {
    const LiveRadiosityPtr live = follow(room());
    const ShownRadiosityPtr shown = shownRadiosity(*live, live->solution, {}, 3u);
    ASSERT_EQ(shown->elements.size(), live->elements().size());
    std::size_t corners = 0;
    double sum = 0.0, area = 0.0;
    for (const RadiositySurface& surface : shown->shape->surfaces) {
        ASSERT_EQ(surface.lights.size(), surface.mesh->positions.size());
        ASSERT_EQ(surface.elements.size(), surface.mesh->positions.size());
        corners += surface.mesh->positions.size();
        for (std::size_t v = 0; v < surface.lights.size(); ++v) {
            ASSERT_LT(surface.lights[v], shown->irradiance.size());
            ASSERT_LT(surface.elements[v], shown->elements.size());
        }
        for (std::size_t i = 0; i < surface.mesh->indices.size(); i += 3) {
            const std::uint32_t* v = surface.mesh->indices.data() + i;
            EXPECT_EQ(surface.elements[v[0]], surface.elements[v[1]]) << "of one element each";
            EXPECT_EQ(surface.elements[v[0]], surface.elements[v[2]]);
        }
    }
    EXPECT_GE(corners, 3 * live->elements().size());
    for (const ShownRadiosity::Element& element : shown->elements) {
        sum += static_cast<double>(element.share);
        area += static_cast<double>(element.area);
    }
    EXPECT_NEAR(area, 6.0, 1e-5);
    EXPECT_NEAR(sum, 1.0, 1e-5) << "a closed room";
}

TEST(RadiosityStepsTest, GoForthAndBackAndComeToTheSolution) {
    const LiveRadiosityPtr live = follow(room());
    RadiositySteps steps(live);
    EXPECT_EQ(steps.done(), 0u);
    EXPECT_FALSE(steps.last());
    const auto first = steps.next();
    ASSERT_TRUE(first);
    steps.goTo(1);
    EXPECT_EQ(steps.last(), first);
    const Solution one = steps.solution();
    EXPECT_EQ(magnitude(steps.unshot()[*first]), 0.0);
    steps.goTo(50);
    EXPECT_EQ(steps.done(), 50u);
    ASSERT_EQ(steps.residuals().size(), 51u);
    const auto energy = steps.energy();
    ASSERT_TRUE(energy);
    EXPECT_NEAR(energy->absorbed + energy->lost + energy->unshot, energy->emitted,
                1e-6 * energy->emitted);
    steps.goTo(1);
    EXPECT_EQ(steps.solution().radiosity, one.radiosity);
    EXPECT_EQ(steps.residuals().size(), 2u);
    steps.goTo(1'000'000);
    EXPECT_TRUE(steps.atEnd());
    EXPECT_LE(steps.residuals().back(), live->settings.solve.residual);
    // The same rows, used the other way round: they differ by the noise of rays.
    double shot = 0.0, gathered = 0.0;
    const Solution last = steps.solution();
    for (std::uint32_t e = 0; e < live->elements().size(); ++e) {
        shot += live->elements().area(e) * magnitude(last.radiosity[e]);
        gathered += live->elements().area(e) * magnitude(live->solution.radiosity[e]);
    }
    EXPECT_NEAR(shot, gathered, 0.01 * gathered);
}

// After n sweeps of Jacobi light has been reflected n times, as the powers of ρF have it.
TEST(RadiosityStepsTest, ASweepIsAReflection) {
    RadiositySettings settings = coarse();
    settings.solve.solver = Solver::Jacobi;
    const LiveRadiosityPtr live = follow(room(), nullptr, {}, settings);
    const Problem& problem = live->lit.problem;
    RadiositySteps steps(live, RadiosityStep::Sweep);
    EXPECT_FALSE(steps.next()) << "no element is before the others";
    EXPECT_EQ(steps.stepsPerRound(), 1u);
    std::vector<glm::dvec3> bounce = problem.emission, sum = bounce;
    for (std::uint64_t n = 1; n <= 4; ++n) {
        std::vector<glm::dvec3> next(problem.size());
        for (std::uint32_t e = 0; e < problem.size(); ++e) {
            next[e] = problem.reflectance[e] * gathered(live->factors->matrix, e, bounce);
            sum[e] += next[e];
        }
        bounce = next;
        steps.goTo(n);
        EXPECT_EQ(steps.done(), n);
        const Solution light = steps.solution();
        const std::vector<glm::dvec3> added = steps.unshot();
        for (std::uint32_t e = 0; e < problem.size(); ++e) {
            EXPECT_LT(magnitude(light.radiosity[e] - sum[e]), 1e-9 * magnitude(sum[e]) + 1e-12);
            EXPECT_LT(magnitude(added[e] - bounce[e]), 1e-9 * magnitude(sum[e]) + 1e-12);
        }
        const auto energy = steps.energy();
        ASSERT_TRUE(energy);
        EXPECT_NEAR(energy->absorbed + energy->lost + energy->unshot, energy->emitted,
                    1e-9 * energy->emitted);
        double unshot = 0.0;
        for (std::uint32_t e = 0; e < problem.size(); ++e)
            unshot += problem.areas[e] * (bounce[e].x + bounce[e].y + bounce[e].z);
        EXPECT_NEAR(energy->unshot, unshot, 1e-9 * energy->emitted);
    }
    steps.goTo(2);
    EXPECT_EQ(steps.residuals().size(), 3u);
    steps.goTo(1'000);
    EXPECT_TRUE(steps.atEnd());
    EXPECT_LT(steps.done(), 100u);
}

TEST(RadiosityStepsTest, SweepsOfGaussSeidelNeedFewer) {
    RadiositySettings settings = coarse();
    settings.solve.solver = Solver::GaussSeidel;
    const LiveRadiosityPtr live = follow(room(), nullptr, {}, settings);
    RadiositySteps steps(live, RadiosityStep::Sweep);
    steps.goTo(1'000);
    EXPECT_TRUE(steps.atEnd());
    EXPECT_FALSE(steps.energy()) << "what is on its way is not the same for all elements";
    settings.solve.solver = Solver::Jacobi;
    RadiositySteps others(follow(room(), nullptr, {}, settings), RadiosityStep::Sweep);
    others.goTo(1'000);
    EXPECT_LT(steps.done(), others.done());
    JobControl cancelled;
    cancelled.cancel();
    others.goTo(0);
    others.goTo(3, cancelled.context());
    EXPECT_EQ(others.done(), 0u);
}

// The same residuals as solve() has, step after step.
TEST(Convergence, IsThatOfTheSolvers) {
    const LiveRadiosityPtr live = follow(room());
    const Result<std::vector<ConvergenceCurve>> found = convergence(*live, {});
    ASSERT_TRUE(found.ok());
    ASSERT_EQ(found->size(), 4u);
    for (const ConvergenceCurve& curve : *found) {
        SCOPED_TRACE(std::string(name(curve.solver)));
        EXPECT_EQ(curve.points.front().rounds, 0.0);
        EXPECT_LE(curve.points.back().residual, live->settings.solve.residual);
        RadiositySettings settings = live->settings;
        settings.solve.solver = curve.solver;
        LiveRadiosity other = *live;
        other.settings = settings;
        const bool shot = shoots(curve.solver);
        RadiositySteps steps(std::make_shared<const LiveRadiosity>(std::move(other)),
                             shot ? RadiosityStep::Shot : RadiosityStep::Sweep);
        const double perRound = shot ? double(live->elements().size()) : 1.0;
        for (std::size_t i = 0; i < curve.points.size(); i += shot ? 20 : 1) {
            steps.goTo(std::uint64_t(std::lround(curve.points[i].rounds * perRound)));
            EXPECT_EQ(steps.residuals().back(), curve.points[i].residual);
        }
    }
    JobControl cancelled;
    cancelled.cancel();
    EXPECT_EQ(convergence(*live, cancelled.context()).error().kind, ErrorKind::Cancelled);
}

TEST(EnergyFlow, AddsUpToWhatArrivesAndLeaves) {
    const LiveRadiosityPtr live = follow(room());
    const auto element = static_cast<std::uint32_t>(live->elements().size() - 20);
    glm::dvec3 arriving(0.0), leaving(0.0);
    double shares = 0.0, last = 1.0;
    bool fromLight = false, fromGlow = false;
    for (const FlowShare& share : arrivingLight(*live, live->solution, element)) {
        arriving += share.light;
        shares += share.share;
        EXPECT_LE(share.share, last) << "the largest first";
        last = share.share;
        fromLight |= share.kind == FlowShare::Kind::Light && share.id == 101 && share.place;
        fromGlow |= share.kind == FlowShare::Kind::Glow;
    }
    EXPECT_TRUE(fromLight);
    EXPECT_TRUE(fromGlow);
    EXPECT_NEAR(shares, 1.0, 1e-12);
    const glm::dvec3 irradiance = live->lit.irradiance(live->solution, element);
    EXPECT_LT(magnitude(arriving - irradiance), 1e-4 * magnitude(irradiance));
    for (const FlowShare& share : leavingLight(*live, live->solution, element))
        leaving += share.light;
    const glm::dvec3 radiosity = live->lit.radiosity(live->solution, element);
    EXPECT_LT(magnitude(leaving - radiosity), 1e-4 * magnitude(radiosity));
}

TEST(EnergyFlow, FindsTheElementUnderARay) {
    const LiveRadiosityPtr live = follow(room());
    const glm::vec3 from(0.5f, 0.5f, 0.5f);
    for (const glm::vec3& way :
         {glm::vec3(0, -1, 0), glm::vec3(1, 0, 0), glm::vec3(0, 0.6f, 0.8f)}) {
        const auto element = elementAlong(*live, from, way);
        ASSERT_TRUE(element);
        const std::vector<glm::vec3> outline = elementOutline(*live, *element);
        EXPECT_GE(outline.size(), 3u);
        const glm::vec3 centre = elementCentre(*live, *element);
        // On the cube's surface, and not farther from the ray than an element is wide.
        EXPECT_NEAR(glm::max(glm::max(std::abs(centre.x - 0.5f), std::abs(centre.y - 0.5f)),
                             std::abs(centre.z - 0.5f)),
                    0.5f, 1e-4f);
        const glm::vec3 to = centre - from;
        EXPECT_LT(glm::length(to - glm::dot(to, way) * way), 0.15f);
    }
    EXPECT_FALSE(elementAlong(*live, {5, 5, 5}, {0, 1, 0}));
}

} // namespace
} // namespace patina::test
