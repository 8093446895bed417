#include "core/trace/path/EmissiveTriangles.h"

#include <algorithm>

namespace patina {

void EmissiveTriangles::add(const Triangle& triangle, double area, double luminance) {
    const double power = area * luminance;
    if (!(power > 0.0))
        return;
    m_triangles.push_back(triangle);
    m_sums.push_back(m_power += power);
}

void EmissiveTriangles::finish() {
    m_triangles.shrink_to_fit();
    m_sums.shrink_to_fit();
}

const EmissiveTriangles::Triangle& EmissiveTriangles::sample(float u) const {
    const auto found = std::ranges::upper_bound(m_sums, static_cast<double>(u) * m_power);
    const auto index =
        std::min(static_cast<std::size_t>(found - m_sums.begin()), m_triangles.size() - 1);
    return m_triangles[index];
}

glm::vec2 EmissiveTriangles::point(const glm::vec2& u) {
    if (u.y > u.x)
        return {0.5f * u.x, u.y - 0.5f * u.x};
    return {u.x - 0.5f * u.y, 0.5f * u.y};
}

} // namespace patina
