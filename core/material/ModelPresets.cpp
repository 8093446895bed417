#include "core/material/ModelPresets.h"

#include <array>

namespace patina {

namespace {

using D = Distribution;
using V = Visibility;
using F = Fresnel;
using B = Diffuse;
using L = LobeDirection;

const std::array<ModelPreset, 4> kPresets{{
    {"Patina",
     "The default: derived terms, energy kept, reflections looked up where the lobe looks.",
     ShadingModel{}},
    {"Exact",
     "Fresnel's equations for non-metals and EON for the body: closest to measured materials.",
     {D::GGX, V::SmithCorrelated, F::Dielectric, B::Eon, true, L::Mean}},
    {"Unreal Engine 4",
     "Karis 2013, what many engines still ship: Schlick's fits, and rough metals too dark.",
     {D::GGX, V::SchlickDirect, F::Schlick, B::Lambert, false, L::Mirror}},
    {"Blinn-Phong",
     "The look of old: round highlights without tails.",
     {D::BlinnPhong, V::Implicit, F::Schlick, B::Lambert, false, L::Mirror}},
}};

constexpr std::string_view kNobleMetals = "Johnson & Christy 1972, Phys. Rev. B 6, 4370";
constexpr std::string_view kTransitionMetals = "Johnson & Christy 1974, Phys. Rev. B 9, 5056";

// Linear interpolation of the published tables.
const std::array<Conductor, 6> kConductors{{
    {"Gold", {0.188f, 0.544f, 1.332f}, {3.403f, 2.231f, 1.869f}, kNobleMetals},
    {"Silver", {0.057f, 0.054f, 0.047f}, {4.254f, 3.429f, 2.803f}, kNobleMetals},
    {"Copper", {0.275f, 1.116f, 1.247f}, {3.372f, 2.596f, 2.456f}, kNobleMetals},
    {"Aluminium",
     {1.430f, 0.939f, 0.686f},
     {7.508f, 6.420f, 5.635f},
     "Rakić 1995, Appl. Opt. 34, 4755"},
    {"Iron", {2.892f, 2.895f, 2.646f}, {3.065f, 2.918f, 2.805f}, kTransitionMetals},
    {"Titanium", {2.698f, 2.479f, 2.305f}, {3.757f, 3.351f, 3.082f}, kTransitionMetals},
}};

} // namespace

std::span<const ModelPreset> modelPresets() {
    return kPresets;
}

bool sameChoices(const ShadingModel& a, const ShadingModel& b) {
    return a.distribution == b.distribution && a.visibility == b.visibility &&
           a.fresnel == b.fresnel && a.diffuse == b.diffuse && a.multiScatter == b.multiScatter &&
           a.lobeDirection == b.lobeDirection;
}

std::span<const Conductor> conductors() {
    return kConductors;
}

} // namespace patina
