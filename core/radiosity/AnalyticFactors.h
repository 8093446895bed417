// Form factors of polygons in closed form, times the share of the light between them that nothing
// stops: V = Σ w v / Σ w over pairs of points that rays join, w = cos cos' / r². The ratio leaves
// the closed form as it is where everything is visible. Baum et al. 1989; Heitz, Hill & McGuire
// 2018, "Combining Analytic Direct Illumination and Stochastic Shadows".
#pragma once

#include "core/radiosity/FormFactors.h"

namespace patina::radiosity {

class AnalyticFactors final : public FormFactors {
  public:
    AnalyticFactors(const ElementMesh& elements, const RayScene& rays,
                    const FactorSettings& settings);
    void row(std::uint32_t element, FactorRow& row) const override;

  private:
    // Of all pairs, the share that is exposed at both ends and has nothing in between.
    [[nodiscard]] double visibility(std::uint32_t a, std::uint32_t b) const;

    const ElementMesh& m_elements;
    const RayScene& m_rays;
    FactorSettings m_settings;
    struct Round {
        glm::dvec3 centre;
        double radius;
    };
    std::vector<Round> m_rounds; // about each element
};

} // namespace patina::radiosity
