// The exact solution of the equation of radiosity on given form factors, to judge all others by.
// The only part of Patina that uses Eigen.
#pragma once

#include "core/base/Result.h"
#include "core/job/JobContext.h"
#include "core/radiosity/FactorMatrix.h"
#include "core/radiosity/Problem.h"

#include <cstddef>

namespace patina::radiosity {

inline constexpr std::size_t kMaxDirect = 2048; // elements: 32 MB of matrix

[[nodiscard]] Error tooManyForDirect(std::size_t elements);

// Solves (I - ρ F) B = E by LU decomposition, once per colour. Errors: Usage for more elements than
// kMaxDirect; InputBroken where nothing absorbs light, so that there is no solution; Cancelled.
Result<Solution> directSolution(const Problem& problem, const FactorMatrix& factors,
                                const JobContext& job);

} // namespace patina::radiosity
