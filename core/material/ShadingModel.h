// Which formulas all surfaces of a scene are shaded with.
#pragma once

#include <glm/vec3.hpp>

namespace patina {

// Which terms make up the surface's reflection: shaders/shared/brdf.glsl has each of them. The
// enumerators' values are the numbers used there.
enum class Distribution { GGX, Beckmann, BlinnPhong };
enum class Visibility {
    SmithCorrelated,
    SmithSeparable,
    SchlickDirect, // Schlick-GGX, k = (r + 1)² / 8
    SchlickIbl,    // Schlick-GGX, k = alpha / 2
    Kelemen,
    Implicit
};
enum class Fresnel { Schlick, SchlickF90, Dielectric, Conductor };
enum class Diffuse { Lambert, Burley, OrenNayar, Eon };
// Where image-based specular light is looked up: along the lobe's mean direction, or classically
// along the mirror direction.
enum class LobeDirection { Mean, Mirror };

struct ShadingModel {
    Distribution distribution = Distribution::GGX;
    Visibility visibility = Visibility::SmithCorrelated;
    Fresnel fresnel = Fresnel::Schlick;
    Diffuse diffuse = Diffuse::Lambert;
    bool multiScatter = true; // energy compensation (Turquin 2019)
    LobeDirection lobeDirection = LobeDirection::Mean;
    float f90 = 1.0f;                          // SchlickF90: reflectance at grazing incidence
    float ior = 1.5f;                          // Dielectric: refractive index of non-metals
    glm::vec3 conductorN{0.18f, 0.42f, 1.37f}; // Conductor: complex index of metals, gold
    glm::vec3 conductorK{3.42f, 2.35f, 1.77f};
    friend bool operator==(const ShadingModel&, const ShadingModel&) = default;
};

} // namespace patina
