#include "core/radiosity/document/LiveRadiosity.h"

#include "core/document/ViewChoices.h"
#include "core/job/Parallel.h"
#include "core/radiosity/DirectSolution.h"
#include "core/radiosity/document/ElementLinks.h"
#include "core/radiosity/document/KeptRadiosity.h"
#include "core/radiosity/document/RadiositySources.h"
#include "core/radiosity/document/SourceSolver.h"
#include "core/trace/BakeInputs.h"

#include <algorithm>
#include <chrono>
#include <utility>

namespace patina {

using namespace radiosity;

namespace {

constexpr int kMaxSweeps = 500;
constexpr std::chrono::milliseconds kBetweenPictures{100};

class Follower {
  public:
    Follower(const TraceInputs& inputs, const RadiositySettings& settings,
             const LiveRadiosityPtr& before, const JobContext& job,
             const LiveRadiosityObserver& observer, const FollowOptions& options)
        : m_before(before)
        , m_job(job)
        , m_observer(observer)
        , m_options(options) {
        m_live.inputs = inputs;
        m_live.settings = settings;
        m_settings.lightSamples = settings.lightSamples;
        m_settings.seed = settings.factors.seed;
        m_settings.glowByFactors = settings.classic;
    }

    Result<LiveRadiosityPtr> run() {
        LightSources lighting = lightSourcesOf(m_live.inputs);
        if (Result<void> done = buildScene(lighting.inputs, m_job.part(0.0, 0.1)); !done)
            return done.error();
        if (Result<void> done = collectLight(std::move(lighting.sources), m_job.part(0.1, 0.4));
            !done)
            return done.error();
        combine();
        m_live.solved = std::ranges::all_of(m_live.sources, &isSolved);
        if (m_live.solved && (!m_options.factors || m_live.hasFactors()))
            return std::make_shared<const LiveRadiosity>(std::move(m_live));
        tell();
        if (Result<void> done = computeFactors(m_job.part(0.4, 0.9)); !done)
            return done.error();
        if (Result<void> done = solve(m_job.part(0.9, 1.0)); !done)
            return done.error();
        combine();
        return std::make_shared<const LiveRadiosity>(std::move(m_live));
    }

  private:
    static bool isSolved(const RadiositySource& source) { return !source.bounced.empty(); }

    [[nodiscard]] bool isHierarchical() const {
        return m_live.settings.solve.solver == Solver::Hierarchical;
    }

    // Whether the elements may stay. Where light decides how they are divided, they are those of
    // its solver.
    [[nodiscard]] bool keepsShape() const {
        if (!m_before || !sameSides(m_live.inputs, m_before->inputs))
            return false;
        RadiositySettings settings = m_live.settings;
        const RadiositySettings& before = m_before->settings;
        if (settings.adaptive > 0.0 && settings.solve.solver != before.solve.solver)
            return false;
        settings.solve = before.solve;
        if (settings.adaptive == 0.0) {
            settings.factors = before.factors;
            settings.hierarchy = before.hierarchy;
        }
        return settings == before;
    }
    // Given the same elements: whether their form factors may stay …
    [[nodiscard]] bool keepsFactors() const {
        return m_live.settings.factors == m_before->settings.factors && !isHierarchical();
    }
    // … and, given the same surfaces, what was solved.
    [[nodiscard]] bool keepsSolutions() const {
        return m_live.settings.solve.solver == m_before->settings.solve.solver &&
               (isHierarchical() ? m_live.settings.hierarchy == m_before->settings.hierarchy
                                 : m_live.settings.factors == m_before->settings.factors);
    }

    Result<void> buildScene(const TraceInputs& inputs, const JobContext& job) {
        if (keepsShape()) {
            auto scene = TraceScene::build(inputs, job, m_before->scene.get());
            if (!scene)
                return scene.error();
            if (scene->geometry() == m_before->shape->scene->scene().geometry()) {
                m_live.scene = std::make_shared<const TraceScene>(*std::move(scene));
                m_live.shape = m_before->shape;
                if (keepsFactors())
                    m_live.factors = m_before->factors;
                return {};
            }
        }
        m_before = nullptr; // nothing of it holds
        auto shape = std::make_shared<RadiosityShape>();
        // Where it divides by light, that is that of the document itself.
        auto scene = m_live.settings.adaptive > 0.0
                         ? divideByLight(m_live.inputs, m_live.settings, m_options.cache,
                                         shape->division, m_rows, job)
                         : RadiosityScene::divide(inputs, m_live.settings, job);
        if (!scene)
            return scene.error();
        auto built = TraceScene::build(inputs, job, &(*scene)->scene());
        if (!built)
            return built.error();
        m_live.scene = std::make_shared<const TraceScene>(*std::move(built));
        shape->mesh =
            litMesh((*scene)->elements(), *(*scene)->scene().geometry(), *(*scene)->scene().rays());
        shape->surfaces = radiositySurfaces(shape->mesh, (*scene)->elements(),
                                            *(*scene)->scene().geometry(), Corners::PerElement);
        shape->scene = *std::move(scene);
        m_live.shape = std::move(shape);
        return {};
    }

