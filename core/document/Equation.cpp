#include "core/document/Equation.h"

#include "core/light/Light.h"

#include <algorithm>
#include <iterator>

namespace patina {
namespace {

using namespace shading;

constexpr float kInversePi = 0.318309886f;

constexpr EquationPart kSum[] = {{Join::Plus, kViewDiffuseIbl},
                                 {Join::Plus, kViewSpecularIbl},
                                 {Join::Plus, kViewDirectDiffuse},
                                 {Join::Plus, kViewDirectSpecular},
                                 {Join::Plus, kViewEmissive}};
static_assert(std::size(kSum) == kTermCount);

// shaders/shared/ibl.glsl, shadeIrradiance().
constexpr EquationPart kDiffuseIbl[] = {{Join::Plus, kViewDiffuseAlbedo},
                                        {Join::Times, kViewTransmission},
                                        {Join::Times, kViewIrradiance, kInversePi},
                                        {Join::Times, kViewDiffuseOcclusion}};

constexpr EquationPart kDiffuseIblAndThrough[] = {{Join::Plus, kViewDiffuseAlbedo},
                                                  {Join::Times, kViewTransmission},
                                                  {Join::Times, kViewIrradiance, kInversePi},
                                                  {Join::Times, kViewDiffuseOcclusion},
                                                  {Join::Plus, kViewThrough}};

// shadePrefiltered(), with specularAlbedo() and specularOcclusion().
constexpr EquationPart kSpecularIbl[] = {{Join::Plus, kViewPrefiltered},
                                         {Join::Times, kViewSingleScatterAlbedo},
                                         {Join::Times, kViewMultiScatterGain},
                                         {Join::Times, kViewSpecularOcclusion}};

// singleScatterAlbedo(): Schlick's equation splits into scale and bias; for the others the table's
// E = A + B meets a mean Fresnel reflectance.
constexpr EquationPart kSplitAlbedo[] = {
    {Join::Plus, kViewF0}, {Join::Times, kViewDfgScale}, {Join::Plus, kViewDfgBias}};
constexpr EquationPart kMeanAlbedo[] = {
    {Join::Plus, kViewDfgScale}, {Join::Plus, kViewDfgBias}, {Join::Times, kViewIblFresnel}};

// shaders/shared/brdf.glsl, shadeDirect(), diffuseLobe() and specularLobe(). The visibility term is
// G / (4 N·L N·V), so that the N·L of the specular lobe cancels.
constexpr EquationPart kDirectDiffuse[] = {{Join::Plus, kViewDiffuseLobe},
                                           {Join::Times, kViewTransmission},
                                           {Join::Times, kViewNoL},
                                           {Join::Times, kViewLightArriving, kInversePi},
                                           {Join::Times, kViewShadow}};
constexpr EquationPart kDirectSpecular[] = {
    {Join::Plus, kViewD},      {Join::Times, kViewG},
    {Join::Times, kViewF},     {Join::Times, kViewMultiScatterGain},
    {Join::Over, kViewNoV, 4}, {Join::Times, kViewLightArriving},
    {Join::Times, kViewShadow}};

} // namespace

std::optional<Equation> equationOf(ViewKind opened, const ShadingModel& model, bool transmits) {
    switch (opened) {
    case kViewFinal:
        return Equation{opened, opened, kSum};
    case kViewDiffuseIbl:
        if (transmits)
            return Equation{opened, opened, kDiffuseIblAndThrough};
        return Equation{opened, opened, kDiffuseIbl};
    case kViewSpecularIbl:
        return Equation{opened, opened, kSpecularIbl};
    case kViewSingleScatterAlbedo:
        if (model.fresnel == Fresnel::Schlick)
            return Equation{opened, opened, kSplitAlbedo};
        return Equation{opened, opened, kMeanAlbedo};
    case kViewDirectDiffuse:
        return Equation{opened, kViewLightDiffuse, kDirectDiffuse};
    case kViewDirectSpecular:
        return Equation{opened, kViewLightSpecular, kDirectSpecular};
    default:
        return {};
    }
}

bool hasFactors(LightType type) {
    return type == LightType::Directional || type == LightType::Point || type == LightType::Spot;
}

bool closesBracket(const Equation& equation, std::size_t index) {
    if (index == 0 || equation.parts[index].join == Join::Plus)
        return false;
    const auto plus = [](const EquationPart& part) { return part.join == Join::Plus; };
    const auto before = equation.parts.subspan(1, index - 1);
    return equation.parts[index - 1].join == Join::Plus &&
           std::any_of(before.begin(), before.end(), plus);
}

} // namespace patina
