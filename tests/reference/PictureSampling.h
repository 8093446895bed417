// What PictureReference draws its rays with, and what it looks up in a material.
#pragma once

#include "core/material/MapUv.h"
#include "core/material/Material.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <numbers>

namespace patina::reference {

using std::numbers::pi;

// Steele, Lea & Flood 2014, "Fast Splittable Pseudorandom Number Generators".
class SplitMix {
  public:
    explicit SplitMix(std::uint64_t seed)
        : m_state(seed) {}
    std::uint64_t bits() {
        std::uint64_t z = m_state += 0x9e3779b97f4a7c15u;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        return z ^ (z >> 31);
    }
    double operator()() { return static_cast<double>(bits() >> 11) * 0x1p-53; } // in [0, 1)

  private:
    std::uint64_t m_state;
};

inline glm::dvec3 about(const glm::dvec3& axis, double cosine, double phi) {
    const glm::dvec3 side = glm::normalize(
        glm::cross(std::abs(axis.x) < 0.7 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0), axis));
    const double sine = std::sqrt(std::max(1.0 - cosine * cosine, 0.0));
    return glm::normalize(sine * std::cos(phi) * side +
                          sine * std::sin(phi) * glm::cross(axis, side) + cosine * axis);
}

inline glm::dvec3 inCone(const glm::dvec3& axis, double cosHalfAngle, SplitMix& random) {
    const double cosine = 1.0 - random() * (1.0 - cosHalfAngle);
    return about(axis, cosine, 2.0 * pi * random());
}

inline double coneAngle(double cosHalfAngle) { // solid
    return 2.0 * pi * (1.0 - cosHalfAngle);
}

inline glm::dvec4 mapAt(const MapSlot& map, const glm::vec2& uv) {
    if (!map.image)
        return glm::dvec4(1.0);
    const glm::vec2 at = mapUv(map, uv);
    return sampleBilinear(*map.image, at.x, at.y);
}

inline double alphaOf(const Material& material, const glm::vec2& uv) {
    if (material.alphaMode == AlphaMode::Opaque)
        return 1.0;
    const MapSlot& map = material.baseColorMap;
    const bool hasAlpha = map.image && map.image->channels() == 4;
    const double alpha =
        static_cast<double>(material.opacity) * (hasAlpha ? mapAt(map, uv).a : 1.0);
    if (material.alphaMode == AlphaMode::Mask)
        return alpha >= static_cast<double>(material.alphaCutoff) ? 1.0 : 0.0;
    return alpha;
}

inline glm::dvec3 glowOf(const Material& material, const glm::vec2& uv) {
    return glm::dvec3(material.emissive) * static_cast<double>(material.emissiveStrength) *
           glm::dvec3(mapAt(material.emissiveMap, uv));
}

// Trowbridge & Reitz 1975.
inline double facets(double NoH, double alpha) {
    const double a2 = alpha * alpha, d = NoH * NoH * (a2 - 1.0) + 1.0;
    return a2 / (pi * d * d);
}

} // namespace patina::reference
