// How much light matte surfaces get of an environment that face one way or another, and which of
// them get most and least.
#pragma once

#include "core/image/Image.h"

#include <glm/vec3.hpp>
#include <vector>

namespace patina {

struct LitSide {
    glm::dvec3 normal{0.0, -1.0, 0.0}; // unit
    double irradiance = 0.0;           // luminance
};

class LightSides {
  public:
    // `environment`: lat-long, F32, 3 channels, conventions of patina::Environment. It is taken as
    // patches of some 5.6°: the cosine between their middles and edges is .999.
    explicit LightSides(const Image& environment);

    [[nodiscard]] bool isBlack() const { return m_patches.empty(); } // no light from anywhere
    [[nodiscard]] double irradiance(const glm::dvec3& normal) const; // ∫ L max(0, n·l) dl
    [[nodiscard]] LitSide brightest() const { return extreme(-1.0); }
    [[nodiscard]] LitSide darkest() const { return extreme(1.0); }
    // Mean irradiance of all surfaces that face away from `normal`, each normal of that hemisphere
    // alike. The mean of max(0, l·n') over it is (1 - l·n) / 4: a lune of two half planes with the
    // normals l and -n has the vector area (l - n) π / 2, projected on l and over 2π.
    [[nodiscard]] double irradianceAway(const glm::dvec3& normal) const;

  private:
    struct Patch {
        glm::dvec3 direction;
        double light; // luminance · solid angle
    };

    [[nodiscard]] LitSide extreme(double sign) const; // of least (1) or most (-1) irradiance

    std::vector<Patch> m_patches; // those with light
};

} // namespace patina
