// When the parameters of the table have a say, and why not otherwise; only Parameters.cpp needs
// this.
#pragma once

#include "core/document/Document.h"
#include "core/document/Source.h"
#include "core/document/ToneResponse.h"
#include "core/document/ViewChoices.h"
#include "core/edit/Edit.h"
#include "core/edit/Parameters.h"
#include "core/light/Lights.h"
#include "core/material/Material.h"

namespace patina {

template <LightType... Types>
bool lightIsOne(const Document& document, Id id) {
    const LightType type = document.light(id)->type;
    return ((type == Types) || ...);
}
template <bool (*Has)(LightType)>
bool lightHas(const Document& document, Id id) {
    return Has(document.light(id)->type);
}
template <AlphaMode... Modes>
bool alphaIsOne(const Document& document, Id id) {
    const AlphaMode mode = document.material(id)->alphaMode;
    return ((mode == Modes) || ...);
}
template <Diffuse... Models>
bool diffuseIsOne(const Document& document, Id) {
    return ((document.model.diffuse == Models) || ...);
}
template <Fresnel F>
bool fresnelIs(const Document& document, Id) {
    return document.model.fresnel == F;
}
template <EnvironmentKind Kind>
bool environmentIs(const Document& document, Id id) {
    return document.environment(id)->kind == Kind;
}
template <BackgroundMode Mode>
bool backgroundIs(const Document& document, Id) {
    return document.view.background == Mode;
}
template <ToneMap Curve>
bool toneMapIs(const Document& document, Id) {
    return document.view.toneMap == Curve;
}

inline constexpr Condition kInCutOut{alphaIsOne<AlphaMode::Mask>,
                                     "only cut-out materials have it (material.alphaMode)"};
inline constexpr Condition kWithAlpha{alphaIsOne<AlphaMode::Mask, AlphaMode::Blend>,
                                      "the material is opaque (material.alphaMode)"};
inline constexpr Condition kInRoughDiffuse{
    diffuseIsOne<Diffuse::OrenNayar, Diffuse::Eon>,
    "only the diffuse models Oren-Nayar and EON have it (model.diffuse)"};

inline constexpr Condition kSolidGlass{
    [](const Document& document, Id id) {
        const Material& material = *document.material(id);
        return material.transmission > 0.0f && !material.thinWalled;
    },
    "only a solid body that transmits light has it (material.transmission, material.thinWalled)"};

inline constexpr Condition kInImage{environmentIs<EnvironmentKind::Image>,
                                    "the environment is no image (environment.kind)"};
inline constexpr Condition kInSky{environmentIs<EnvironmentKind::Sky>,
                                  "the environment is no sky (environment.kind)"};
inline constexpr Condition kInSoftboxes{environmentIs<EnvironmentKind::Softboxes>,
                                        "the environment has no softboxes (environment.kind)"};
inline constexpr Condition kInImageFile{
    [](const Document& document, Id id) {
        const Environment& environment = *document.environment(id);
        return environment.kind == EnvironmentKind::Image && !isBuiltin(environment.source);
    },
    "only an image from a file has a layout (environment.image)"};
inline constexpr Condition kWithSecond{
    [](const Document& document, Id) { return document.secondEnvironment() != nullptr; },
    "there is no second environment (environment.second)"};
inline constexpr Condition kBlurred{backgroundIs<BackgroundMode::Blurred>,
                                    "the background is not blurred (environment.background)"};
inline constexpr Condition kColored{backgroundIs<BackgroundMode::Color>,
                                    "the background is no colour (environment.background)"};

inline constexpr Condition kInSchlickF90{fresnelIs<Fresnel::SchlickF90>,
                                         "only Fresnel by Schlick with f90 has it (model.fresnel)"};
inline constexpr Condition kInDielectric{fresnelIs<Fresnel::Dielectric>,
                                         "only the exact dielectric has it (model.fresnel)"};
inline constexpr Condition kInConductor{fresnelIs<Fresnel::Conductor>,
                                        "only the exact conductor has it (model.fresnel)"};

inline constexpr Condition kInPhotographic{
    toneMapIs<ToneMap::ReinhardPhotographic>,
    "only Reinhard's photographic operator has it (view.toneMap)"};
inline constexpr Condition kInReinhard{[](const Document& document, Id) {
                                           const ToneMap curve = document.view.toneMap;
                                           return curve == ToneMap::Reinhard ||
                                                  curve == ToneMap::ReinhardPhotographic;
                                       },
                                       "only Reinhard's curves have it (view.toneMap)"};
inline constexpr Condition kMetered{
    [](const Document& document, Id) { return needsLuminance(document.view); },
    "the exposure is fixed (view.exposureMode, view.toneMap)"};
inline constexpr Condition kKeyByHand{
    [](const Document& document, Id) { return !document.view.reinhardAutoKey; },
    "the key is automatic (view.reinhardAutoKey)"};
inline constexpr Condition kInExponential{toneMapIs<ToneMap::Exponential>,
                                          "only the exponential curve has it (view.toneMap)"};
// OpenColorIO's views are made for their display.
inline constexpr Condition kNotInOpenColorIo{
    [](const Document& document, Id) { return document.view.toneMap != ToneMap::OpenColorIo; },
    "OpenColorIO brings its own (view.toneMap)"};
inline constexpr Condition kInGamma{[](const Document& document, Id) {
                                        return document.view.toneMap != ToneMap::OpenColorIo &&
                                               document.view.displayTransfer ==
                                                   DisplayTransfer::Gamma;
                                    },
                                    "the display is no pure power (view.displayTransfer)"};
inline constexpr Condition kWithLens{
    [](const Document& document, Id) { return document.view.camera.lens.depthOfField; },
    "the camera has no depth of field (view.depthOfField)"};
inline constexpr Condition kInRadiosity{
    [](const Document& document, Id) { return document.view.lighting == LightingMode::Radiosity; },
    "only radiosity has it (view.lighting)"};
template <RadiosityMethod Method>
bool radiosityFactorsAre(const Document& document, Id) {
    return document.view.lighting == LightingMode::Radiosity &&
           document.view.radiosityMethod == Method;
}
inline constexpr Condition kWithFactors{
    [](const Document& document, Id) {
        return document.view.radiositySolver != RadiositySolver::Hierarchical;
    },
    "hierarchical radiosity links clusters instead (view.radiositySolver)"};
inline constexpr Condition kByLinks{
    [](const Document& document, Id) {
        return document.view.lighting == LightingMode::Radiosity &&
               document.view.radiositySolver == RadiositySolver::Hierarchical;
    },
    "only hierarchical radiosity has links (view.lighting, view.radiositySolver)"};
inline constexpr Condition kWithShots{
    [](const Document& document, Id) {
        const RadiositySolver solver = document.view.radiositySolver;
        return document.view.lighting == LightingMode::Radiosity &&
               (solver == RadiositySolver::Progressive || solver == RadiositySolver::Southwell ||
                solver == RadiositySolver::Overshooting);
    },
    "only radiosity that shoots has it (view.lighting, view.radiositySolver)"};
inline constexpr Condition kDivided{
    [](const Document& document, Id) { return document.view.radiosityAdaptive > 0.0f; },
    "elements are not divided further (view.radiosityAdaptive)"};
inline constexpr Condition kByRays{
    radiosityFactorsAre<RadiosityMethod::Raycast>,
    "only radiosity by rays has it (view.lighting, view.radiosityMethod)"};
inline constexpr Condition kByHemicube{
    radiosityFactorsAre<RadiosityMethod::Hemicube>,
    "only radiosity by hemicubes has it (view.lighting, view.radiosityMethod)"};
inline constexpr Condition kByPolygons{
    radiosityFactorsAre<RadiosityMethod::Analytic>,
    "only radiosity by polygons has it (view.lighting, view.radiosityMethod)"};
inline constexpr Condition kByParaboloid{
    radiosityFactorsAre<RadiosityMethod::Paraboloid>,
    "only radiosity by paraboloids has it (view.lighting, view.radiosityMethod)"};
inline constexpr Condition kWithBounces{
    [](const Document& document, Id) { return bakedBounces(document) > 0; },
    "there is no radiance transfer bake with bounces"};

inline constexpr Condition kOfPlaced{lightHas<hasPosition>, "directional lights stand nowhere"};
inline constexpr Condition kOfDirected{lightHas<hasDirection>,
                                       "only directional lights, spots and rectangles have it"};
inline constexpr Condition kOfRectangles{lightIsOne<LightType::Rectangle>,
                                         "only rectangles have it"};
inline constexpr Condition kOfRanged{lightHas<hasRange>, "only points and spots have it"};
inline constexpr Condition kOfSpots{lightIsOne<LightType::Spot>, "only spots have it"};
inline constexpr Condition kOfSpheres{lightIsOne<LightType::Sphere>, "only spheres have it"};
inline constexpr Condition kOfCasters{lightHas<canCastShadow>,
                                      "only directional lights and spots cast shadows"};
inline constexpr Condition kColoredByHand{
    [](const Document& document, Id id) { return !document.light(id)->usesTemperature; },
    "the colour follows from the temperature (light.usesTemperature)"};
inline constexpr Condition kColoredByTemperature{
    [](const Document& document, Id id) { return document.light(id)->usesTemperature; },
    "the colour does not follow from the temperature (light.usesTemperature)"};
inline constexpr Condition kCasting{
    [](const Document& document, Id id) { return document.light(id)->castsShadow; },
    "the light casts no shadow (light.castsShadow)"};

} // namespace patina
