#include "core/radiosity/Problem.h"

#include <algorithm>

namespace patina::radiosity {

double emittedPower(const Problem& problem) {
    double sum = 0.0;
    for (std::size_t e = 0; e < problem.size(); ++e)
        sum += problem.areas[e] * magnitude(problem.emission[e]);
    return sum;
}

std::vector<double> senderAreas(const Problem& problem) {
    if (problem.patches.empty())
        return problem.areas;
    std::vector<double> areas(problem.senders(), 0.0);
    for (std::uint32_t s = 0; s < areas.size(); ++s)
        forElementsOf(problem, s, [&](std::uint32_t e) { areas[s] += problem.areas[e]; });
    return areas;
}

std::vector<glm::dvec3> senderMeans(const Problem& problem,
                                    std::span<const glm::dvec3> ofElements) {
    if (problem.patches.empty())
        return {ofElements.begin(), ofElements.end()};
    std::vector<glm::dvec3> means(problem.senders(), glm::dvec3(0.0));
    for (std::uint32_t s = 0; s < means.size(); ++s) {
        double area = 0.0;
        forElementsOf(problem, s, [&](std::uint32_t e) {
            means[s] += problem.areas[e] * ofElements[e];
            area += problem.areas[e];
        });
        means[s] /= area;
    }
    return means;
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
