#include "core/radiosity/DirectSolution.h"

#include "core/radiosity/Gathering.h"
#include "core/trace/BakeInputs.h"

#include <Eigen/Dense>
#include <fmt/format.h>

namespace patina::radiosity {

Error tooManyForDirect(std::size_t elements) {
    return {
        ErrorKind::Usage,
        fmt::format("The direct solver takes {} elements at most, not {}; divide the scene less "
                    "finely, or choose another solver.",
                    kMaxDirect, elements),
        {},
        {}};
}

Result<Solution> directSolution(const Problem& problem, const FactorMatrix& factors,
                                const JobContext& job) {
    const std::size_t n = problem.size();
    if (n > kMaxDirect)
        return tooManyForDirect(n);
    Solution result;
    result.radiosity.assign(n, glm::dvec3(0.0));
    result.irradiance.assign(n, glm::dvec3(0.0));
    const auto size = static_cast<Eigen::Index>(n);
    for (int c = 0; c < 3; ++c) {
        if (job.cancelled())
            return bakeCancelled();
        Eigen::MatrixXd matrix = Eigen::MatrixXd::Identity(size, size);
        Eigen::VectorXd emission(size);
        for (std::uint32_t i = 0; i < n; ++i) {
            emission[i] = problem.emission[i][c];
            for (const FactorRow::Share& share : factors.row(i))
                matrix(i, share.element) -= problem.reflectance[i][c] * double{share.factor};
        }
        const Eigen::PartialPivLU<Eigen::MatrixXd> decomposition(matrix);
        const Eigen::VectorXd solution = decomposition.solve(emission);
        if (!solution.allFinite())
            return Error{ErrorKind::InputBroken,
                         "Light in this scene is never absorbed, so that it would grow without "
                         "end; give some surface a darker base colour.",
                         {},
                         {}};
        for (std::size_t i = 0; i < n; ++i)
            result.radiosity[i][c] = solution[static_cast<Eigen::Index>(i)];
    }
    for (std::uint32_t i = 0; i < n; ++i)
        result.irradiance[i] = gathered(factors, i, result.radiosity);
    return result;
}

} // namespace patina::radiosity
