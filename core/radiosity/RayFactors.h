// Malley's method: rays leave points all over an element or patch, as many to each direction as its
// cosine says; the share of them that meets another element is the form factor. Malley 1988, "A
// Shading Method for Computer Generated Images".
#pragma once

#include "core/radiosity/FormFactors.h"

namespace patina::radiosity {

class RayFactors final : public FormFactors {
  public:
    RayFactors(const ElementMesh& elements, const RayScene& rays, const FactorSettings& settings)
        : m_elements(elements)
        , m_rays(rays)
        , m_settings(settings) {}
    void row(std::uint32_t sender, FactorRow& row) const override;

  private:
    const ElementMesh& m_elements;
    const RayScene& m_rays;
    FactorSettings m_settings;
};

} // namespace patina::radiosity
