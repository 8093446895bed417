#include "core/radiosity/Solve.h"

#include "core/base/Check.h"
#include "core/job/Parallel.h"
#include "core/radiosity/DirectSolution.h"
#include "core/radiosity/Gathering.h"
#include "core/trace/BakeInputs.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace patina::radiosity {
namespace {

// How far a residual that shrinks by about the same factor with each step has come.
double progressOf(double residual, double first, double wanted) {
    if (!(residual > 0.0) || !(first > wanted) || !(wanted > 0.0))
        return 0.0;
    return std::clamp(std::log(first / residual) / std::log(first / wanted), 0.0, 1.0);
}

// Rows that are computed side by side: those of senders that are likely to shoot next.
constexpr std::size_t kRowsAhead = 16;

// Rows of senders that have shot, for when they shoot again: as many as the budget holds. And a few
// of those that will shoot.
class RowCache {
  public:
    // `kept`: those that are known already, and where all of them are kept.
    RowCache(const FormFactors& factors, FactorMatrix& kept, std::size_t maxBytes)
        : m_factors(factors)
        , m_kept(kept)
        , m_maxBytes(maxBytes) {
        for (std::uint32_t e = 0; e < kept.size(); ++e)
            if (kept.has(e))
                m_bytes += sizeOf(kept.whole(e));
    }

    // Those of some elements, computed side by side where they are not there.
    std::vector<const FactorRow*> rows(const std::vector<std::uint32_t>& elements,
                                       const JobContext& job) {
        m_scratch.resize(std::max(m_scratch.size(), elements.size()));
        parallelFor(job, elements.size(), 1, [&](std::size_t begin, std::size_t) {
            if (!m_kept.has(elements[begin]))
                m_factors.row(elements[begin], m_scratch[begin]);
        });
        std::vector<const FactorRow*> result;
        if (job.cancelled()) // not all of them are there
            return result;
        for (std::size_t i = 0; i < elements.size(); ++i) {
            const std::uint32_t element = elements[i];
            if (const std::size_t size = sizeOf(m_scratch[i]);
                !m_kept.has(element) && (m_maxBytes == 0 || m_bytes + size <= m_maxBytes)) {
                m_kept.set(element, m_scratch[i]);
                m_bytes += size;
            }
            result.push_back(m_kept.has(element) ? &m_kept.whole(element) : &m_scratch[i]);
        }
        return result;
    }
    // That of the next sender. Where it is not there it is computed, and those of `likely()` with
    // it, which the budget does not count until they shoot. Null: cancelled.
    const FactorRow* row(std::uint32_t sender,
                         const std::function<std::vector<std::uint32_t>()>& likely,
                         const JobContext& job) {
        if (m_kept.has(sender))
            return &m_kept.whole(sender);
        if (!m_ahead.contains(sender)) {
            std::vector<std::uint32_t> wanted{sender};
            for (const std::uint32_t other : likely())
                if (other != sender && !m_kept.has(other) && !m_ahead.contains(other))
                    wanted.push_back(other);
            if (m_ahead.size() > 4 * kRowsAhead) // they were no guesses
                m_ahead.clear();
            std::vector<FactorRow> found(wanted.size());
            parallelFor(job, wanted.size(), 1, [&](std::size_t begin, std::size_t) {
                m_factors.row(wanted[begin], found[begin]);
            });
            if (job.cancelled())
                return nullptr;
            for (std::size_t i = 0; i < wanted.size(); ++i)
                m_ahead.emplace(wanted[i], std::move(found[i]));
        }
        const auto next = m_ahead.find(sender);
        m_shooting = std::move(next->second);
        m_ahead.erase(next);
        if (const std::size_t size = sizeOf(m_shooting);
            m_maxBytes == 0 || m_bytes + size <= m_maxBytes) {
            m_kept.set(sender, m_shooting);
            m_bytes += size;
            return &m_kept.whole(sender);
        }
        return &m_shooting;
    }
    [[nodiscard]] std::size_t bytes() const { return m_bytes; }

  private:
    static std::size_t sizeOf(const FactorRow& row) {
        return sizeof(FactorRow) + row.shares.size() * sizeof(FactorRow::Share);
    }

