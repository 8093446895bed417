// Gathering: every element adds up what it receives from all others, sweep after sweep over a
// matrix of form factors that is kept.
#pragma once

#include "core/job/JobContext.h"
#include "core/radiosity/FactorMatrix.h"
#include "core/radiosity/Problem.h"

#include <utility>

namespace patina::radiosity {

enum class Sweep {
    Jacobi,      // all elements from the last sweep's radiosities
    GaussSeidel, // each from the newest ones: about half as many sweeps
};

class Gathering {
  public:
    // Starts with B = E. Row i of `factors` says where the light of element i comes from. Both must
    // outlive it.
    Gathering(const Problem& problem, const FactorMatrix& factors, Sweep sweep);
    // Starts where another one has been.
    Gathering(const Problem& problem, const FactorMatrix& factors, Sweep sweep, Solution solution)
        : m_problem(problem)
        , m_factors(factors)
        , m_sweep(sweep)
        , m_solution(std::move(solution)) {}

    void sweep(const JobContext& job); // Jacobi's on all cores; the same bits on any number of them
    [[nodiscard]] const Solution& solution() const { return m_solution; }
    // Σ A |B - E - ρ F B| / Σ A E.
    [[nodiscard]] double residual(const JobContext& job) const;

  private:
    const Problem& m_problem;
    const FactorMatrix& m_factors;
    Sweep m_sweep;
    Solution m_solution;
    std::vector<glm::dvec3> m_last;
};

// Σ_j F_ij B_j.
[[nodiscard]] glm::dvec3 gathered(const FactorMatrix& factors, std::uint32_t element,
                                  const std::vector<glm::dvec3>& radiosity);

} // namespace patina::radiosity
