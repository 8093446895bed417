#include "core/radiosity/document/Discretisation.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <glm/common.hpp>
#include <numeric>

namespace patina {

using namespace radiosity;

Result<DiscretisationEstimate> estimateDiscretisation(const RadiosityScene& scene,
                                                      const Solution& solution,
                                                      const RadiositySettings& settings,
                                                      const JobContext& job) {
    const std::size_t coarse = scene.elements().size();
    if (4 * coarse > settings.maxElements)
        return Error{ErrorKind::Usage,
                     fmt::format("Dividing all {} elements once more makes more than the {} that "
                                 "are allowed; divide the scene less finely.",
                                 coarse, settings.maxElements),
                     {},
                     {}};
    job.setActivity("dividing once more");
    ElementMesh finer = scene.elements();
    std::vector<std::uint32_t> all(coarse);
    std::iota(all.begin(), all.end(), 0u);
    const std::vector<std::uint32_t> parents = finer.divide(all);
    finer.findBuried(*scene.scene().rays(), job.part(0.0, 0.1));
    SceneProblemSettings light;
    light.lightSamples = settings.lightSamples;
    light.seed = settings.factors.seed;
    light.glowByFactors = settings.classic;
    const auto lit = SceneProblem::make(scene.scene(), finer, light, job.part(0.1, 0.3));
    if (!lit)
        return lit.error();
    const auto factors = makeFormFactors(finer, *scene.scene().rays(), settings.factors);
    if (!factors)
        return factors.error();
    const auto solved = solve(lit->problem, **factors, settings.solve, job.part(0.3, 1.0));
    if (!solved)
        return solved.error();

    std::vector<glm::dvec3> sums(coarse, glm::dvec3(0.0));
    std::vector<double> areas(coarse, 0.0);
    for (std::uint32_t e = 0; e < finer.size(); ++e) {
        const double area = lit->problem.areas[e];
        sums[parents[e]] += area * lit->radiosity(solved->solution, e);
        areas[parents[e]] += area;
    }
    DiscretisationEstimate result;
    result.elements = finer.size();
    double squares = 0.0, area = 0.0;
    for (std::uint32_t e = 0; e < coarse; ++e) {
        const glm::dvec3 difference =
            glm::abs(sums[e] / areas[e] - scene.lit().radiosity(solution, e));
        const double largest = std::max({difference.x, difference.y, difference.z});
        result.largest = std::max(result.largest, largest);
        squares += areas[e] * largest * largest;
        area += areas[e];
    }
    result.rms = std::sqrt(squares / area);
    return result;
}

} // namespace patina