    const FormFactors& m_factors;
    FactorMatrix& m_kept;
    std::vector<FactorRow> m_scratch;
    std::map<std::uint32_t, FactorRow> m_ahead; // by sender
    FactorRow m_shooting;
    std::size_t m_maxBytes, m_bytes = 0;
};

class Steps {
  public:
    // `before`: steps that were made already.
    Steps(const SolveSettings& settings, const JobContext& job, const SolveObserver& observer,
          std::vector<SolveStep> before)
        : m_settings(settings)
        , m_job(job)
        , m_observer(observer)
        , m_steps(std::move(before)) {
        for (const SolveStep& step : m_steps)
            add(step);
    }

    // Whether to go on after `iterations`.
    bool after(std::uint64_t iterations, double residual,
               const std::function<Solution()>& solution) {
        m_steps.push_back({iterations, residual});
        add(m_steps.back());
        m_job.setProgress(progressOf(residual, report.history.front(), m_settings.residual));
        const bool goOn = !m_observer || m_observer(iterations, residual, solution);
        m_ended = report.converged ||
                  (m_settings.maxIterations > 0 && iterations >= m_settings.maxIterations);
        return goOn && !m_ended && !m_job.stopping();
    }
    [[nodiscard]] const std::vector<SolveStep>& steps() const { return m_steps; }
    // By itself.
    [[nodiscard]] bool ended() const { return m_ended; }

    SolveReport report;

  private:
    void add(const SolveStep& step) {
        report.iterations = step.iterations;
        report.residual = step.residual;
        report.history.push_back(step.residual);
        report.converged = step.residual <= m_settings.residual;
    }

