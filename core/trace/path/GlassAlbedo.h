// How much of uniform light a rough dielectric sends to a viewer, both lobes together, when light
// that meets a second facet is lost. Dividing by it gives that light back.
#pragma once

#include <array>

namespace patina {

class GlassAlbedo {
  public:
    // As in GlassTerms. A wall's is the same for every index: its facets lose nothing.
    GlassAlbedo(float eta, bool thinWalled);

    // Above 0. Bilinear; in both numbers 0…1.
    [[nodiscard]] float at(float NoV, float perceptualRoughness) const;

  private:
    static constexpr int kSize = 16;
    std::array<float, kSize * kSize> m_values{}; // rows of NoV, by roughness
};

} // namespace patina
