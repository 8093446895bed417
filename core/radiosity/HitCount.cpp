#include "core/radiosity/HitCount.h"

#include <algorithm>

namespace patina::radiosity {

void HitCount::add(const ElementMesh& elements, const ClosestRay& ray, double weight) {
    const std::uint32_t element = elements.met(ray);
    if (element != kNone)
        add(element, weight);
    else if (ray.mesh != ClosestRay::kNothing)
        addAbsorbed(weight);
    else
        addEscaped(weight);
}

void HitCount::finish(FactorRow& row) {
    row.clear();
    // Stable, so that sums of different weights do not depend on the order of equal elements.
    std::stable_sort(m_hits.begin(), m_hits.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    double total = m_absorbed + m_escaped;
    for (const auto& hit : m_hits)
        total += hit.second;
    if (!(total > 0.0)) { // all of it is within something
        row.absorbed = 1.0f;
        return;
    }
    const double scale = 1.0 / total;
    for (std::size_t i = 0; i < m_hits.size();) {
        const std::uint32_t element = m_hits[i].first;
        double sum = 0.0;
        for (; i < m_hits.size() && m_hits[i].first == element; ++i)
            sum += m_hits[i].second;
        row.shares.push_back({element, static_cast<float>(sum * scale)});
    }
    row.absorbed = static_cast<float>(m_absorbed * scale);
    row.escaped = static_cast<float>(m_escaped * scale);
    m_hits.clear();
    m_absorbed = m_escaped = 0.0;
}

} // namespace patina::radiosity
