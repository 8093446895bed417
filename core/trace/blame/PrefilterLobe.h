// The lobe that prefiltered levels are filtered with, exactly: without levels, texels or an
// interpolation between them. What the levels themselves are is core/light/Prefilter.h.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace patina {

// GGX with N = V = R (Karis 2013): radiance from l weighs D(h) max(N·L, 0), where h is half way
// between l and the axis; the weights integrate to 1 over the sphere.
class PrefilterLobe {
  public:
    // `axis`: unit; `alpha`: above 0.
    PrefilterLobe(const glm::vec3& axis, float alpha);

    [[nodiscard]] float weight(const glm::vec3& l) const; // per steradian
    [[nodiscard]] float pdf(const glm::vec3& l) const;    // of sample(), per steradian
    // `u` in [0, 1)². It may point below the axis' horizon, where nothing weighs.
    [[nodiscard]] glm::vec3 sample(const glm::vec2& u) const;

  private:
    // D at the half vector of the axis and l.
    [[nodiscard]] float density(const glm::vec3& l) const;

    glm::vec3 m_axis;
    float m_alpha, m_scale;
};

// ∫ D(h) max(N·L, 0) dl of that lobe: 1 at alpha = 1, towards 4 where it is narrow.
[[nodiscard]] double prefilterNorm(double alpha);

} // namespace patina