    Result<void> collectLight(std::vector<RadiositySource> sources, const JobContext& job) {
        m_job.setActivity("collecting light");
        const bool sameColors = m_before && m_before->inputs.materials == m_live.inputs.materials;
        if (sameColors) {
            m_live.lit.problem.reflectance = m_before->lit.problem.reflectance;
            m_live.lit.glow = m_before->lit.glow;
            m_live.lit.clamped = m_before->lit.clamped;
        } else {
            auto surfaces = elementSurfaces(*m_live.scene, m_live.elements(), m_settings, job);
            if (!surfaces)
                return surfaces.error();
            m_live.lit.problem.reflectance = std::move(surfaces->reflectance);
            m_live.lit.glow = std::move(surfaces->glow);
            m_live.lit.clamped = surfaces->clamped;
        }
        m_live.lit.problem.areas = exposedAreas(m_live.elements());
        m_live.lit.problem.patches = m_live.elements().patches();
        const bool samePaths =
            m_before && keepsSolutions() &&
            (sameColors || m_before->lit.problem.reflectance == m_live.lit.problem.reflectance);

        if (!m_live.scene->emissive().empty()) {
            RadiositySource glow;
            glow.kind = RadiositySource::Kind::Glow;
            sources.insert(sources.begin(), std::move(glow));
        }
        const bool sameGlowing = m_before && sameGlow(m_live.inputs, m_before->inputs);
        std::optional<SolutionKeys> keys;
        DirectSources missing;
        std::vector<std::size_t> which;
        std::uint32_t light = 0;
        for (std::size_t i = 0; i < sources.size(); ++i) {
            RadiositySource& source = sources[i];
            const std::uint32_t firstLight = light;
            light += static_cast<std::uint32_t>(source.lights.size());
            const bool glows = source.kind == RadiositySource::Kind::Glow;
            const RadiositySource* known = find(source);
            if (known && glows && !sameGlowing)
                known = nullptr;
            // One that was on its way when the edit came has still to get there.
            if (known && samePaths && isSolved(*known) &&
                known->residual <= m_live.settings.solve.residual) {
                source.direct = known->direct;
                source.bounced = known->bounced;
                source.residual = known->residual;
                source.sweeps = known->sweeps;
                source.links = known->links;
                source.found = known->found;
                source.withoutLinks = known->withoutLinks;
                continue;
            }
            if (findInCache(source, keys))
                continue;
            if (known) {
                source.direct = known->direct;
                continue;
            }
            source.direct.assign(m_live.elements().size(), glm::dvec3(0.0));
            if (glows && m_settings.glowByFactors)
                continue; // shot as emission, not collected
            missing.glow |= glows;
            missing.sky |= source.kind == RadiositySource::Kind::Sky;
            if (glows || source.kind == RadiositySource::Kind::Sky)
                which.push_back(i);
            for (std::uint32_t l = firstLight; l < light; ++l) {
                missing.lights.push_back(l);
                which.push_back(i);
            }
        }
        if (missing.size() > 0) {
            auto found = directLight(*m_live.scene, m_live.elements(), missing, m_settings, job);
            if (!found)
                return found.error();
            for (std::size_t k = 0; k < which.size(); ++k)
                for (std::size_t e = 0; e < (*found)[k].size(); ++e)
                    sources[which[k]].direct[e] += (*found)[k][e];
        }
        if (m_before)
            keepSwitchedOff(sources, samePaths);
        m_live.sources = std::move(sources);
        return {};
    }

    // The light of a source that somebody has solved before. `keys`: made once they are needed.
    bool findInCache(RadiositySource& source, std::optional<SolutionKeys>& keys) {
        if (m_options.cache == nullptr)
            return false;
        if (!keys)
            keys.emplace(m_live);
        auto kept = m_options.cache->find(keys->of(source), m_live.elements().size());
        if (!kept)
            return false;
        source.direct = std::move(kept->direct);
        source.bounced = std::move(kept->bounced);
        source.residual = kept->residual;
        source.sweeps = kept->sweeps;
        source.found = true;
        source.withoutLinks = isHierarchical();
        return true;
    }

