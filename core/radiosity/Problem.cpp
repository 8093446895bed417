#include "core/radiosity/Problem.h"

#include <algorithm>

namespace patina::radiosity {

double emittedPower(const Problem& problem) {
    double sum = 0.0;
    for (std::size_t e = 0; e < problem.size(); ++e)
        sum += problem.areas[e] * magnitude(problem.emission[e]);
    return sum;
}

double meanRadiosity(const Problem& problem, std::span<const glm::dvec3> radiosity) {
    glm::dvec3 sum(0.0);
    double area = 0.0;
    for (std::size_t e = 0; e < problem.size(); ++e) {
        sum += problem.areas[e] * radiosity[e];
        area += problem.areas[e];
    }
    return area > 0.0 ? std::max({sum.x, sum.y, sum.z}) / area : 0.0;
}

} // namespace patina::radiosity
