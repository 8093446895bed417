#include "core/material/BrdfModel.h"

namespace patina {

// The shaders know the enumerators by their numbers.
static_assert(int(Distribution::GGX) == shading::kDistributionGGX);
static_assert(int(Distribution::Beckmann) == shading::kDistributionBeckmann);
static_assert(int(Distribution::BlinnPhong) == shading::kDistributionBlinnPhong);
static_assert(int(Visibility::SmithCorrelated) == shading::kVisibilitySmithCorrelated);
static_assert(int(Visibility::SmithSeparable) == shading::kVisibilitySmithSeparable);
static_assert(int(Visibility::SchlickDirect) == shading::kVisibilitySchlickDirect);
static_assert(int(Visibility::SchlickIbl) == shading::kVisibilitySchlickIbl);
static_assert(int(Visibility::Kelemen) == shading::kVisibilityKelemen);
static_assert(int(Visibility::Implicit) == shading::kVisibilityImplicit);
static_assert(int(Fresnel::Schlick) == shading::kFresnelSchlick);
static_assert(int(Fresnel::SchlickF90) == shading::kFresnelSchlickF90);
static_assert(int(Fresnel::Dielectric) == shading::kFresnelDielectric);
static_assert(int(Fresnel::Conductor) == shading::kFresnelConductor);
static_assert(int(Diffuse::Lambert) == shading::kDiffuseLambert);
static_assert(int(Diffuse::Burley) == shading::kDiffuseBurley);
static_assert(int(Diffuse::OrenNayar) == shading::kDiffuseOrenNayar);
static_assert(int(Diffuse::Eon) == shading::kDiffuseEon);
static_assert(int(LobeDirection::Mean) == shading::kLobeDirectionMean);
static_assert(int(LobeDirection::Mirror) == shading::kLobeDirectionMirror);

shading::BrdfModel brdfModel(const ShadingModel& model) {
    shading::BrdfModel m;
    m.distribution = static_cast<int>(model.distribution);
    m.visibility = static_cast<int>(model.visibility);
    m.fresnel = static_cast<int>(model.fresnel);
    m.diffuse = static_cast<int>(model.diffuse);
    m.multiScatter = model.multiScatter ? 1 : 0;
    m.lobeDirection = static_cast<int>(model.lobeDirection);
    m.f90 = model.f90;
    m.ior = model.ior;
    m.dielectricF0 = shading::kDielectricF0; // makeSurface() has that of the material
    m.conductorN = model.conductorN;
    m.conductorK = model.conductorK;
    return m;
}

} // namespace patina
