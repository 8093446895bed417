#include "core/radiosity/document/RadiositySteps.h"

#include "core/base/Check.h"

#include <utility>

namespace patina {

using namespace radiosity;

RadiositySteps::RadiositySteps(LiveRadiosityPtr live)
    : m_live(std::move(live))
    , m_shooting(begun()) {
    CHECK(m_live->factors != nullptr);
    m_residuals.push_back(m_shooting->residual());
}

Shooting RadiositySteps::begun() const {
    const Solver solver = m_live->settings.solve.solver;
    return {m_live->lit.problem, shootingRule(solver), solver == Solver::Overshooting};
}

std::optional<std::uint32_t> RadiositySteps::next() const {
    const std::vector<std::uint32_t> next = m_shooting->next(1);
    return next.empty() ? std::nullopt : std::optional(next.front());
}

bool RadiositySteps::atEnd() const {
    return m_residuals.back() <= m_live->settings.solve.residual || !next();
}

void RadiositySteps::goTo(std::uint64_t shots) {
    if (shots < m_shooting->shots()) {
        m_shooting.emplace(begun());
        m_last.reset();
        m_residuals.resize(1);
    }
    while (m_shooting->shots() < shots && !atEnd()) {
        m_last = next();
        m_shooting->shoot(*m_last, m_live->factors->matrix.whole(*m_last));
        m_residuals.push_back(m_shooting->residual());
    }
}

std::vector<glm::dvec3> RadiositySteps::unshot() const {
    std::vector<glm::dvec3> result;
    for (std::uint32_t e = 0; e < m_live->elements().size(); ++e)
        result.push_back(m_shooting->unshot(e));
    return result;
}

} // namespace patina
