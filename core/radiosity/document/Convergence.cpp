#include "core/radiosity/document/Convergence.h"

#include "core/base/Check.h"
#include "core/radiosity/Gathering.h"
#include "core/radiosity/Shooting.h"
#include "core/trace/BakeInputs.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace patina {

using namespace radiosity;

namespace {

constexpr std::size_t kPointsPerRound = 50; // of shots

ConvergenceCurve ofShots(const LiveRadiosity& live, Solver solver, const JobContext& job) {
    const Problem& problem = live.lit.problem;
    const double target = live.settings.solve.residual;
    ConvergenceCurve curve{solver, {}};
    Shooting shooting(problem, shootingRule(solver), solver == Solver::Overshooting);
    const std::size_t senders = live.elements().senderCount();
    const auto count = static_cast<double>(senders);
    const std::size_t every = std::max<std::size_t>(senders / kPointsPerRound, 1);
    curve.points.push_back({0.0, shooting.residual()});
    for (std::uint64_t shot = 1; shot <= senders * std::uint64_t{kConvergenceRounds}; ++shot) {
        const std::vector<std::uint32_t> next = shooting.next(1);
        if (next.empty() || job.cancelled())
            break;
        shooting.shoot(next.front(), live.factors->matrix.whole(next.front()));
        if (shot % every != 0)
            continue;
        curve.points.push_back({static_cast<double>(shot) / count, shooting.residual()});
        if (curve.points.back().residual <= target)
            break;
    }
    return curve;
}

ConvergenceCurve ofSweeps(const LiveRadiosity& live, Solver solver, const JobContext& job) {
    ConvergenceCurve curve{solver, {}};
    Gathering gathering(live.lit.problem, live.factors->matrix,
                        solver == Solver::GaussSeidel ? Sweep::GaussSeidel : Sweep::Jacobi);
    curve.points.push_back({0.0, gathering.residual(job)});
    for (int sweep = 1; sweep <= kConvergenceRounds && !job.cancelled() &&
                        curve.points.back().residual > live.settings.solve.residual;
         ++sweep) {
        gathering.sweep(job);
        curve.points.push_back({static_cast<double>(sweep), gathering.residual(job)});
    }
    return curve;
}

} // namespace

Result<std::vector<ConvergenceCurve>> convergence(const LiveRadiosity& live,
                                                  const JobContext& job) {
    CHECK(live.factors != nullptr);
    std::vector<ConvergenceCurve> curves;
    for (const Solver solver :
         {Solver::Jacobi, Solver::GaussSeidel, Solver::Progressive, Solver::Overshooting})
        if (shoots(solver))
            curves.push_back(ofShots(live, solver, job));
        else if (live.elements().patches().empty())
            curves.push_back(ofSweeps(live, solver, job));
    if (job.cancelled())
        return bakeCancelled();
    return curves;
}

} // namespace patina
