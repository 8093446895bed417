#include "core/radiosity/Problem.h"

namespace patina::radiosity {

double emittedPower(const Problem& problem) {
    double sum = 0.0;
    for (std::size_t e = 0; e < problem.size(); ++e)
        sum += problem.areas[e] * magnitude(problem.emission[e]);
    return sum;
}

} // namespace patina::radiosity
