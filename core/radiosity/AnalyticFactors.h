// Form factors of polygons in closed form, times the share of the light between them that nothing
// stops: V = Σ w v / Σ w over pairs of points that rays join, w = cos cos' / r². The ratio leaves
// the closed form as it is where everything is visible. Baum et al. 1989; Heitz, Hill & McGuire
// 2018, "Combining Analytic Direct Illumination and Stochastic Shadows".
#pragma once

#include "core/radiosity/FormFactors.h"

namespace patina::radiosity {

// A sphere about an element, scene units.
struct ElementSphere {
    glm::dvec3 centre{0.0};
    double radius = 0.0;
};
[[nodiscard]] ElementSphere sphereOf(const ElementMesh& elements, const ElementMesh::Node& node);
[[nodiscard]] inline ElementSphere sphereOf(const ElementMesh& elements, std::uint32_t element) {
    return sphereOf(elements, elements.node(element));
}

// Area of `a` times its form factor to `b`, scene units²: what two elements exchange, obstacles
// included; the same whichever comes first, but for rounding. 0 where they cannot see one another.
[[nodiscard]] double visibleExchange(const ElementMesh& elements, const RayScene& rays,
                                     const FactorSettings& settings, std::uint32_t a,
                                     const ElementSphere& sphereA, std::uint32_t b,
                                     const ElementSphere& sphereB);

class AnalyticFactors final : public FormFactors {
  public:
    AnalyticFactors(const ElementMesh& elements, const RayScene& rays,
                    const FactorSettings& settings);
    void row(std::uint32_t sender, FactorRow& row) const override;

  private:
    const ElementMesh& m_elements;
    const RayScene& m_rays;
    FactorSettings m_settings;
    std::vector<ElementSphere> m_spheres;
};

} // namespace patina::radiosity
