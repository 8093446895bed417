#include "core/radiosity/Shooting.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace patina::radiosity {

Shooting::Shooting(const Problem& problem, ShootingRule rule, bool overshoot)
    : Shooting(problem, rule, overshoot,
               {std::vector<glm::dvec3>(problem.size(), glm::dvec3(0.0)),
                std::vector<glm::dvec3>(problem.size(), glm::dvec3(0.0))}) {
    for (std::size_t e = 0; e < problem.size(); ++e)
        m_state.unshotPower += problem.areas[e] * problem.emission[e];
}

Shooting::Shooting(const Problem& problem, ShootingRule rule, bool overshoot, State state)
    : m_problem(problem)
    , m_rule(rule)
    , m_overshoot(overshoot)
    , m_state(std::move(state))
    , m_areas(senderAreas(problem))
    , m_emitted(emittedPower(problem)) {
    for (std::size_t e = 0; e < problem.size(); ++e) {
        m_area += problem.areas[e];
        m_meanReflectance += problem.areas[e] * problem.reflectance[e];
    }
    if (m_area > 0.0)
        m_meanReflectance /= m_area;
    const auto senders = static_cast<std::uint32_t>(problem.senders());
    if (!problem.patches.empty()) {
        m_senderOf.resize(problem.size());
        for (std::uint32_t s = 0; s < senders; ++s)
            forElementsOf(problem, s, [&](std::uint32_t e) { m_senderOf[e] = s; });
    }
    m_unshot.resize(senders);
    m_changed.resize(senders);
    std::iota(m_changed.begin(), m_changed.end(), 0u);
    m_isChanged.assign(senders, true);
}

void Shooting::renew() const {
    for (const std::uint32_t s : m_changed) {
        m_unshot[s] = magnitude(unshotMean(s, glm::dvec3(0.0)));
        m_isChanged[s] = false;
    }
    m_changed.clear();
}

glm::dvec3 Shooting::radiosity(std::uint32_t e) const {
    return m_problem.emission[e] + m_problem.reflectance[e] * m_state.irradiance[e];
}

glm::dvec3 Shooting::unshot(std::uint32_t e) const {
    return radiosity(e) - m_state.shot[e];
}

glm::dvec3 Shooting::unshotMean(std::uint32_t sender, const glm::dvec3& ahead) const {
    const auto of = [&](std::uint32_t e) { return unshot(e) + m_problem.reflectance[e] * ahead; };
    if (m_problem.patches.empty())
        return of(sender);
    glm::dvec3 power(0.0);
    forElementsOf(m_problem, sender, [&](std::uint32_t e) { power += m_problem.areas[e] * of(e); });
    return power / m_areas[sender];
}

std::vector<std::uint32_t> Shooting::next(std::size_t count) const {
    std::vector<std::pair<double, std::uint32_t>> best; // the largest first
    const glm::dvec3 ahead = m_overshoot ? ambient() : glm::dvec3(0.0);
    if (!m_overshoot)
        renew();
    for (std::uint32_t s = 0; s < m_problem.senders(); ++s) {
        const double size = (m_overshoot ? magnitude(unshotMean(s, ahead)) : m_unshot[s]) *
                            (m_rule == ShootingRule::Power ? m_areas[s] : 1.0);
        if (!(size > 0.0) || (best.size() == count && size <= best.back().first))
            continue;
        const auto place =
            std::upper_bound(best.begin(), best.end(), size,
                             [](double value, const auto& other) { return value > other.first; });
        best.insert(place, {size, s});
        if (best.size() > count)
            best.pop_back();
    }
    std::vector<std::uint32_t> result;
    for (const auto& entry : best)
        result.push_back(entry.second);
    return result;
}

void Shooting::shoot(std::uint32_t sender, const FactorRow& row) {
    const glm::dvec3 ahead = m_overshoot ? ambient() : glm::dvec3(0.0);
    glm::dvec3 power(0.0);
    forElementsOf(m_problem, sender, [&](std::uint32_t e) {
        const glm::dvec3 light = unshot(e) + m_problem.reflectance[e] * ahead;
        m_state.shot[e] += light;
        power += m_problem.areas[e] * light;
    });
    send(sender, power, row);
    ++m_state.shots;
}

void Shooting::shootAgain(std::uint32_t sender, const FactorRow& row,
                          std::span<const glm::dvec3> light) {
    glm::dvec3 power(0.0);
    forElementsOf(m_problem, sender, [&](std::uint32_t e) {
        m_state.shot[e] += light[e];
        power += m_problem.areas[e] * light[e];
    });
    send(sender, power, row);
}

void Shooting::send(std::uint32_t sender, const glm::dvec3& power, const FactorRow& row) {
    const auto change = [&](std::uint32_t s) {
        if (!m_isChanged[s]) {
            m_isChanged[s] = true;
            m_changed.push_back(s);
        }
    };
    change(sender);
    m_state.unshotPower -= power;
    for (const FactorRow::Share& share : row.shares) {
        const glm::dvec3 arriving = double{share.factor} * power;
        m_state.irradiance[share.element] += arriving / m_problem.areas[share.element];
        m_state.unshotPower += m_problem.reflectance[share.element] * arriving;
        change(m_senderOf.empty() ? share.element : m_senderOf[share.element]);
    }
    m_state.lost += (double{row.absorbed} + double{row.escaped}) * power;
}

glm::dvec3 Shooting::ambient() const {
    glm::dvec3 sum = m_state.unshotPower;
    const glm::dvec3 left = glm::dvec3(1.0) - m_meanReflectance;
    for (int c = 0; c < 3; ++c)
        sum[c] = left[c] > 0.0 && m_area > 0.0 ? sum[c] / (m_area * left[c]) : 0.0;
    return sum;
}

Solution Shooting::solution() const {
    Solution result;
    result.irradiance = m_state.irradiance;
    for (std::uint32_t e = 0; e < m_problem.size(); ++e)
        result.radiosity.push_back(radiosity(e));
    return result;
}

double Shooting::residual() const {
    renew();
    double sum = 0.0;
    for (std::uint32_t s = 0; s < m_problem.senders(); ++s)
        sum += m_areas[s] * m_unshot[s];
    return m_emitted > 0.0 ? sum / m_emitted : 0.0;
}

Shooting::Energy Shooting::energy() const {
    const auto total = [](const glm::dvec3& v) { return v.x + v.y + v.z; };
    Energy energy;
    energy.emitted = m_emitted;
    energy.lost = total(m_state.lost);
    for (std::uint32_t e = 0; e < m_problem.size(); ++e) {
        energy.absorbed += m_problem.areas[e] * total((glm::dvec3(1.0) - m_problem.reflectance[e]) *
                                                      m_state.irradiance[e]);
        energy.unshot += m_problem.areas[e] * total(unshot(e));
    }
    return energy;
}

} // namespace patina::radiosity
