#include "core/document/Views.h"

#include "core/base/Check.h"
#include "core/document/View.h"

#include <algorithm>
#include <array>

namespace patina {
namespace {

using namespace shading;

constexpr auto kPicture = ViewGroup::Picture;
constexpr auto kMaterial = ViewGroup::Material;
constexpr auto kGeometry = ViewGroup::Geometry;
constexpr auto kFactors = ViewGroup::Factors;
constexpr auto kDirect = ViewGroup::Direct;
constexpr auto kIbl = ViewGroup::Ibl;
constexpr auto kLighting = ViewGroup::Lighting;

constexpr std::string_view kScaledLight = "The part of the picture that this factor scales.";

constexpr ViewInfo row(ViewKind kind, std::string_view id, std::string_view label,
                       std::string_view symbol, ViewGroup group, ViewValue value,
                       std::string_view help, std::string_view contribution = {}) {
    ViewInfo info;
    info.kind = kind;
    info.id = id;
    info.label = label;
    info.symbol = symbol;
    info.group = group;
    info.value = value;
    info.help = help;
    info.contribution = contribution;
    info.recorded = kind;
    info.exposed = value == ViewValue::Radiance;
    return info;
}
constexpr ViewInfo radiance(ViewKind kind, std::string_view id, std::string_view label,
                            std::string_view symbol, ViewGroup group, std::string_view help,
                            std::string_view contribution = {}) {
    ViewInfo info = row(kind, id, label, symbol, group, ViewValue::Radiance, help, contribution);
    info.unit = "cd/m²";
    return info;
}
constexpr ViewInfo color(ViewKind kind, std::string_view id, std::string_view label,
                         std::string_view symbol, ViewGroup group, std::string_view help,
                         std::string_view contribution = {}) {
    return row(kind, id, label, symbol, group, ViewValue::Color, help, contribution);
}
constexpr ViewInfo direction(ViewKind kind, std::string_view id, std::string_view label,
                             std::string_view symbol, std::string_view help) {
    ViewInfo info = row(kind, id, label, symbol, kGeometry, ViewValue::Direction, help);
    info.rangeMin = -1.0f;
    return info;
}
constexpr ViewInfo scalar(ViewKind kind, std::string_view id, std::string_view label,
                          std::string_view symbol, ViewGroup group, ColorMap map, float min,
                          float max, std::string_view help, std::string_view contribution = {}) {
    ViewInfo info = row(kind, id, label, symbol, group, ViewValue::Scalar, help, contribution);
    info.colorMap = map;
    info.rangeMin = min;
    info.rangeMax = max;
    return info;
}
constexpr ViewInfo judged(ViewKind kind, std::string_view id, std::string_view label,
                          std::string_view help) {
    ViewInfo info = row(kind, id, label, {}, kPicture, ViewValue::Picture, help);
    info.recorded = kViewFinal;
    return info;
}
constexpr ViewInfo identity(ViewKind kind, std::string_view id, std::string_view label,
                            std::string_view help) {
    return row(kind, id, label, {}, kGeometry, ViewValue::Identity, help);
}
// What a grey card of half the light would show of it.
constexpr ViewInfo irradiance(ViewInfo info) {
    info.displayScale = 0.5f * 0.318309886f;
    info.unit = "lx";
    return info;
}
constexpr ViewInfo luminance(ViewInfo info) {
    info.colorMap = ColorMap::Sequential;
    info.rangeMin = -6.0f;
    info.rangeMax = 6.0f;
    info.unit = "EV";
    return info;
}
constexpr ViewInfo inMaterials(ViewInfo info) {
    info.group = kMaterial;
    return info;
}
constexpr ViewInfo inTransfer(ViewInfo info) {
    info.group = kIbl;
    return info;
}
constexpr ViewInfo upTo(float rangeMax, ViewInfo info) {
    info.rangeMax = rangeMax;
    return info;
}
// A letter, or a function key, of views that are looked at often. W A S D Q E fly the camera, F, G
// and P are commands.
constexpr ViewInfo onKey(std::string_view key, ViewInfo info) {
    info.key = key;
    return info;
}
constexpr ViewInfo ofChosenLight(ViewInfo info) {
    info.ofChosenLight = true;
    return info;
}
constexpr ViewInfo ofTransfer(ViewInfo info) {
    info.ofTransfer = true;
    return info;
}
constexpr ViewInfo patterned(ViewInfo info) {
    info.coversSurface = false;
    return info;
}
// The picture, and something over it.
constexpr ViewInfo overPicture(ViewInfo info) {
    info.recorded = kViewFinal;
    info.exposed = true;
    return info;
}
// The picture, lit in another way.
constexpr ViewInfo lit(LightingMode lighting, std::string_view key, ViewInfo info) {
    info.recorded = kViewFinal;
    info.lighting = lighting;
    info.key = key;
    return info;
}
constexpr ViewInfo measured(ViewInfo info, std::string_view unit, bool logarithmic) {
    info.unit = unit;
    info.logarithmic = logarithmic;
    info.automaticRange = true;
    return info;
}

constexpr std::array<ViewInfo, kViewCount> kViews{{
    radiance(kViewFinal, "final", "Final", "L", kPicture,
             "The picture: every term of the shading equation together"),
    onKey("Y", luminance(judged(
                   kViewLuminance, "luminance", "Luminance",
                   "Luminance of the picture after exposure, in steps of EV around middle grey"))),
    judged(kViewInvalid, "invalid", "Invalid",
           "Marks pixels that are not a number (magenta), infinite (yellow) or negative (cyan)"),
    onKey("X",
          overPicture(judged(
              kViewClipped, "clipped", "Clipped",
              "Marks what the display cannot show: one channel clipped (red), all clipped (white), "
              "black (blue)"))),
    judged(kViewOutOfGamut, "outOfGamut", "Out of Gamut",
           "Marks colours outside of the sRGB gamut: a channel below zero before the display"),
    scalar(kViewFurnace, "furnace", "Energy", "ρ", kPicture, ColorMap::Diverging, 0.0f, 2.0f,
           "What the surface returns of a uniform environment of radiance 1: below 1 it absorbs, "
           "above 1 it makes energy"),

    onKey(
        "B",
        color(kViewBaseColor, "baseColor", "Base Colour", "", kMaterial,
              "Base colour with its map, linear",
              "The light that base colour tints: all diffuse light, and the reflection of metals")),
    onKey("M", scalar(kViewMetallic, "metallic", "Metallic", "", kMaterial, ColorMap::Grey, 0.0f,
                      1.0f, "Metallic with its map: 0 dielectric, 1 metal",
                      "The reflection of the metallic share")),
    onKey("R", scalar(kViewPerceptualRoughness, "perceptualRoughness", "Roughness", "r", kMaterial,
                      ColorMap::Grey, 0.0f, 1.0f, "Perceptual roughness with its map; α = r²",
                      "The reflections that it spreads")),
    color(kViewF0, "f0", "F0", "F0", kMaterial,
          "Share of the light that the surface reflects when it comes straight from above"),
    onKey("O", scalar(kViewAo, "ao", "Ambient Occlusion", "", kMaterial, ColorMap::Grey, 0.0f, 1.0f,
                      "Share of the environment that is not hidden: map or bake, with its strength",
                      "The image-based light that it takes away")),
    inMaterials(
        direction(kViewNormalMap, "normalMap", "Normal Map", "",
                  "The normal map in its tangent space, as OpenGL maps are stored (green up)")),
    radiance(kViewEmissive, "emissive", "Emission", "Lₑ", kMaterial,
             "Light that the material sends out by itself",
             "Emission as it stands in the picture's sum"),
    scalar(kViewAlpha, "alpha", "Opacity", "α", kMaterial, ColorMap::Grey, 0.0f, 1.0f,
           "Opacity: alpha of base colour with its map"),

    onKey("N", direction(kViewShadingNormal, "shadingNormal", "Shading Normal", "n",
                         "The normal that shading uses, normal map included, in world space")),
    direction(kViewGeometricNormal, "geometricNormal", "Geometric Normal", "nᵍ",
              "The normal of the triangle itself, in world space"),
    direction(kViewTangent, "tangent", "Tangent", "t",
              "The tangent, along which u grows, in world space"),
    direction(kViewBitangent, "bitangent", "Bitangent", "b",
              "The bitangent, along which v grows in OpenGL's sense, in world space"),
    onKey(
        "U",
        patterned(color(
            kViewUvChecker, "uvChecker", "UV Checker", "uv", kGeometry,
            "A board in texture space, red along u and green along v: shows stretching, mirroring "
            "and seams"))),
    measured(
        scalar(kViewTexelDensity, "texelDensity", "Texel Density", "", kGeometry,
               ColorMap::Sequential, 10.0f, 10000.0f,
               "Texels of the base colour map, or of a 1024² map when there is none, per metre"),
        "texel/m", true),
    identity(kViewMaterialId, "materialId", "Materials", "A colour for each material"),
    identity(kViewMeshId, "meshId", "Meshes", "A colour for each mesh"),
    onKey("Z", measured(scalar(kViewDepth, "depth", "Depth", "z", kGeometry, ColorMap::Sequential,
                               0.0f, 10.0f, "Distance from the camera's plane"),
                        "m", false)),
    onKey("H", overPicture(row(kViewWireframe, "wireframe", "Wireframe", {}, kGeometry,
                               ViewValue::Picture, "The edges of the triangles over the picture"))),
    overPicture(radiance(kViewFlat, "flat", "Flat Shading", "", kGeometry,
                         "The picture with the triangles' own normals")),

    ofChosenLight(measured(
        scalar(kViewD, "d", "D: Distribution", "D", kFactors, ColorMap::Sequential, 1e-3f, 1e3f,
               "Density of microfacets that face the half vector of the chosen direction",
               kScaledLight),
        "1/sr", true)),
    ofChosenLight(scalar(kViewG, "g", "G: Masking", "G", kFactors, ColorMap::Sequential, 0.0f, 1.0f,
                         "Share of those facets that light reaches and the viewer sees",
                         "The specular light that masking takes away")),
    ofChosenLight(
        color(kViewF, "f", "F: Fresnel", "F", kFactors,
              "Share of the light that a facet reflects at the angle of the half vector",
              "The specular light that Fresnel adds to the reflection at normal incidence")),
    ofChosenLight(measured(
        scalar(kViewDGF, "dgf", "Specular BRDF", "fₛ", kFactors, ColorMap::Sequential, 1e-3f, 1e3f,
               "D·G·F / (4 N·L N·V) of the chosen direction, by its luminance", kScaledLight),
        "1/sr", true)),
    ofChosenLight(color(
        kViewDiffuseLobe, "diffuseLobe", "Diffuse BRDF", "π f", kFactors,
        "The diffuse BRDF of the chosen direction times π, before kD: for Lambert its albedo")),
    ofChosenLight(scalar(kViewNoL, "nol", "N·L", "N·L", kFactors, ColorMap::Sequential, 0.0f, 1.0f,
                         "Cosine between normal and chosen direction", kScaledLight)),
    scalar(kViewNoV, "nov", "N·V", "N·V", kFactors, ColorMap::Sequential, 0.0f, 1.0f,
           "Cosine between normal and viewer"),
    ofChosenLight(scalar(kViewNoH, "noh", "N·H", "N·H", kFactors, ColorMap::Sequential, 0.0f, 1.0f,
                         "Cosine between normal and half vector")),
    ofChosenLight(scalar(kViewVoH, "voh", "V·H", "V·H", kFactors, ColorMap::Sequential, 0.0f, 1.0f,
                         "Cosine between viewer and half vector, which Fresnel depends on")),

    onKey("L", radiance(kViewDirect, "direct", "Direct Light", "", kDirect,
                        "Light of all analytic lights, shadows included; under transfer their "
                        "highlights alone")),
    radiance(kViewDirectDiffuse, "directDiffuse", "Direct Diffuse", "", kDirect,
             "Diffuse reflection of the analytic lights",
             "Direct diffuse light as it stands in the picture's sum"),
    radiance(kViewDirectSpecular, "directSpecular", "Direct Specular", "", kDirect,
             "Specular reflection of the analytic lights",
             "Direct specular light as it stands in the picture's sum"),
    ofChosenLight(scalar(kViewShadow, "shadow", "Shadow", "shadow", kDirect, ColorMap::Grey, 0.0f,
                         1.0f,
                         "Share of the chosen light, or of all that cast shadows, that arrives",
                         "The direct light that shadows take away")),
    ofChosenLight(irradiance(
        radiance(kViewLightArriving, "lightArriving", "Arriving Light", "E", kDirect,
                 "Illuminance of the chosen light, or of all but area lights, on a surface "
                 "that faces it, before shadow; shown as a grey card of 50 % would reflect "
                 "it"))),
    ofChosenLight(
        radiance(kViewLightDiffuse, "lightDiffuse", "Light: Diffuse", "", kDirect,
                 "Diffuse reflection of the chosen light alone, or of all when none is chosen")),
    ofChosenLight(
        radiance(kViewLightSpecular, "lightSpecular", "Light: Specular", "", kDirect,
                 "Specular reflection of the chosen light alone, or of all when none is chosen")),

    onKey("I", irradiance(radiance(
                   kViewIrradiance, "irradiance", "Irradiance", "E(n)", kIbl,
                   "Light from the whole environment that falls on the surface, before "
                   "occlusion; under transfer with it, and with that of lights; shown as a grey "
                   "card of 50 % would reflect it"))),
    radiance(kViewDiffuseIbl, "diffuseIbl", "Diffuse IBL", "", kIbl,
             "Diffuse reflection of the environment; under transfer of lights, too",
             "Diffuse image-based light as it stands in the picture's sum"),
    color(kViewDiffuseAlbedo, "diffuseAlbedo", "Diffuse Albedo", "ρ", kIbl,
          "What the diffuse lobe returns of uniform light, before kD: base colour × (1 - metallic) "
          "for "
          "Lambert, and what the other diffuse models make of it"),
    scalar(kViewDiffuseOcclusion, "diffuseOcclusion", "Diffuse AO", "AO", kIbl, ColorMap::Grey,
           0.0f, 1.0f,
           "What ambient occlusion leaves of the irradiance: 1 under radiance transfer, which "
           "includes the shadows"),
    onKey(
        "J",
        radiance(kViewPrefiltered, "prefiltered", "Prefiltered", "Lₚ", kIbl,
                 "The environment, blurred as the roughness asks, in the direction of reflection")),
    measured(scalar(kViewPrefilteredLevel, "prefilteredLevel", "Prefilter Level", "", kIbl,
                    ColorMap::Sequential, 0.0f, 21.0f,
                    "Which level of the prefiltered cube is read: 0 mirror, last fully rough"),
             "", false),
    scalar(kViewDfgScale, "dfgScale", "DFG Scale", "A", kIbl, ColorMap::Sequential, 0.0f, 1.0f,
           "A of the split sum F0·A + B: what F0 is multiplied with"),
    scalar(kViewDfgBias, "dfgBias", "DFG Bias", "B", kIbl, ColorMap::Sequential, 0.0f, 1.0f,
           "B of the split sum F0·A + B: what is added"),
    color(kViewIblFresnel, "iblFresnel", "IBL Fresnel", "F̄", kIbl,
          "Mean Fresnel reflectance over the lobe: (F0 A + B) / (A + B)",
          "The reflection that Fresnel adds to the one at normal incidence"),
    onKey("K", color(kViewTransmission, "kd", "kD", "kD", kIbl,
                     "Share that the specular layer lets through to the diffuse lobe: 1 - its "
                     "albedo; where the "
                     "mix fades reflections it takes less",
                     "The diffuse light that the specular layer takes away")),
    radiance(kViewSpecularIbl, "specularIbl", "Specular IBL", "", kIbl,
             "Specular reflection of the environment",
             "Specular image-based light as it stands in the picture's sum"),
    color(kViewSingleScatterAlbedo, "singleScatterAlbedo", "Specular Albedo", "F0·A + B", kIbl,
          "What the specular lobe returns of uniform light, reflected once: F0·A + B"),
    upTo(2.0f, color(kViewMultiScatterGain, "multiScatterGain", "Multi-Scatter", "gain", kIbl,
                     "Factor for light that is reflected more than once between facets; grey "
                     "is 1, which adds nothing",
                     "The reflection that multiple scattering adds")),
    scalar(kViewSpecularOcclusion, "specularOcclusion", "Specular AO", "AOₛ", kIbl, ColorMap::Grey,
           0.0f, 1.0f, "What ambient occlusion leaves of the reflected environment"),
    radiance(kViewAmbient, "ambient", "All IBL", "", kIbl,
             "Diffuse and specular reflection of the environment together"),
    ofTransfer(inTransfer(
        direction(kViewBentNormal, "bentNormal", "Bent Normal", "b",
                  "Mean direction that light of a uniform environment comes from, as the "
                  "transfer bake recorded it, in world space"))),
    ofTransfer(scalar(
        kViewSkyVisibility, "skyVisibility", "Sky Visibility", "", kIbl, ColorMap::Grey, 0.0f, 1.0f,
        "Share of the light of a uniform upper half of the environment that arrives, by the "
        "rays of the transfer bake")),
    ofTransfer(measured(
        scalar(kViewBakeError, "bakeError", "Bake Error", "σ", kIbl, ColorMap::Sequential, 0.0f,
               0.01f,
               "Estimated standard error of the transfer bake's coefficients: bright places "
               "want more rays"),
        "", false)),

    lit(LightingMode::Cosine, "F5",
        radiance(kViewCosineLight, "cosine", "N·L Light", "", kLighting,
                 "The picture under the dominant light of the environment")),
    lit(LightingMode::ShIrradiance, "F6",
        radiance(kViewShLight, "shIrradiance", "SH Irradiance", "", kLighting,
                 "The picture under irradiance from nine coefficients, nothing hidden")),
    lit(LightingMode::Unshadowed, "F7",
        radiance(kViewUnshadowedLight, "unshadowed", "Unshadowed", "", kLighting,
                 "The picture under transfer of an open sky, per vertex and in eight bands")),
    ofTransfer(
        lit(LightingMode::Shadowed, "F8",
            radiance(kViewShadowedLight, "shadowed", "Shadowed", "", kLighting,
                     "The picture under baked transfer: what the scene hides of the environment"))),
    ofTransfer(
        lit(LightingMode::Prt, "F9",
            radiance(kViewInterreflectedLight, "interreflected", "Interreflected", "", kLighting,
                     "The picture under baked transfer with light by way of other surfaces"))),
}};

constexpr bool numbered() {
    for (std::size_t i = 0; i < kViews.size(); ++i)
        if (kViews[i].kind != static_cast<ViewKind>(i))
            return false;
    return true;
}
static_assert(numbered(), "a row for every kView… of views.glsl, in its order");

constexpr bool keysDiffer() {
    for (std::size_t i = 0; i < kViews.size(); ++i)
        for (std::size_t j = 0; j < i; ++j)
            if (!kViews[i].key.empty() && kViews[i].key == kViews[j].key)
                return false;
    return true;
}
static_assert(keysDiffer(), "a key shows one view");

} // namespace

std::string_view viewGroupLabel(ViewGroup group) {
    constexpr std::array<std::string_view, kViewGroupCount> kLabels{
        "Picture",      "Material",          "Geometry", "BRDF Factors",
        "Direct Light", "Image-Based Light", "Lighting"};
    return kLabels[static_cast<std::size_t>(group)];
}

std::span<const ViewInfo> views() {
    return kViews;
}

const ViewInfo& viewInfo(ViewKind kind) {
    CHECK(kind >= 0 && kind < kViewCount);
    return kViews[static_cast<std::size_t>(kind)];
}

const ViewInfo* findView(std::string_view id) {
    const auto found = std::find_if(kViews.begin(), kViews.end(),
                                    [&](const ViewInfo& info) { return info.id == id; });
    return found == kViews.end() ? nullptr : &*found;
}

} // namespace patina