    [[nodiscard]] const RadiositySource* find(const RadiositySource& source) const {
        if (!m_before)
            return nullptr;
        for (const auto* known : {&m_before->sources, &m_before->switchedOff})
            for (const RadiositySource& other : *known)
                if (sameSource(other, source))
                    return &other;
        return nullptr;
    }

    // Lights that were there before and are not now may come back; those whose shape has changed do
    // not.
    void keepSwitchedOff(const std::vector<RadiositySource>& sources, bool samePaths) {
        for (const auto* known : {&m_before->sources, &m_before->switchedOff})
            for (const RadiositySource& old : *known) {
                const bool there = std::ranges::any_of(sources, [&](const RadiositySource& source) {
                    return source.kind == old.kind && source.id == old.id;
                });
                if (there || old.kind != RadiositySource::Kind::Light ||
                    m_live.switchedOff.size() >= kMaxAloneSources)
                    continue;
                RadiositySource& kept = m_live.switchedOff.emplace_back(old);
                if (!samePaths) {
                    kept.bounced.clear();
                    kept.links = nullptr;
                }
            }
    }

    // All sources together, as far as they are solved.
    void combine() {
        SceneProblem& lit = m_live.lit;
        const std::size_t n = m_live.elements().size();
        lit.direct.assign(n, glm::dvec3(0.0));
        m_live.residual = 0.0;
        m_live.sweeps = 0;
        Solution& solution = m_live.solution;
        solution.irradiance.assign(n, glm::dvec3(0.0));
        for (const RadiositySource& source : m_live.sources) {
            m_live.residual = std::max(m_live.residual, source.residual);
            m_live.sweeps = std::max(m_live.sweeps, source.sweeps);
            for (std::size_t e = 0; e < n; ++e) {
                lit.direct[e] += source.power * source.direct[e];
                if (!source.bounced.empty())
                    solution.irradiance[e] += source.power * source.bounced[e];
            }
        }
        lit.problem.emission.resize(n);
        solution.radiosity.resize(n);
        for (std::size_t e = 0; e < n; ++e) {
            lit.problem.emission[e] = lit.problem.reflectance[e] * lit.direct[e];
            if (m_settings.glowByFactors)
                lit.problem.emission[e] += lit.glow[e];
            solution.radiosity[e] =
                lit.problem.emission[e] + lit.problem.reflectance[e] * solution.irradiance[e];
        }
    }

    void tell() {
        m_told = std::chrono::steady_clock::now();
        if (m_observer)
            m_observer(std::make_shared<const LiveRadiosity>(m_live));
    }

    Result<void> computeFactors(const JobContext& job) {
        if (m_live.settings.solve.solver == Solver::Direct && m_live.elements().size() > kMaxDirect)
            return tooManyForDirect(m_live.elements().size()); // before what takes long
        if (m_live.factors || isHierarchical())
            return {};
        m_job.setActivity("computing form factors");
        const auto method =
            makeFormFactors(m_live.elements(), *m_live.scene->rays(), m_live.settings.factors);
        if (!method)
            return method.error();
        // Rows that the division has found need not be found again.
        const std::size_t senders = m_live.elements().senderCount();
        if (m_options.expects && m_live.settings.factors.method != FactorMethod::Rays)
            m_options.expects(expectedSeconds(**method, senders, job));
        FactorMatrix matrix = m_rows.size() == senders ? std::move(m_rows) : FactorMatrix(senders);
        if (Result<void> complete =
                matrix.complete(**method, {}, m_live.settings.solve.maxBytes, job);
            !complete)
            return complete;
        auto factors = std::make_shared<RadiosityFactors>();
        const Problem& problem = m_live.lit.problem;
        factors->quality =
            problem.patches.empty()
                ? qualityOf(matrix, problem.areas)
                : qualityOf(matrix.betweenPatches(problem.patches), senderAreas(problem));
        factors->matrix = std::move(matrix);
        m_live.factors = std::move(factors);
        return {};
    }

