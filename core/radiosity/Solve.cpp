#include "core/radiosity/Solve.h"

#include "core/base/Check.h"
#include "core/job/Parallel.h"
#include "core/radiosity/DirectSolution.h"
#include "core/radiosity/Gathering.h"
#include "core/trace/BakeInputs.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

namespace patina::radiosity {
namespace {

// How far a residual that shrinks by about the same factor with each step has come.
double progressOf(double residual, double first, double wanted) {
    if (!(residual > 0.0) || !(first > wanted) || !(wanted > 0.0))
        return 0.0;
    return std::clamp(std::log(first / residual) / std::log(first / wanted), 0.0, 1.0);
}

// Rows of elements that have shot, for when they shoot again: as many as the budget holds.
class RowCache {
  public:
    RowCache(const FormFactors& factors, std::size_t elements, std::size_t maxBytes)
        : m_factors(factors)
        , m_rows(elements)
        , m_maxBytes(maxBytes) {}

    // Those of some elements, computed side by side where they are not there.
    std::vector<const FactorRow*> rows(const std::vector<std::uint32_t>& elements,
                                       const JobContext& job) {
        m_scratch.resize(std::max(m_scratch.size(), elements.size()));
        parallelFor(job, elements.size(), 1, [&](std::size_t begin, std::size_t) {
            if (!m_rows[elements[begin]])
                m_factors.row(elements[begin], m_scratch[begin]);
        });
        std::vector<const FactorRow*> result;
        for (std::size_t i = 0; i < elements.size(); ++i) {
            std::unique_ptr<FactorRow>& kept = m_rows[elements[i]];
            const std::size_t size =
                sizeof(FactorRow) + m_scratch[i].shares.size() * sizeof(FactorRow::Share);
            if (!kept && (m_maxBytes == 0 || m_bytes + size <= m_maxBytes)) {
                kept = std::make_unique<FactorRow>(m_scratch[i]);
                kept->shares.shrink_to_fit();
                m_bytes += size;
            }
            result.push_back(kept ? kept.get() : &m_scratch[i]);
        }
        return result;
    }
    [[nodiscard]] std::size_t bytes() const { return m_bytes; }
    // Of each element; null where it was not computed or not kept.
    [[nodiscard]] std::vector<const FactorRow*> kept() const {
        std::vector<const FactorRow*> result;
        for (const std::unique_ptr<FactorRow>& row : m_rows)
            result.push_back(row.get());
        return result;
    }

  private:
    const FormFactors& m_factors;
    std::vector<std::unique_ptr<FactorRow>> m_rows;
    std::vector<FactorRow> m_scratch;
    std::size_t m_maxBytes, m_bytes = 0;
};

class Steps {
  public:
    Steps(const SolveSettings& settings, const JobContext& job, const SolveObserver& observer)
        : m_settings(settings)
        , m_job(job)
        , m_observer(observer) {}

    // Whether to go on after `iterations`.
    bool after(std::uint64_t iterations, double residual,
               const std::function<Solution()>& solution) {
        report.iterations = iterations;
        report.residual = residual;
        report.history.push_back(residual);
        report.converged = residual <= m_settings.residual;
        m_job.setProgress(progressOf(residual, report.history.front(), m_settings.residual));
        const bool enough = m_settings.maxIterations > 0 && iterations >= m_settings.maxIterations;
        const bool goOn = !m_observer || m_observer(iterations, residual, solution);
        return goOn && !report.converged && !enough && !m_job.stopping();
    }

    SolveReport report;

