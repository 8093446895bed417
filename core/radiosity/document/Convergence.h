// How fast the solvers come to one solution over the same form factors.
#pragma once

#include "core/base/Result.h"
#include "core/job/JobContext.h"
#include "core/radiosity/document/LiveRadiosity.h"

#include <vector>

namespace patina {

struct ConvergenceCurve {
    radiosity::Solver solver = radiosity::Solver::Jacobi;
    struct Point {
        double rounds = 0.0;   // shots by senders, or sweeps: each takes as long
        double residual = 0.0; // as SolveReport has it
    };
    std::vector<Point> points; // the first before any step
};

// Each of Jacobi, GaussSeidel (both not of patches), Progressive and Overshooting until its
// residual is what the settings of `live` ask for, or for kConvergenceRounds. `live` has its form
// factors. Errors: Cancelled.
inline constexpr int kConvergenceRounds = 64;
[[nodiscard]] Result<std::vector<ConvergenceCurve>> convergence(const LiveRadiosity& live,
                                                                const JobContext& job);

} // namespace patina
