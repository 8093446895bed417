#include "core/base/Check.h"
#include "core/radiosity/ElementSides.h"
#include "core/radiosity/document/LitDocument.h"
#include "core/radiosity/document/RadiositySurfaces.h"
#include "core/trace/BakeInputs.h"
#include "core/trace/document/DocumentTraceInputs.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <utility>
#include <vector>

namespace patina {

using namespace radiosity;

namespace {

double surfaceArea(const ElementMesh& elements) {
    double sum = 0.0;
    for (const double area : elements.areas())
        sum += area;
    return sum;
}

SceneProblemSettings lightSettings(const RadiositySettings& settings) {
    SceneProblemSettings light;
    light.lightSamples = settings.lightSamples;
    light.seed = settings.factors.seed;
    light.glowByFactors = settings.classic;
    return light;
}

// Empty without a keeper.
std::function<void()> betweenOf(SolveKeeper* keeper) {
    if (keeper == nullptr)
        return {};
    return [keeper] { keeper->between(viewOf(keeper->state().solver)); };
}

// How often what was unshot has halved by then.
int halvings(double residual) {
    return residual > 0.0 ? static_cast<int>(std::floor(-std::log2(residual)))
                          : std::numeric_limits<int>::max() - 1;
}

// What is still to arrive everywhere, W/m², as far as the mean of what is unshot tells.
glm::dvec3 ambientOf(const Problem& problem, const SolverState& solver) {
    const ShootingRule any = ShootingRule::Power;
    if (solver.steps.empty())
        return Shooting(problem, any, false).ambient();
    return Shooting(problem, any, false,
                    {solver.radiosity, solver.irradiance, solver.unshotPower, solver.lost})
        .ambient();
}

// Of the light that has arrived by way of other elements.
std::vector<double> noiseOf(const Problem& problem, const RadiositySettings& settings,
                            const SolveState& state) {
    if (state.solver.steps.empty()) // none yet, or by links
        return {};
    return shoots(settings.solve.solver)
               ? shotNoise(problem, state.rows, state.solver.radiosity)
               : gatheredNoise(problem, state.rows, state.solver.radiosity);
}

Solution solutionOf(const Problem& problem, const SolverState& solver) {
    Solution solution;
    solution.radiosity = problem.emission;
    solution.irradiance = solver.irradiance;
    solution.irradiance.resize(problem.size(), glm::dvec3(0.0));
    for (std::size_t e = 0; e < problem.size(); ++e)
        solution.radiosity[e] += problem.reflectance[e] * solution.irradiance[e];
    return solution;
}

// Elements end where a wall stands on them, or light would leak through it: an element has one
// radiosity. A wall along the rows or columns of a quad cuts these; others divide what they cross
// in four, so that the leak is as much narrower.
Result<ElementMesh> dividedAtWalls(const TraceScene& scene, ElementLimits limits,
                                   const JobContext& job) {
    constexpr int kCutRounds = 4;    // each finds one wall of those that cross an element
    constexpr int kFourthRounds = 2; // each halves the width of the leak
    const RayScene& rays = *scene.rays();
    auto elements = ElementMesh::make(*scene.geometry(), limits);
    if (!elements)
        return elements;
    elements->findBuried(rays, job);
    for (int round = 0; round < kCutRounds && !job.cancelled(); ++round) {
        const std::vector<FaceCut> cuts = findCuts(*elements, rays, job);
        if (cuts.empty())
            break;
        limits.cuts.insert(limits.cuts.end(), cuts.begin(), cuts.end());
        auto cut = ElementMesh::make(*scene.geometry(), limits);
        if (!cut)
            return cut;
        elements = std::move(cut);
        elements->findBuried(rays, job);
    }
    for (int round = 0; round < kFourthRounds && !job.cancelled(); ++round) {
        const std::vector<std::uint32_t> divided = findDivided(*elements, rays, job);
        if (divided.empty() || elements->size() + 3 * divided.size() > limits.maxElements)
            break;
        elements->setFenced(divided);
        elements->divide(divided);
        elements->findBuried(rays, job);
    }
    // And where they end at a wall of themselves.
    elements->setFenced(findParted(*elements, rays, job));
    if (job.cancelled())
        return bakeCancelled();
    return elements;
}

} // namespace

RadiosityScene::RadiosityScene(TraceScene scene, ElementMesh elements)
    : m_scene(std::move(scene))
    , m_elements(std::move(elements)) {}

Result<std::unique_ptr<RadiosityScene>> RadiosityScene::make(const Document& document,
                                                             const RadiositySettings& settings,
                                                             const JobContext& job) {
    return make(traceInputs(document), settings, job);
}

Result<std::unique_ptr<RadiosityScene>> RadiosityScene::make(const TraceInputs& inputs,
                                                             const RadiositySettings& settings,
                                                             const JobContext& job,
                                                             SolveKeeper* keeper) {
    const bool adaptive = settings.adaptive > 0.0, dynamic = adaptive && settings.dynamic;
    MemoryKeeper own;
    const bool kept = keeper != nullptr;
    if (adaptive && !kept)
        keeper = &own;
    auto result = divideAsKept(inputs, settings, job.part(0.0, adaptive ? 0.1 : 0.5), keeper);
    if (!result)
        return result;
    if (Result<void> lit =
            (*result)->light(settings, adaptive ? job.part(0.1, 0.2) : job.part(0.5, 1.0), keeper);
        !lit)
        return lit.error();
    if (adaptive && !keeper->state().divided) {
        const JobContext rest = job.part(0.2, 1.0);
        Result<void> divided = dynamic
                                   ? (*result)->divideWhileShooting(settings, rest, *keeper)
                                   : (*result)->divideWhereLightChanges(settings, rest, *keeper);
        if (!divided)
            return divided.error();
    }
    if (adaptive && !kept)
        (*result)->m_begun = std::make_unique<const Begun>(Begun{settings, std::move(own.state())});
    return result;
}

Result<void> RadiosityScene::findPart(const TraceInputs& inputs, const RadiositySettings& settings,
                                      const ElementShard& shard, const JobContext& job,
                                      SolveKeeper& keeper) {
    CHECK(!(settings.adaptive > 0.0));
    const auto scene = divideAsKept(inputs, settings, job.part(0.0, 0.1), &keeper);
    if (!scene)
        return scene.error();
    const ElementMesh& elements = (*scene)->elements();
    const RayScene& rays = *(*scene)->scene().rays();
    job.setActivity("collecting light");
    if (Result<void> found =
            keeper.state().light.complete((*scene)->scene(), elements, lightSettings(settings),
                                          shard, job.part(0.1, 0.5), betweenOf(&keeper));
        !found)
        return found;
    job.setActivity("computing form factors");
    const auto factors = makeFormFactors(elements, rays, settings.factors);
    if (!factors)
        return factors.error();
    return keeper.state().rows.complete(**factors, shard, settings.solve.maxBytes,
                                        job.part(0.5, 1.0), betweenOf(&keeper));
}

Result<std::unique_ptr<RadiosityScene>>
RadiosityScene::divideAsKept(const TraceInputs& inputs, const RadiositySettings& settings,
                             const JobContext& job, SolveKeeper* keeper) {
    auto result = divide(inputs, settings, job);
    if (!result || keeper == nullptr)
        return result;
    ElementMesh& elements = (*result)->m_elements;
    const std::size_t before = elements.size();
    if (Result<void> divided = keeper->divide(elements); !divided)
        return divided.error();
    if (elements.size() != before) {
        elements.findBuried(*(*result)->m_scene.rays(), job);
        if (job.cancelled())
            return bakeCancelled();
    }
    if (Result<void> begun = keeper->begin((*result)->m_scene, elements); !begun)
        return begun.error();
    return result;
}

Result<std::unique_ptr<RadiosityScene>> RadiosityScene::divide(const TraceInputs& inputs,
                                                               const RadiositySettings& settings,
                                                               const JobContext& job) {
    if (settings.patchArea > 0.0 && !shoots(settings.solve.solver))
        return Error{ErrorKind::Usage,
                     fmt::format("Patches shoot, and {} does not; choose progressive, southwell or "
                                 "overshooting, or leave patches out.",
                                 name(settings.solve.solver)),
                     {},
                     {}};
    if (settings.adaptive > 0.0 && settings.dynamic && !shoots(settings.solve.solver))
        return Error{ErrorKind::Usage,
                     fmt::format("Dividing while light is shot needs a solver that shoots, and {} "
                                 "does not; choose progressive, southwell or overshooting, or let "
                                 "the division be adaptive.",
                                 name(settings.solve.solver)),
                     {},
                     {}};
    job.setActivity("building the scene");
    auto scene = TraceScene::build(inputs, job.part(0.0, 0.8));
    if (!scene)
        return scene.error();
    if (scene->isEmpty())
        return Error{ErrorKind::InputBroken,
                     "The scene has no visible mesh; radiosity needs surfaces to light.",
                     {},
                     {}};
    ElementLimits limits{0.0, settings.maxArea, settings.maxElements, 0.0};
    if (limits.maxArea <= 0.0) {
        const auto whole = ElementMesh::make(*scene->geometry(), limits);
        if (!whole)
            return whole.error();
        limits.maxArea =
            surfaceArea(*whole) / (settings.adaptive > 0.0 ? RadiositySettings::kFirstElements
                                                           : RadiositySettings::kUsualElements);
    }
    limits.patchArea = settings.patchArea;
    auto elements = dividedAtWalls(*scene, std::move(limits), job.part(0.8, 1.0));
    if (!elements)
        return elements.error();
    return std::unique_ptr<RadiosityScene>(
        new RadiosityScene(std::move(*scene), std::move(*elements)));
}

Result<void> RadiosityScene::light(const RadiositySettings& settings, const JobContext& job,
                                   SolveKeeper* keeper) {
    job.setActivity("collecting light");
    DirectLight own;
    if (keeper == nullptr)
        own = DirectLight(m_elements.size());
    auto lit =
        SceneProblem::make(m_scene, m_elements, lightSettings(settings),
                           keeper != nullptr ? keeper->state().light : own, job, betweenOf(keeper));
    if (!lit)
        return lit.error();
    m_lit = std::move(*lit);
    return {};
}

Result<std::vector<std::uint32_t>> RadiosityScene::tooCoarse(const RadiositySettings& settings,
                                                             const Solution& solution,
                                                             const DivisionLook& look,
                                                             const JobContext& job) const {
    job.setActivity("dividing");
    const double firstArea = settings.maxArea > 0.0
                                 ? settings.maxArea
                                 : surfaceArea(m_elements) / RadiositySettings::kFirstElements;
    auto found = radiosity::tooCoarse(
        m_scene, m_elements, m_lit, solution, lightSettings(settings),
        {settings.divideBy, settings.adaptive, firstArea, look.ambient, look.noise, look.first},
        job);
    if (!found)
        return found;
    std::erase_if(*found, [&](std::uint32_t e) {
        return m_elements.area(e) < 4.0 * RadiositySettings::kLeastShare * firstArea;
    });
    if (m_elements.size() + 3 * found->size() > settings.maxElements)
        return Error{ErrorKind::Usage,
                     fmt::format("Dividing where light changes would make more than the {} "
                                 "elements that are allowed; let it differ by more than {:g}.",
                                 settings.maxElements, settings.adaptive),
                     {},
                     {}};
    return found;
}

Result<void> RadiosityScene::divideFurther(std::vector<std::uint32_t> elements,
                                           const RadiositySettings& settings, const JobContext& job,
                                           SolveKeeper& keeper) {
    std::vector<bool> divided(m_elements.size(), false);
    for (const std::uint32_t e : elements)
        divided[e] = true;
    const std::vector<std::uint32_t> parents = m_elements.divide(elements);
    m_elements.findBuried(*m_scene.rays(), job.part(0.0, 0.3));
    if (job.cancelled())
        return bakeCancelled();
    SolverState solver = std::move(keeper.state().solver);
    keeper.state().divisions.push_back(std::move(elements));
    if (Result<void> begun = keeper.begin(m_scene, m_elements); !begun)
        return begun;
    if (settings.dynamic && !solver.steps.empty()) {
        SolverState& next = keeper.state().solver;
        for (const std::uint32_t parent : parents)
            next.radiosity.push_back(solver.radiosity[parent]);
        next.irradiance.resize(parents.size(), glm::dvec3(0.0));
        next.steps = std::move(solver.steps);
        next.shootAgain = true;
    }
    // What is not divided keeps its light.
    for (std::uint32_t e = 0; e < m_elements.size(); ++e)
        if (!divided[parents[e]])
            keeper.state().light.set(e, m_lit.direct[parents[e]]);
    return light(settings, job.part(0.3, 1.0), &keeper);
}

Result<void> RadiosityScene::divideWhereLightChanges(const RadiositySettings& settings,
                                                     const JobContext& job, SolveKeeper& keeper) {
    constexpr int kRounds = 4; // each halves an edge
    const SolveState& state = keeper.state();
    // Rounds that were kept are passed over.
    auto round = static_cast<int>(state.divisions.size());
    for (; round < kRounds && !job.stopping(); ++round) {
        const JobContext step = job.part(static_cast<double>(round) / kRounds,
                                         static_cast<double>(round + 1) / kRounds);
        const Result<Solved> solved = solve(settings, step.part(0.0, 0.5), {}, &keeper);
        if (!solved)
            return solved.error();
        if (job.stopping()) // not solved, perhaps
            break;
        auto next =
            tooCoarse(settings, solved->solution,
                      {glm::dvec3(0.0), noiseOf(m_lit.problem, settings, state), round == 0},
                      step.part(0.5, 0.6));
        if (!next)
            return next.error();
        if (next->empty())
            break;
        if (Result<void> divided =
                divideFurther(*std::move(next), settings, step.part(0.6, 1.0), keeper);
            !divided)
            return divided;
    }
    if (!job.stopping()) {
        // The last solution begins anew, so that whoever observes it sees all of its steps.
        keeper.state().divided = true;
        keeper.state().solver = {};
    }
    return {};
}

Result<void> RadiosityScene::divideWhileShooting(const RadiositySettings& settings,
                                                 const JobContext& job, SolveKeeper& keeper) {
    // What little is left unshot then is too even to divide for.
    constexpr int kLastLook = 4; // halvings
    const SolveState& state = keeper.state();
    const std::vector<SolveStep>& steps = state.solver.steps;
    // Which of the steps are followed by a look depends on their residuals alone, so that what goes
    // on from a checkpoint looks when what was not interrupted would.
    const auto looks = [&] {
        const int before = steps.size() > 1 ? halvings(steps[steps.size() - 2].residual) : 0;
        return steps.empty() || halvings(steps.back().residual) > before;
    };
    while (!job.stopping()) {
        const int done = steps.empty() ? 0 : halvings(steps.back().residual);
        const JobContext part = job.part(std::min(done, kLastLook) / (kLastLook + 1.0),
                                         (std::min(done, kLastLook) + 1) / (kLastLook + 1.0));
        if (looks() && !state.solver.shootAgain) {
            const Problem& problem = m_lit.problem;
            auto next = tooCoarse(settings, solutionOf(problem, state.solver),
                                  {ambientOf(problem, state.solver),
                                   noiseOf(problem, settings, state), state.divisions.empty()},
                                  part.part(0.0, 0.1));
            if (!next)
                return next.error();
            if (!next->empty()) {
                if (Result<void> divided =
                        divideFurther(*std::move(next), settings, part.part(0.1, 0.5), keeper);
                    !divided)
                    return divided;
                continue; // before any shot: as often as direct light asks for it
            }
        }
        if (!steps.empty() &&
            (done >= kLastLook || steps.back().residual <= settings.solve.residual ||
             (settings.solve.maxIterations > 0 &&
              steps.back().iterations >= settings.solve.maxIterations)))
            break;
        RadiositySettings some = settings;
        some.solve.residual = std::max(settings.solve.residual, std::exp2(-(done + 1)));
        keeper.state().solver.ended = false;
        if (const auto solved = solve(some, part.part(0.5, 1.0), {}, &keeper); !solved)
            return solved.error();
    }
    if (!job.stopping())
        keeper.state().divided = true;
    // It ended for the look, not by itself.
    SolverState& solver = keeper.state().solver;
    solver.ended = solver.ended && !solver.shootAgain &&
                   (steps.back().residual <= settings.solve.residual ||
                    steps.back().iterations == settings.solve.maxIterations);
    return {};
}

Result<double> RadiosityScene::expectedFactorSeconds(const RadiositySettings& settings,
                                                     const JobContext& job) const {
    if (settings.solve.solver == Solver::Hierarchical || shoots(settings.solve.solver))
        return 0.0;
    const auto factors = makeFormFactors(m_elements, *m_scene.rays(), settings.factors);
    if (!factors)
        return factors.error();
    return expectedSeconds(**factors, m_elements.senderCount(), job);
}

Result<Solved> RadiosityScene::solve(const RadiositySettings& settings, const JobContext& job,
                                     const SolveObserver& observer, SolveKeeper* keeper) const {
    if (!m_lit.hasLight())
        return Error{ErrorKind::InputBroken,
                     "Nothing in the scene gives light; add a light or an environment, or give a "
                     "material emission.",
                     {},
                     {}};
    if (settings.solve.solver == Solver::Hierarchical)
        return solveHierarchical(m_lit.problem, m_elements, *m_scene.rays(), settings.hierarchy,
                                 settings.solve, job, observer);
    const auto factors = makeFormFactors(m_elements, *m_scene.rays(), settings.factors);
    if (!factors)
        return factors.error();
    MemoryKeeper begun;
    if (keeper == nullptr && m_begun && m_begun->settings.factors == settings.factors &&
        m_begun->settings.solve.solver == settings.solve.solver) {
        begun = MemoryKeeper(m_begun->state);
        keeper = &begun;
    }
    return radiosity::solve(m_lit.problem, **factors, settings.solve, job, observer, keeper);
}

std::vector<LitPart> litParts(const SolvedSurfaces& surfaces, const Solution& solution) {
    const ElementMesh& elements = surfaces.elements;
    const LitMesh mesh = litMesh(elements, *surfaces.scene.geometry(), *surfaces.scene.rays());
    std::vector<glm::dvec3> irradiance, radiosity;
    for (std::uint32_t e = 0; e < elements.size(); ++e) {
        irradiance.push_back(surfaces.lit.irradiance(solution, e));
        radiosity.push_back(surfaces.lit.radiosity(solution, e));
    }
    const std::vector<glm::dvec3> smoothIrradiance = vertexLight(mesh, elements, irradiance),
                                  smoothRadiosity = vertexLight(mesh, elements, radiosity);
    std::vector<LitPart> parts;
    for (RadiositySurface& surface :
         radiositySurfaces(mesh, elements, *surfaces.scene.geometry(), Corners::Shared)) {
        LitPart& part = parts.emplace_back();
        part.instance = surface.instance;
        part.back = surface.back;
        part.mesh = std::move(surface.mesh);
        for (const std::uint32_t light : surface.lights) {
            part.irradiance.emplace_back(smoothIrradiance[light]);
            part.radiosity.emplace_back(smoothRadiosity[light]);
        }
    }
    return parts;
}

} // namespace patina
