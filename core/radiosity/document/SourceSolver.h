// The light of one source, solved step by step over form factors that are kept, by any solver but
// Hierarchical.
#pragma once

#include "core/base/Result.h"
#include "core/job/JobContext.h"
#include "core/radiosity/FactorMatrix.h"
#include "core/radiosity/Problem.h"
#include "core/radiosity/Solve.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace patina {

class SourceSolver {
  public:
    SourceSolver() = default;
    SourceSolver(const SourceSolver&) = delete;
    SourceSolver& operator=(const SourceSolver&) = delete;
    virtual ~SourceSolver() = default;
    // A sweep, about as many shots as a sixteenth of the elements, or all of it. Errors: those of
    // directSolution().
    virtual Result<void> step(const JobContext& job) = 0;
    // As SolveReport has it.
    [[nodiscard]] virtual double residual(const JobContext& job) const = 0;
    // By way of other elements, W/m².
    [[nodiscard]] virtual std::vector<glm::dvec3> irradiance() const = 0;
    [[nodiscard]] virtual std::uint64_t iterations() const = 0; // sweeps, or shots
};

// `problem` and `factors` must outlive it.
[[nodiscard]] std::unique_ptr<SourceSolver>
makeSourceSolver(const radiosity::SolveSettings& settings, const radiosity::Problem& problem,
                 const radiosity::FactorMatrix& factors);

} // namespace patina
