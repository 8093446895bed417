// The light of a document as spherical harmonics, which is what precomputed transfer is multiplied
// with: the environment and distant lights in one sum; lights near by are seen differently
// from each point and are evaluated there (shaders/shared/nearlight.glsl).
#pragma once

#include "core/math/SphericalHarmonics.h"
#include "core/math/ZonalHarmonics.h"
#include "core/mix/LightMix.h"

#include <array>
#include <functional>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

namespace patina {

// Radiance coefficients of a part's picture as it is, neither turned nor scaled, of the order asked
// for or more; empty where they are not known yet.
using EnvironmentProjection = std::function<std::span<const glm::vec3>(const EnvironmentPart&)>;

// order² radiance coefficients in world space: the environments of the mix, turned and scaled, and
// every directional light that is on, as a disc of its softness (see discLight()). Where a part's
// projection is not known the picture of the whole mix stands in, and where that is not known there
// is no environment. order: 1 … kMaxShOrder.
[[nodiscard]] std::vector<glm::vec3> transferLight(const Document& document, int order,
                                                   const EnvironmentProjection& projection);

// The two parts of it. Of `parts` together; nothing where a projection is not known.
[[nodiscard]] std::optional<std::vector<glm::vec3>>
environmentLight(std::span<const EnvironmentPart> parts, int order,
                 const EnvironmentProjection& projection);
// The directional lights that shine are added to `sum`, order² coefficients.
void addDistantLights(const Document& document, int order, std::span<glm::vec3> sum);

// Lights near by that shine, as they are seen from `place` (world), are added to `sum`: what
// relight.comp does for each vertex.
void addNearLights(const Document& document, const glm::vec3& place, int order,
                   std::span<glm::vec3> sum);
// The same of one light, which is not directional, whether it is on or not.
void addNearLight(const Light& light, const glm::vec3& place, int order, std::span<glm::vec3> sum);

// A distant disc of light about +z, of irradiance 1 on a surface that faces it: damped so that no
// surface gets less than nothing of it (deringFactor()), and scaled so that the bands that are left
// out take nothing away. diameterDeg: 0 … 180; 0 is a point. Bands from `order` on are 0.
[[nodiscard]] ZonalHarmonics discLight(double diameterDeg, int order);

// What the bands from 1 on of light round about an axis are to be multiplied by so that no
// surface's irradiance is below zero; 1 where none is. For a point of light .86 at 3 bands and .89
// at 5. A window of Hann's or Lanczos' shape that does the same has to take away every band from 2
// on, and all shadows with them; this one keeps their shape.
[[nodiscard]] double deringFactor(const ZonalHarmonics& radiance, int order);

// Factors of the bands for lights near by, whose size differs from point to point: those of a point
// of light, which are enough for any light; 0 from `order` on.
[[nodiscard]] std::array<float, kMaxShOrder> nearLightWindow(int order);

} // namespace patina
