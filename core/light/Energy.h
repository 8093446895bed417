// The energy of a reflection: what a surface gives back of light that arrives evenly from all
// sides, as in a white furnace, where a material that neither loses nor makes light cannot be seen.
#pragma once

#include "core/material/ShadingModel.h"
#include "core/math/Shading.h"

#include <functional>
#include <glm/vec3.hpp>

namespace patina {

// What the shading code knows of a material at one point.
using SurfacePoint = shading::SurfaceInputs;

// Shares of the light that arrives, by lobe, per channel: directional albedos.
struct Returned {
    glm::dvec3 specular{0.0}, diffuse{0.0};
    [[nodiscard]] glm::dvec3 total() const { return specular + diffuse; }
};

// Of light from all sides, as image-based light is shaded: makeSurface() with the model's DFG
// entries by estimateDfg(). NoV: 0…1, cosine of the view angle. Some microseconds.
[[nodiscard]] Returned returnedFromEnvironment(const ShadingModel& model, const SurfacePoint& point,
                                               float NoV);

// Of analytic lights from all sides: the reflection itself, shadeDirect(), integrated over the
// hemisphere; within 1e-3. It differs from the above by the approximations of either: the
// exact Fresnel equations at one angle there, Karis' k for lights and the least roughness here.
// About a tenth of a millisecond.
[[nodiscard]] Returned returnedFromLights(const ShadingModel& model, const SurfacePoint& point,
                                          float NoV);

// Seen from all sides, by what each side sees of the surface: 2 ∫ R(mu) mu dmu of either of them.
[[nodiscard]] Returned averageReturned(const std::function<Returned(float NoV)>& returned);

// Where all the light goes, per channel: the four add up to 1.
struct EnergyBalance {
    glm::dvec3 specular{0.0}, diffuse{0.0};
    glm::dvec3 absorbed{0.0}; // in the colour of the material: what it should keep
    // Between facets, because the model forgets light that bounces twice; what compensation brings
    // back. Below 0 where the model makes light (Blinn-Phong with Smith's terms).
    glm::dvec3 lost{0.0};
};

// Of what returns with and without compensation; the model's own choice says which one counts.
[[nodiscard]] EnergyBalance energyBalance(const Returned& single, const Returned& compensated,
                                          bool multiScatter);

// The share of the specular lobe that is lost between facets, per channel: 1 - E for a white metal.
[[nodiscard]] glm::dvec3 specularLoss(const Returned& single, const Returned& compensated);

// The model with its energy compensation on or off.
[[nodiscard]] ShadingModel withCompensation(ShadingModel model, bool multiScatter);

} // namespace patina