    const SolveSettings& m_settings;
    const JobContext& m_job;
    const SolveObserver& m_observer;
    std::vector<SolveStep> m_steps;
    bool m_ended = false;
};

Solved finished(const Problem& problem, Solution solution, SolveReport report) {
    report.meanRadiosity = meanRadiosity(problem, solution.radiosity);
    return {std::move(solution), std::move(report)};
}

SolverView viewOf(const Shooting& shooting, const Steps& steps, bool ended) {
    const Shooting::State& state = shooting.state();
    return {state.shot, state.irradiance, state.unshotPower, state.lost, steps.steps(), ended,
            false};
}

SolverView viewOf(const Solution& solution, const Steps& steps, bool ended) {
    return {solution.radiosity,
            solution.irradiance,
            glm::dvec3(0.0),
            glm::dvec3(0.0),
            steps.steps(),
            ended,
            false};
}

// Where the solver is when it ends, by itself or not.
void giveBack(SolveKeeper* keeper, const SolverView& view) {
    if (keeper != nullptr && !view.steps.empty())
        keeper->state().solver = {{view.radiosity.begin(), view.radiosity.end()},
                                  {view.irradiance.begin(), view.irradiance.end()},
                                  view.unshotPower,
                                  view.lost,
                                  {view.steps.begin(), view.steps.end()},
                                  view.ended,
                                  view.shootAgain};
}

// Where `before` is; of SolverState::shootAgain nothing is sent yet.
Shooting beginShooting(const Problem& problem, ShootingRule rule, bool overshoot,
                       const SolverState& before) {
    Shooting fresh(problem, rule, overshoot);
    if (before.steps.empty())
        return fresh;
    const std::uint64_t shots = before.steps.back().iterations;
    if (!before.shootAgain)
        return {problem, rule, overshoot,
                Shooting::State{before.radiosity, before.irradiance, before.unshotPower,
                                before.lost, shots}};
    Shooting::State state = fresh.state();
    state.shots = shots;
    return {problem, rule, overshoot, std::move(state)};
}

// All that was shot before elements were divided, by the senders that there are now. False:
// cancelled.
bool shootAgain(const Problem& problem, const std::vector<glm::dvec3>& shot, std::size_t atATime,
                RowCache& cache, Shooting& shooting, const JobContext& job) {
    std::vector<std::uint32_t> senders;
    for (std::uint32_t s = 0; s < problem.senders(); ++s) {
        bool any = false;
        forElementsOf(problem, s, [&](std::uint32_t e) { any = any || magnitude(shot[e]) > 0.0; });
        if (any)
            senders.push_back(s);
    }
    for (std::size_t i = 0; i < senders.size(); i += atATime) {
        const std::vector<std::uint32_t> next(
            senders.begin() + static_cast<std::ptrdiff_t>(i),
            senders.begin() + static_cast<std::ptrdiff_t>(std::min(i + atATime, senders.size())));
        const std::vector<const FactorRow*> rows = cache.rows(next, job);
        if (job.cancelled())
            return false;
        for (std::size_t k = 0; k < next.size(); ++k)
            shooting.shootAgain(next[k], *rows[k], shot);
    }
    return true;
}

Result<Solved> shootAll(const Problem& problem, const FormFactors& factors,
                        const SolveSettings& settings, const JobContext& job,
                        const SolveObserver& observer, SolveKeeper* keeper) {
    const ShootingRule rule = shootingRule(settings.solver);
    const bool overshoot = settings.solver == Solver::Overshooting;
    SolverState before = keeper != nullptr ? std::move(keeper->state().solver) : SolverState();
    Shooting shooting = beginShooting(problem, rule, overshoot, before);
    Steps steps(settings, job, observer, before.steps);
    const std::size_t most = std::max<std::size_t>(settings.shotsPerStep, 1);
    const auto left = [&](std::size_t count) { // of the shots that are asked for
        return settings.maxIterations == 0 ? count
                                           : static_cast<std::size_t>(std::min<std::uint64_t>(
                                                 count, settings.maxIterations - shooting.shots()));
    };
    FactorMatrix own;
    if (keeper == nullptr)
        own = FactorMatrix(problem.senders());
    FactorMatrix& kept = keeper != nullptr ? keeper->state().rows : own;
    RowCache cache(factors, kept, settings.maxBytes);
    job.setActivity("shooting light");
    if (before.shootAgain &&
        !shootAgain(problem, before.radiosity, kRowsAhead, cache, shooting, job)) {
        if (keeper != nullptr)
            keeper->state().solver = std::move(before);
        return bakeCancelled();
    }
    bool ended = before.ended;
    for (bool goOn = !ended; goOn;) {
        const std::vector<std::uint32_t> next = shooting.next(left(most));
        std::vector<const FactorRow*> rows;
        if (next.size() == 1)
            rows = {cache.row(
                next[0], [&] { return shooting.next(left(kRowsAhead)); }, job)};
        else
            rows = cache.rows(next, job);
        if (job.cancelled()) {
            giveBack(keeper, viewOf(shooting, steps, false));
            return bakeCancelled();
        }
        for (std::size_t i = 0; i < next.size(); ++i)
            shooting.shoot(next[i], *rows[i]);
        goOn = steps.after(shooting.shots(), shooting.residual(), [&] {
            return shooting.solution();
        }) && !next.empty();
        ended = steps.ended() || next.empty();
        if (keeper != nullptr)
            keeper->between(viewOf(shooting, steps, ended));
    }
    giveBack(keeper, viewOf(shooting, steps, ended));
    steps.report.energy = shooting.energy();
    steps.report.factorBytes = cache.bytes();
    steps.report.rows = kept.rowCount();
    steps.report.shares = kept.shareCount();
    std::vector<glm::dvec3> shot, unshot;
    for (std::uint32_t e = 0; e < problem.size(); ++e) {
        unshot.push_back(shooting.unshot(e));
        shot.push_back(shooting.radiosity(e) - unshot.back());
    }
    steps.report.bound = shootingBound(problem, kept, shot, unshot);
    return finished(problem, shooting.solution(), std::move(steps.report));
}

Result<void> sweepAll(Gathering& gathering, Steps& steps, const JobContext& job,
                      SolveKeeper* keeper) {
    // A sweep that is cancelled leaves elements of two sweeps.
    Solution last;
    bool goOn = true;
    for (std::uint64_t sweep = steps.report.iterations + 1; goOn; ++sweep) {
        if (keeper != nullptr)
            last = gathering.solution();
        gathering.sweep(job);
        const double residual = gathering.residual(job);
        if (job.cancelled()) {
            giveBack(keeper, viewOf(last, steps, false));
            return bakeCancelled();
        }
        goOn = steps.after(sweep, residual, [&] { return gathering.solution(); });
        if (keeper != nullptr)
            keeper->between(viewOf(gathering.solution(), steps, steps.ended()));
    }
    return {};
}

Result<Solved> gatherAll(const Problem& problem, const FormFactors& factors,
                         const SolveSettings& settings, const JobContext& job,
                         const SolveObserver& observer, SolveKeeper* keeper) {
    job.setActivity("computing form factors");
    FactorMatrix own;
    if (keeper == nullptr)
        own = FactorMatrix(problem.senders());
    FactorMatrix& matrix = keeper != nullptr ? keeper->state().rows : own;
    const auto between = [keeper] { keeper->between({}); };
    if (Result<void> complete = matrix.complete(factors, {}, settings.maxBytes, job.part(0.0, 0.8),
                                                keeper != nullptr ? std::function<void()>(between)
                                                                  : std::function<void()>());
        !complete)
        return complete.error();
    job.setActivity("gathering light");
    const JobContext rest = job.part(0.8, 1.0);
    SolverState before = keeper != nullptr ? std::move(keeper->state().solver) : SolverState();
    Steps steps(settings, rest, observer, before.steps);
    steps.report.quality = qualityOf(matrix, problem.areas);
    steps.report.factorBytes = matrix.memoryBytes();
    steps.report.rows = matrix.rowCount();
    steps.report.shares = matrix.shareCount();
    const bool ended = before.ended;
    Solution first{std::move(before.radiosity), std::move(before.irradiance)};
    if (settings.solver == Solver::Direct) {
        auto solution =
            ended ? Result<Solution>(std::move(first)) : directSolution(problem, matrix, rest);
        if (!solution)
            return solution.error();
        if (!ended)
            steps.after(1, 0.0, [&] { return *solution; });
        giveBack(keeper, viewOf(*solution, steps, true));
        steps.report.bound = gatheringBound(problem, matrix, solution->radiosity);
        return finished(problem, std::move(*solution), std::move(steps.report));
    }
    const Sweep sweep = settings.solver == Solver::Jacobi ? Sweep::Jacobi : Sweep::GaussSeidel;
    Gathering gathering = before.steps.empty()
                              ? Gathering(problem, matrix, sweep)
                              : Gathering(problem, matrix, sweep, std::move(first));
    if (!ended)
        if (Result<void> swept = sweepAll(gathering, steps, rest, keeper); !swept)
            return swept.error();
    giveBack(keeper, viewOf(gathering.solution(), steps, ended || steps.ended()));
    steps.report.bound = gatheringBound(problem, matrix, gathering.solution().radiosity);
    return finished(problem, gathering.solution(), std::move(steps.report));
}

} // namespace

