// Solves the equation of radiosity by any of the solvers until it is as exact as asked for.
#pragma once

#include "core/base/Result.h"
#include "core/job/JobContext.h"
#include "core/radiosity/ErrorBound.h"
#include "core/radiosity/FactorMatrix.h"
#include "core/radiosity/Problem.h"
#include "core/radiosity/Shooting.h"
#include "core/radiosity/SolveKeeper.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

namespace patina::radiosity {

enum class Solver {
    Progressive,  // shooting, the largest unshot power first
    Southwell,    // shooting, the largest unshot radiosity first
    Overshooting, // progressive, ahead of what will be received
    Jacobi,
    GaussSeidel,
    Direct,
    Hierarchical, // links between clusters of elements: solveHierarchical()
};

[[nodiscard]] std::string_view name(Solver solver); // as the command line has it
// Needs a row at a time, and keeps as many as there is room for; the others need all of them.
[[nodiscard]] bool shoots(Solver solver);
[[nodiscard]] ShootingRule shootingRule(Solver solver); // of one that shoots

struct SolveSettings {
    Solver solver = Solver::GaussSeidel;
    double residual = 1e-3;                      // where to stop: Σ A |B - E - ρ F B| / Σ A E
    std::uint64_t maxIterations = 0;             // shots or sweeps; 0: no limit
    std::size_t shotsPerStep = 1;                // chosen together; 1: each knows all before it
    std::size_t maxBytes = std::size_t{2} << 30; // of form factors that are kept; 0: no limit
    friend bool operator==(const SolveSettings&, const SolveSettings&) = default;
};

struct LinkReport {
    std::size_t first = 0, last = 0; // links: those to begin with, and in the end
    std::size_t treeBytes = 0;       // of clusters and their light
};

struct SolveReport {
    std::uint64_t iterations = 0; // shots or sweeps
    double residual = 0.0;
    bool converged = false; // residual is what was asked for
    std::size_t factorBytes = 0;
    std::size_t rows = 0, shares = 0;     // of form factors that are kept: of senders, of elements
    std::optional<FactorQuality> quality; // where all factors are kept
    std::optional<Shooting::Energy> energy; // of shooting
    std::optional<ErrorBound> bound;        // nothing: light is never lost, so that there is none
    double meanRadiosity = 0.0;             // W/m², as patina::radiosity::meanRadiosity()
    std::optional<LinkReport> links;        // of Solver::Hierarchical
    std::vector<double> history;            // residual after each step
};

struct Solved {
    Solution solution;
    SolveReport report;
};

// Told after every step (some shots, or a sweep); false: stop here and keep what there is.
using SolveObserver = std::function<bool(std::uint64_t iterations, double residual,
                                         const std::function<Solution()>& solution)>;

// Of a problem in which no element sends light: every irradiance is zero.
[[nodiscard]] Solved darkness(const Problem& problem);

// By any solver but Hierarchical; where problem.patches has some, by one that shoots.
// Where no element sends light (all that is lit is black) nothing is left to solve.
// `job.stopping()` ends it with what there is. Errors: Cancelled; those of FactorMatrix::compute()
// and directSolution(). `keeper`: its state() is where the solution begins, and what it is worked
// on in.
Result<Solved> solve(const Problem& problem, const FormFactors& factors,
                     const SolveSettings& settings, const JobContext& job,
                     const SolveObserver& observer = {}, SolveKeeper* keeper = nullptr);

} // namespace patina::radiosity
