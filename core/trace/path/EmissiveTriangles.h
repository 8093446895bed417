// Surfaces that give off light, as sources that rays are sent to.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace patina {

// Triangles are chosen as their area times the luminance of their factor of emission, whatever
// their maps say; within one all points are alike.
class EmissiveTriangles {
  public:
    struct Triangle {
        std::uint32_t mesh = 0, index = 0; // index: of the mesh's triangles
    };
    // `area`: m²; `luminance`: of the radiance that its map multiplies. Those of no power are left
    // out, and never chosen.
    void add(const Triangle& triangle, double area, double luminance);
    void finish(); // once all are added

    [[nodiscard]] bool empty() const { return m_triangles.empty(); }
    [[nodiscard]] std::size_t size() const { return m_triangles.size(); }
    [[nodiscard]] const Triangle& triangle(std::size_t i) const { return m_triangles[i]; }
    // Area times luminance, of one and of all.
    [[nodiscard]] double power(std::size_t i) const {
        return i == 0 ? m_sums[0] : m_sums[i] - m_sums[i - 1];
    }
    [[nodiscard]] double power() const { return m_power; }
    [[nodiscard]] const Triangle&
    sample(float u) const; // u in [0, 1); for those that are not empty
    // Per square metre, of a point on such a triangle: that of the choice over its area.
    [[nodiscard]] float density(double luminance) const {
        return m_power > 0.0 ? static_cast<float>(luminance / m_power) : 0.0f;
    }

    // Barycentric weights of the second and third corner, even over the triangle. Heitz 2019, "A
    // Low-Distortion Map Between Triangle and Square".
    [[nodiscard]] static glm::vec2 point(const glm::vec2& u);

  private:
    std::vector<Triangle> m_triangles;
    std::vector<double> m_sums; // of power
    double m_power = 0.0;
};

} // namespace patina