std::string_view name(Solver solver) {
    switch (solver) {
    case Solver::Progressive:
        return "progressive";
    case Solver::Southwell:
        return "southwell";
    case Solver::Overshooting:
        return "overshooting";
    case Solver::Jacobi:
        return "jacobi";
    case Solver::GaussSeidel:
        return "gathering";
    case Solver::Hierarchical:
        return "hierarchical";
    case Solver::Direct:
        break;
    }
    return "direct";
}

bool shoots(Solver solver) {
    return solver == Solver::Progressive || solver == Solver::Southwell ||
           solver == Solver::Overshooting;
}

ShootingRule shootingRule(Solver solver) {
    return solver == Solver::Southwell ? ShootingRule::Residual : ShootingRule::Power;
}

Solved darkness(const Problem& problem) {
    SolveReport report;
    report.converged = true;
    report.bound = ErrorBound{0.0, 0.0};
    const std::vector<glm::dvec3> nothing(problem.size(), glm::dvec3(0.0));
    return finished(problem, {nothing, nothing}, std::move(report));
}

Result<Solved> solve(const Problem& problem, const FormFactors& factors,
                     const SolveSettings& settings, const JobContext& job,
                     const SolveObserver& observer, SolveKeeper* keeper) {
    if (!(emittedPower(problem) > 0.0))
        return darkness(problem);
    CHECK(settings.solver != Solver::Hierarchical);
    CHECK(problem.patches.empty() || shoots(settings.solver));
    return shoots(settings.solver) ? shootAll(problem, factors, settings, job, observer, keeper)
                                   : gatherAll(problem, factors, settings, job, observer, keeper);
}

} // namespace patina::radiosity