    // Step by step, each over all sources that are not solved.
    Result<void> solve(const JobContext& job) {
        if (isHierarchical())
            return solveByLinks(job);
        if (m_live.solved) // but for the form factors
            return {};
        m_job.setActivity(shoots(m_live.settings.solve.solver) ? "shooting light"
                                                               : "gathering light");
        struct Task {
            std::size_t source;
            Problem problem;
            std::unique_ptr<SourceSolver> solver;
            Result<void> result = {};
            bool done = false;
        };
        std::vector<Task> tasks;
        for (std::size_t i = 0; i < m_live.sources.size(); ++i)
            if (!isSolved(m_live.sources[i]))
                tasks.push_back({i, problemOf(m_live.sources[i]), nullptr});
        for (Task& task : tasks)
            task.solver =
                makeSourceSolver(m_live.settings.solve, task.problem, m_live.factors->matrix);
        for (int step = 1; step <= kMaxSweeps && !job.stopping(); ++step) {
            parallelFor(job, tasks.size(), 1, [&](std::size_t begin, std::size_t end) {
                for (std::size_t t = begin; t < end; ++t) {
                    Task& task = tasks[t];
                    if (task.done)
                        continue;
                    RadiositySource& source = m_live.sources[task.source];
                    task.result = task.solver->step(job);
                    source.residual = task.solver->residual(job);
                    source.sweeps = static_cast<int>(task.solver->iterations());
                    task.done = source.residual <= m_live.settings.solve.residual;
                }
            });
            if (job.cancelled())
                return bakeCancelled();
            for (const Task& task : tasks) {
                if (!task.result)
                    return task.result.error();
                m_live.sources[task.source].bounced = task.solver->irradiance();
            }
            if (std::ranges::all_of(tasks, &Task::done)) {
                m_live.solved = true;
                return {};
            }
            if (m_observer && std::chrono::steady_clock::now() - m_told >= kBetweenPictures) {
                combine();
                tell();
            }
        }
        return {};
    }

    // Source after source: each has links of its own, as coarse as its light allows.
    Result<void> solveByLinks(const JobContext& job) {
        SolveSettings settings = m_live.settings.solve;
        settings.maxIterations = kMaxSweeps;
        std::shared_ptr<const ClusterTree> tree;
        for (const RadiositySource& source : m_live.sources)
            if (source.links)
                tree = source.links->tree;
        const auto count = static_cast<double>(std::max<std::size_t>(m_live.sources.size(), 1));
        bool solved = true;
        for (std::size_t i = 0; i < m_live.sources.size(); ++i) {
            RadiositySource& source = m_live.sources[i];
            // Its links alone: they are found by gathering, which ends in the light it has.
            const bool again = isSolved(source);
            if (again && !(m_options.factors && source.withoutLinks))
                continue;
            const Problem problem = problemOf(source);
            if (!(emittedPower(problem) > 0.0)) {
                source.bounced.assign(problem.size(), glm::dvec3(0.0));
                source.residual = 0.0;
                source.withoutLinks = false;
                continue;
            }
            HierarchyLinks links{tree, {}};
            const auto show = [&](std::uint64_t, double, const std::function<Solution()>& light) {
                if (m_observer && !again &&
                    std::chrono::steady_clock::now() - m_told >= kBetweenPictures) {
                    source.bounced = light().irradiance;
                    combine();
                    tell();
                }
                return true;
            };
            auto found = solveHierarchical(
                problem, m_live.elements(), *m_live.scene->rays(), m_live.settings.hierarchy,
                settings,
                job.part(static_cast<double>(i) / count, static_cast<double>(i + 1) / count), show,
                &links);
            if (!found)
                return found.error();
            if (again && !found->report.converged)
                continue; // stopped
            tree = links.tree;
            source.bounced = std::move(found->solution.irradiance);
            source.residual = found->report.residual;
            source.sweeps = static_cast<int>(found->report.iterations);
            source.links = std::make_shared<const HierarchyLinks>(std::move(links));
            source.withoutLinks = false;
            solved = solved && found->report.converged;
        }
        m_live.solved = m_live.solved || (solved && !job.stopping());
        return {};
    }

    // Of a source alone, at a power of 1.
    [[nodiscard]] Problem problemOf(const RadiositySource& source) const {
        Problem problem;
        problem.areas = m_live.lit.problem.areas;
        problem.reflectance = m_live.lit.problem.reflectance;
        problem.patches = m_live.lit.problem.patches;
        const bool shot = source.kind == RadiositySource::Kind::Glow && m_settings.glowByFactors;
        for (std::size_t e = 0; e < source.direct.size(); ++e)
            problem.emission.push_back(shot ? m_live.lit.glow[e]
                                            : problem.reflectance[e] * source.direct[e]);
        return problem;
    }