  private:
    const SolveSettings& m_settings;
    const JobContext& m_job;
    const SolveObserver& m_observer;
};

Solved finished(const Problem& problem, Solution solution, SolveReport report) {
    report.meanRadiosity = meanRadiosity(problem, solution.radiosity);
    return {std::move(solution), std::move(report)};
}

Result<Solved> shootAll(const Problem& problem, const FormFactors& factors,
                        const SolveSettings& settings, const JobContext& job,
                        const SolveObserver& observer) {
    Shooting shooting(problem,
                      settings.solver == Solver::Southwell ? ShootingRule::Residual
                                                           : ShootingRule::Power,
                      settings.solver == Solver::Overshooting);
    Steps steps(settings, job, observer);
    const std::size_t most = std::max<std::size_t>(settings.shotsPerStep, 1);
    RowCache cache(factors, problem.size(), settings.maxBytes);
    job.setActivity("shooting light");
    for (bool goOn = true; goOn;) {
        std::size_t count = most;
        if (settings.maxIterations > 0)
            count = static_cast<std::size_t>(
                std::min<std::uint64_t>(count, settings.maxIterations - shooting.shots()));
        const std::vector<std::uint32_t> next = shooting.next(count);
        const std::vector<const FactorRow*> rows = cache.rows(next, job);
        if (job.cancelled())
            return bakeCancelled();
        for (std::size_t i = 0; i < next.size(); ++i)
            shooting.shoot(next[i], *rows[i]);
        goOn = steps.after(shooting.shots(), shooting.residual(), [&] {
            return shooting.solution();
        }) && !next.empty();
    }
    steps.report.energy = shooting.energy();
    steps.report.factorBytes = cache.bytes();
    std::vector<glm::dvec3> shot, unshot;
    for (std::uint32_t e = 0; e < problem.size(); ++e) {
        unshot.push_back(shooting.unshot(e));
        shot.push_back(shooting.radiosity(e) - unshot.back());
    }
    steps.report.bound = shootingBound(problem, cache.kept(), shot, unshot);
    return finished(problem, shooting.solution(), std::move(steps.report));
}

Result<Solved> gatherAll(const Problem& problem, const FormFactors& factors,
                         const SolveSettings& settings, const JobContext& job,
                         const SolveObserver& observer) {
    job.setActivity("computing form factors");
    auto matrix =
        FactorMatrix::compute(factors, problem.size(), settings.maxBytes, job.part(0.0, 0.8));
    if (!matrix)
        return matrix.error();
    job.setActivity("gathering light");
    const JobContext rest = job.part(0.8, 1.0);
    Steps steps(settings, rest, observer);
    steps.report.quality = qualityOf(*matrix, problem.areas);
    steps.report.factorBytes = matrix->memoryBytes();
    if (settings.solver == Solver::Direct) {
        auto solution = directSolution(problem, *matrix, rest);
        if (!solution)
            return solution.error();
        steps.after(1, 0.0, [&] { return *solution; });
        steps.report.bound = gatheringBound(problem, *matrix, solution->radiosity);
        return finished(problem, std::move(*solution), std::move(steps.report));
    }
    Gathering gathering(problem, *matrix,
                        settings.solver == Solver::Jacobi ? Sweep::Jacobi : Sweep::GaussSeidel);
    for (std::uint64_t sweep = 1;; ++sweep) {
        gathering.sweep(rest);
        const double residual = gathering.residual(rest);
        if (job.cancelled())
            return bakeCancelled();
        if (!steps.after(sweep, residual, [&] { return gathering.solution(); }))
            break;
    }
    steps.report.bound = gatheringBound(problem, *matrix, gathering.solution().radiosity);
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

Error nothingEmitsLight() {
    return Error{
        ErrorKind::InputBroken,
        "Nothing in the scene gives light; add a light or an environment, or give a material "
        "emission.",
        {},
        {}};
}

Result<Solved> solve(const Problem& problem, const FormFactors& factors,
                     const SolveSettings& settings, const JobContext& job,
                     const SolveObserver& observer) {
    if (!(emittedPower(problem) > 0.0))
        return nothingEmitsLight();
    CHECK(settings.solver != Solver::Hierarchical);
    return shoots(settings.solver) ? shootAll(problem, factors, settings, job, observer)
                                   : gatherAll(problem, factors, settings, job, observer);
}

} // namespace patina::radiosity
