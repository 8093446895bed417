// How far a solution is from the exact one of the same elements: what is left unsolved, and what
// form factors by rays may be off by. In the maximum norm, docs/maths/radiosity.md.
// As Lischinski, Smits & Greenberg 1994, "Bounds and Error Estimates for Radiosity".
#pragma once

#include "core/radiosity/FactorMatrix.h"
#include "core/radiosity/Problem.h"

#include <optional>
#include <span>

namespace patina::radiosity {

// Of radiosities, W/m²: no element's is further off, in any colour.
struct ErrorBound {
    double solving = 0.0; // what is left unsolved adds
    // What the rays of the form factors add, with a probability of kConfidence for all elements
    // together. Nothing: not known, as of form factors by other means than rays.
    std::optional<double> sampling;

    [[nodiscard]] std::optional<double> total() const {
        return sampling ? std::optional(solving + *sampling) : std::nullopt;
    }

    static constexpr double kConfidence = 0.999;
};

// Of a solution whose factors' row i says where the light of element i comes from. Nothing where
// light may never be absorbed, so that there is no bound.
[[nodiscard]] std::optional<ErrorBound> gatheringBound(const Problem& problem,
                                                       const FactorMatrix& factors,
                                                       std::span<const glm::dvec3> radiosity);

// Of a solution by shooting, of the same patches where there are some. `rows`: where the light of
// each sender arrived; of those that have sent light some may not be there: then sampling is not
// known. `shot`, `unshot`: of each element.
[[nodiscard]] std::optional<ErrorBound> shootingBound(const Problem& problem,
                                                      const FactorMatrix& rows,
                                                      std::span<const glm::dvec3> shot,
                                                      std::span<const glm::dvec3> unshot);

// Of a solution that is not known to be of any factors: `change` is what another sweep has changed,
// the largest of each colour.
[[nodiscard]] std::optional<ErrorBound> unsolvedBound(const Problem& problem,
                                                      const glm::dvec3& change);

// The z that normally distributed numbers exceed in size with that probability, 0…1.
[[nodiscard]] double normalDeviate(double outside);

// Standard error of each element's irradiance by rays, W/m², summed over the colours: gathered over
// the rows of `factors`, or of what each element has shot along those that are in `rows`. Of what
// is not by rays, and where few rays have all missed what is bright, it is less than there is.
[[nodiscard]] std::vector<double> gatheredNoise(const Problem& problem, const FactorMatrix& factors,
                                                std::span<const glm::dvec3> radiosity);
[[nodiscard]] std::vector<double> shotNoise(const Problem& problem, const FactorMatrix& rows,
                                            std::span<const glm::dvec3> shot);

} // namespace patina::radiosity