    LiveRadiosity m_live;
    LiveRadiosityPtr m_before;
    FactorMatrix m_rows; // that were found while elements were divided; of none: none were
    const JobContext& m_job;
    const LiveRadiosityObserver& m_observer;
    const FollowOptions& m_options;
    SceneProblemSettings m_settings;
    std::chrono::steady_clock::time_point m_told{};
};

Solver solverOf(RadiositySolver solver) {
    switch (solver) {
    case RadiositySolver::Gathering:
        return Solver::GaussSeidel;
    case RadiositySolver::Jacobi:
        return Solver::Jacobi;
    case RadiositySolver::Progressive:
        return Solver::Progressive;
    case RadiositySolver::Southwell:
        return Solver::Southwell;
    case RadiositySolver::Overshooting:
        return Solver::Overshooting;
    case RadiositySolver::Direct:
        return Solver::Direct;
    case RadiositySolver::Hierarchical:
        break;
    }
    return Solver::Hierarchical;
}

DivisionRule ruleOf(RadiosityDivision division) {
    switch (division) {
    case RadiosityDivision::Gradient:
        return DivisionRule::Gradient;
    case RadiosityDivision::Visibility:
        return DivisionRule::Visibility;
    case RadiosityDivision::L1:
        return DivisionRule::L1;
    case RadiosityDivision::L2:
        return DivisionRule::L2;
    case RadiosityDivision::Linf:
        break;
    }
    return DivisionRule::Linf;
}

} // namespace

bool LiveRadiosity::hasFactors() const {
    return settings.solve.solver == Solver::Hierarchical
               ? std::ranges::none_of(sources, &RadiositySource::withoutLinks)
               : factors != nullptr;
}

std::size_t LiveRadiosity::foundSources() const {
    return static_cast<std::size_t>(std::ranges::count(sources, true, &RadiositySource::found));
}

RadiositySettings radiositySettings(const View& view) {
    RadiositySettings settings;
    settings.maxArea = double{view.radiosityArea};
    settings.adaptive = double{view.radiosityAdaptive};
    switch (view.radiosityMethod) {
    case RadiosityMethod::Raycast:
        settings.factors.method = FactorMethod::Rays;
        settings.factors.resolution = view.radiosityRays;
        break;
    case RadiosityMethod::Hemicube:
        settings.factors.method = FactorMethod::Hemicube;
        settings.factors.resolution = view.radiosityCells + view.radiosityCells % 2;
        break;
    case RadiosityMethod::Analytic:
        settings.factors.method = FactorMethod::Analytic;
        settings.factors.resolution = view.radiosityPairs;
        break;
    case RadiosityMethod::Paraboloid:
        settings.factors.method = FactorMethod::Paraboloid;
        settings.factors.resolution = view.radiosityTexels;
        break;
    }
    settings.solve.solver = solverOf(view.radiositySolver);
    settings.hierarchy.linkError = 1e-6 * double{view.radiosityLinkError};
    if (settings.adaptive > 0.0)
        settings.divideBy = ruleOf(view.radiosityDivideBy);
    if (shoots(settings.solve.solver)) { // of the others these have no effect
        settings.dynamic = view.radiosityDynamic && settings.adaptive > 0.0;
        settings.patchArea = double{view.radiosityPatches};
    }
    settings.classic = view.radiosityClassic;
    return settings;
}

Result<LiveRadiosityPtr> followRadiosity(const TraceInputs& inputs,
                                         const RadiositySettings& settings,
                                         const LiveRadiosityPtr& before, const JobContext& job,
                                         const LiveRadiosityObserver& observer,
                                         const FollowOptions& options) {
    return Follower(inputs, settings, before, job, observer, options).run();
}

ShownRadiosityPtr shownRadiosity(const LiveRadiosity& live, const Solution& solution,
                                 const std::vector<glm::dvec3>& unshot,
                                 std::optional<std::uint32_t> chosen) {
    const ElementMesh& elements = live.elements();
    std::vector<glm::dvec3> irradiance;
    auto shown = std::make_shared<ShownRadiosity>();
    shown->shape = live.shape;
    shown->chosen = chosen;
    for (std::uint32_t e = 0; e < elements.size(); ++e) {
        irradiance.push_back(live.lit.irradiance(solution, e));
        ShownRadiosity::Element& element = shown->elements.emplace_back();
        element.radiosity = glm::vec3(live.lit.radiosity(solution, e));
        if (!unshot.empty())
            element.unshot = glm::vec3(unshot[e]);
        element.area = static_cast<float>(elements.area(e));
    }
    if (chosen && live.factors && *chosen < elements.size())
        for (const FactorRow::Share& share : live.factors->matrix.row(elements.senderOf(*chosen)))
            shown->elements[share.element].share = share.factor;
    if (chosen && !live.factors) {
        const std::vector<double> factors = factorsOverLinks(live, *chosen);
        for (std::size_t e = 0; e < factors.size(); ++e)
            shown->elements[e].share = static_cast<float>(factors[e]);
    }
    for (const glm::dvec3& light : vertexLight(live.shape->mesh, elements, irradiance))
        shown->irradiance.emplace_back(light);
    return shown;
}

} // namespace patina
