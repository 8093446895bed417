#include "core/base/Check.h"
#include "core/radiosity/document/LitDocument.h"
#include "core/radiosity/document/RadiositySurfaces.h"
#include "core/trace/BakeInputs.h"
#include "core/trace/document/DocumentTraceInputs.h"

#include <algorithm>
#include <fmt/format.h>
#include <limits>
#include <map>
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

// Elements that reach from one border of what is smooth to another, as the two halves of a
// square: with no vertex in between, nothing tells how light differs on them.
std::vector<bool> spanning(const LitMesh& mesh, std::size_t elements) {
    const auto lightOf = [&](std::uint32_t vertex) { return mesh.vertices[vertex].light; };
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges; // how many triangles have it
    const auto forEachEdge = [&](const auto& visit) {
        for (const LitMesh::Triangle& triangle : mesh.triangles)
            for (std::size_t c = 0; c < 3; ++c)
                visit(std::minmax(
                    {lightOf(triangle.vertices[c]), lightOf(triangle.vertices[(c + 1) % 3])}));
    };
    forEachEdge([&](const auto& edge) { ++edges[edge]; });
    std::vector<bool> atBorder(mesh.lights, false);
    for (const auto& [edge, triangles] : edges)
        if (triangles == 1)
            atBorder[edge.first] = atBorder[edge.second] = true;
    std::vector<bool> result(elements, true);
    for (const LitMesh::Triangle& triangle : mesh.triangles)
        for (const std::uint32_t vertex : triangle.vertices)
            if (!atBorder[lightOf(vertex)])
                result[triangle.element] = false;
    return result;
}

// Empty without a keeper.
std::function<void()> betweenOf(SolveKeeper* keeper) {
    if (keeper == nullptr)
        return {};
    return [keeper] { keeper->between({}); };
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
    const bool adaptive = settings.adaptive > 0.0;
    auto result = divideAsKept(inputs, settings, job.part(0.0, adaptive ? 0.1 : 0.5), keeper);
    if (!result)
        return result;
    if (Result<void> lit =
            (*result)->light(settings, adaptive ? job.part(0.1, 0.2) : job.part(0.5, 1.0), keeper);
        !lit)
        return lit.error();
    if (adaptive && (keeper == nullptr || !keeper->state().divided))
        if (Result<void> divided =
                (*result)->divideWhereLightChanges(settings, job.part(0.2, 1.0), keeper);
            !divided)
            return divided.error();
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
    auto elements = ElementMesh::make(*scene->geometry(), limits);
    if (!elements)
        return elements.error();
    std::unique_ptr<RadiosityScene> result(
        new RadiosityScene(std::move(*scene), std::move(*elements)));
    result->m_elements.findBuried(*result->m_scene.rays(), job.part(0.8, 1.0));
    if (job.cancelled())
        return bakeCancelled();
    return result;
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

Result<void> RadiosityScene::divideWhereLightChanges(const RadiositySettings& settings,
                                                     const JobContext& job, SolveKeeper* keeper) {
    constexpr int kRounds = 4;                    // each halves an edge
    constexpr double kLeastSpanning = 1.0 / 16.0; // of the area of first elements
    const double firstArea = settings.maxArea > 0.0
                                 ? settings.maxArea
                                 : surfaceArea(m_elements) / RadiositySettings::kFirstElements;
    // Rounds that were kept are passed over.
    int round = keeper != nullptr ? static_cast<int>(keeper->state().divisions.size()) : 0;
    for (; round < kRounds && !job.stopping(); ++round) {
        const JobContext step = job.part(static_cast<double>(round) / kRounds,
                                         static_cast<double>(round + 1) / kRounds);
        const Result<Solved> solved = solve(settings, step.part(0.0, 0.5), {}, keeper);
        if (!solved)
            return solved.error();
        if (job.stopping()) // not solved, perhaps
            break;
        job.setActivity("dividing");
        const LitMesh mesh = litMesh(m_elements, *m_scene.geometry());
        std::vector<glm::dvec3> irradiance;
        double mean = 0.0, area = 0.0;
        for (std::uint32_t e = 0; e < m_elements.size(); ++e) {
            irradiance.push_back(m_lit.irradiance(solved->solution, e));
            mean += m_lit.problem.areas[e] * magnitude(irradiance.back());
            area += m_lit.problem.areas[e];
        }
        mean /= area > 0.0 ? area : 1.0;
        const std::vector<glm::dvec3> light = vertexLight(mesh, m_elements, irradiance);
        struct Range {
            double least = std::numeric_limits<double>::infinity(), most = 0.0;
        };
        std::vector<Range> ranges(m_elements.size());
        for (const LitMesh::Triangle& triangle : mesh.triangles)
            for (const std::uint32_t v : triangle.vertices) {
                const double value = magnitude(light[mesh.vertices[v].light]);
                Range& range = ranges[triangle.element];
                range.least = std::min(range.least, value);
                range.most = std::max(range.most, value);
            }
        // What is too small to be looked at closely is taken as it is.
        std::vector<bool> unknown(m_elements.size(), false);
        if (round == 0) {
            unknown = spanning(mesh, m_elements.size());
            for (std::uint32_t e = 0; e < m_elements.size(); ++e)
                if (m_elements.area(e) < kLeastSpanning * firstArea)
                    unknown[e] = false;
        }
        std::vector<std::uint32_t> tooCoarse;
        for (std::uint32_t e = 0; e < m_elements.size(); ++e) {
            const double allowed = settings.adaptive * std::max(magnitude(irradiance[e]), mean);
            if (m_elements.exposed(e) > 0.0f &&
                (unknown[e] || ranges[e].most - ranges[e].least > allowed))
                tooCoarse.push_back(e);
        }
        if (tooCoarse.empty())
            break;
        if (m_elements.size() + 3 * tooCoarse.size() > settings.maxElements)
            return Error{ErrorKind::Usage,
                         fmt::format("Dividing where light changes would make more than the {} "
                                     "elements that are allowed; let it differ by more than {:g}.",
                                     settings.maxElements, settings.adaptive),
                         {},
                         {}};
        m_elements.divide(tooCoarse);
        m_elements.findBuried(*m_scene.rays(), step.part(0.5, 0.6));
        if (job.cancelled())
            return bakeCancelled();
        if (keeper != nullptr) {
            keeper->state().divisions.push_back(std::move(tooCoarse));
            if (Result<void> begun = keeper->begin(m_scene, m_elements); !begun)
                return begun.error();
        }
        if (Result<void> lit = this->light(settings, step.part(0.6, 1.0), keeper); !lit)
            return lit.error();
    }
    if (keeper != nullptr && !job.stopping()) {
        // The last solution begins anew, so that whoever observes it sees all of its steps.
        keeper->state().divided = true;
        keeper->state().solver = {};
    }
    return {};
}

Result<Solved> RadiosityScene::solve(const RadiositySettings& settings, const JobContext& job,
                                     const SolveObserver& observer, SolveKeeper* keeper) const {
    if (settings.solve.solver == Solver::Hierarchical)
        return solveHierarchical(m_lit.problem, m_elements, *m_scene.rays(), settings.hierarchy,
                                 settings.solve, job, observer);
    const auto factors = makeFormFactors(m_elements, *m_scene.rays(), settings.factors);
    if (!factors)
        return factors.error();
    return radiosity::solve(m_lit.problem, **factors, settings.solve, job, observer, keeper);
}

std::vector<LitPart> litParts(const SolvedSurfaces& surfaces, const Solution& solution) {
    const ElementMesh& elements = surfaces.elements;
    const LitMesh mesh = litMesh(elements, *surfaces.scene.geometry());
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
