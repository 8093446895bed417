#include "core/radiosity/document/RadiositySteps.h"

#include "core/base/Check.h"

#include <cstddef>
#include <utility>

namespace patina {

using namespace radiosity;

RadiositySteps::RadiositySteps(LiveRadiosityPtr live, RadiosityStep unit)
    : m_live(std::move(live))
    , m_unit(unit) {
    CHECK(m_live->factors != nullptr);
    CHECK(unit == RadiosityStep::Shot || m_live->elements().patches().empty());
    begin();
}

void RadiositySteps::begin() {
    const Solver solver = m_live->settings.solve.solver;
    const Problem& problem = m_live->lit.problem;
    m_last.reset();
    if (m_unit == RadiosityStep::Shot) {
        m_shooting.emplace(problem, shootingRule(solver), solver == Solver::Overshooting);
        m_residuals = {m_shooting->residual()};
        return;
    }
    m_gathering.emplace(problem, m_live->factors->matrix,
                        solver == Solver::GaussSeidel ? Sweep::GaussSeidel : Sweep::Jacobi);
    m_before.assign(problem.size(), glm::dvec3(0.0));
    m_residuals = {m_gathering->residual({})};
}

std::uint64_t RadiositySteps::stepsPerRound() const {
    return m_unit == RadiosityStep::Shot ? m_live->elements().senderCount() : 1;
}

std::optional<std::uint32_t> RadiositySteps::next() const {
    if (!m_shooting)
        return std::nullopt;
    const std::vector<std::uint32_t> next = m_shooting->next(1);
    return next.empty() ? std::nullopt : std::optional(next.front());
}

bool RadiositySteps::atEnd() const {
    return m_residuals.back() <= m_live->settings.solve.residual || (m_shooting && !next());
}

void RadiositySteps::step(const JobContext& job) {
    if (m_shooting) {
        m_last = next();
        m_shooting->shoot(*m_last, m_live->factors->matrix.whole(*m_last));
        m_residuals.push_back(m_shooting->residual());
        return;
    }
    m_before = m_gathering->solution().radiosity;
    m_gathering->sweep(job);
    m_residuals.push_back(m_gathering->residual(job));
}

void RadiositySteps::goTo(std::uint64_t steps, const JobContext& job) {
    if (steps < done())
        begin();
    while (done() < steps && !atEnd() && !job.cancelled())
        step(job);
}

Solution RadiositySteps::solution() const {
    return m_shooting ? m_shooting->solution() : m_gathering->solution();
}

std::vector<glm::dvec3> RadiositySteps::unshot() const {
    std::vector<glm::dvec3> result;
    for (std::uint32_t e = 0; e < m_live->elements().size(); ++e)
        result.push_back(m_shooting ? m_shooting->unshot(e)
                                    : m_gathering->solution().radiosity[e] - m_before[e]);
    return result;
}

// Of Jacobi's sweeps: `m_before` has been sent, what arrived of it is the irradiance, and what that
// is reflected as has not been sent yet.
std::optional<Shooting::Energy> RadiositySteps::energy() const {
    if (m_shooting)
        return m_shooting->energy();
    if (m_live->settings.solve.solver == Solver::GaussSeidel)
        return std::nullopt;
    const Problem& problem = m_live->lit.problem;
    const Solution& light = m_gathering->solution();
    Shooting::Energy result;
    for (std::size_t e = 0; e < problem.size(); ++e) {
        const glm::dvec3 absorbed = (1.0 - problem.reflectance[e]) * light.irradiance[e];
        const glm::dvec3 lost = m_before[e] - light.irradiance[e];
        const glm::dvec3 unshot = light.radiosity[e] - m_before[e];
        for (int c = 0; c < 3; ++c) {
            result.emitted += problem.areas[e] * problem.emission[e][c];
            result.absorbed += problem.areas[e] * absorbed[c];
            result.lost += problem.areas[e] * lost[c];
            result.unshot += problem.areas[e] * unshot[c];
        }
    }
    return result;
}

} // namespace patina
