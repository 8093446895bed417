#include "core/radiosity/Gathering.h"

#include "core/job/Parallel.h"

#include <cstddef>

namespace patina::radiosity {
namespace {

constexpr std::size_t kGrain = 256; // elements

} // namespace

glm::dvec3 gathered(const FactorMatrix& factors, std::uint32_t element,
                    const std::vector<glm::dvec3>& radiosity) {
    glm::dvec3 sum(0.0);
    for (const FactorRow::Share& share : factors.row(element))
        sum += double{share.factor} * radiosity[share.element];
    return sum;
}

Gathering::Gathering(const Problem& problem, const FactorMatrix& factors, Sweep sweep)
    : Gathering(problem, factors, sweep,
                {problem.emission, std::vector<glm::dvec3>(problem.size(), glm::dvec3(0.0))}) {}

void Gathering::sweep(const JobContext& job) {
    std::vector<glm::dvec3>& B = m_solution.radiosity;
    const auto gather = [&](std::size_t i, const std::vector<glm::dvec3>& from) {
        m_solution.irradiance[i] = gathered(m_factors, static_cast<std::uint32_t>(i), from);
        B[i] = m_problem.emission[i] + m_problem.reflectance[i] * m_solution.irradiance[i];
    };
    if (m_sweep == Sweep::GaussSeidel) {
        for (std::size_t i = 0; i < m_problem.size(); ++i)
            gather(i, B);
        return;
    }
    m_last = B;
    parallelFor(job, m_problem.size(), kGrain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            gather(i, m_last);
    });
}

double Gathering::residual(const JobContext& job) const {
    const std::vector<glm::dvec3>& B = m_solution.radiosity;
    std::vector<double> parts((m_problem.size() + kGrain - 1) / kGrain, 0.0);
    parallelFor(job, m_problem.size(), kGrain, [&](std::size_t begin, std::size_t end) {
        double sum = 0.0;
        for (std::size_t i = begin; i < end; ++i)
            sum += m_problem.areas[i] *
                   magnitude(B[i] - m_problem.emission[i] -
                             m_problem.reflectance[i] *
                                 gathered(m_factors, static_cast<std::uint32_t>(i), B));
        parts[begin / kGrain] = sum;
    });
    double total = 0.0;
    for (const double part : parts)
        total += part;
    const double emitted = emittedPower(m_problem);
    return emitted > 0.0 ? total / emitted : 0.0;
}

} // namespace patina::radiosity
