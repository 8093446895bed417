// What the parameters of the table can be set to, where that is one of several: how each choice is
// called in files, and how it is shown.
#pragma once

#include "core/document/Document.h"
#include "core/document/ViewChoices.h"
#include "core/edit/Choices.h"
#include "core/light/Light.h"
#include "core/material/Material.h"

namespace patina {

inline constexpr Choices<NormalConvention, 2> kNormalConventions({
    {NormalConvention::OpenGl, "openGl", "OpenGL (Y+)"},
    {NormalConvention::DirectX, "directX", "DirectX (Y−)"},
});
inline constexpr Choices<AlphaMode, 3> kAlphaModes({
    {AlphaMode::Opaque, "opaque", "Opaque"},
    {AlphaMode::Mask, "mask", "Cut-out"},
    {AlphaMode::Blend, "blend", "Blend"},
});
inline constexpr Choices<LightType, 5> kLightTypes({
    {LightType::Point, "point", "Point"},
    {LightType::Directional, "directional", "Directional"},
    {LightType::Spot, "spot", "Spot"},
    {LightType::Sphere, "sphere", "Sphere (area)"},
    {LightType::Rectangle, "rectangle", "Rectangle (area)"},
});
inline constexpr Choices<EnvironmentLayout, 9> kEnvironmentLayouts({
    {EnvironmentLayout::Automatic, "automatic", "Automatic"},
    {EnvironmentLayout::LatLong, "latLong", "Lat-long"},
    {EnvironmentLayout::AngularMap, "angularMap", "Angular map"},
    {EnvironmentLayout::MirrorBall, "mirrorBall", "Mirror ball"},
    {EnvironmentLayout::HorizontalCross, "horizontalCross", "Horizontal cross"},
    {EnvironmentLayout::VerticalCross, "verticalCross", "Vertical cross"},
    {EnvironmentLayout::HorizontalStrip, "horizontalStrip", "Horizontal strip"},
    {EnvironmentLayout::VerticalStrip, "verticalStrip", "Vertical strip"},
    {EnvironmentLayout::SixFaces, "sixFaces", "Six faces"},
});
inline constexpr Choices<ToneMap, 8> kToneMaps({
    {ToneMap::Clamp, "clamp", "None (clamp)"},
    {ToneMap::Reinhard, "reinhard", "Reinhard"},
    {ToneMap::ReinhardPhotographic, "reinhardPhotographic", "Reinhard, photographic"},
    {ToneMap::Exponential, "exponential", "Exponential"},
    {ToneMap::PbrNeutral, "pbrNeutral", "PBR Neutral (Khronos)"},
    {ToneMap::Aces, "aces", "ACES (fitted)"},
    {ToneMap::AgX, "agx", "AgX"},
    {ToneMap::OpenColorIo, "openColorIo", "OpenColorIO"},
});
inline constexpr Choices<ExposureMode, 2> kExposureModes({
    {ExposureMode::Fixed, "fixed", "Fixed"},
    {ExposureMode::Automatic, "automatic", "Automatic"},
});
inline constexpr Choices<ExposureMeter, 2> kExposureMeters({
    {ExposureMeter::Surfaces, "surfaces", "Surfaces"},
    {ExposureMeter::Frame, "frame", "Whole frame"},
});
inline constexpr Choices<DisplayTransfer, 2> kDisplayTransfers({
    {DisplayTransfer::Srgb, "srgb", "sRGB"},
    {DisplayTransfer::Gamma, "gamma", "Gamma"},
});
inline constexpr Choices<EnvironmentKind, 3> kEnvironmentKinds({
    {EnvironmentKind::Image, "image", "Image"},
    {EnvironmentKind::Sky, "sky", "Sky"},
    {EnvironmentKind::Softboxes, "softboxes", "Softboxes"},
});
inline constexpr Choices<BackgroundMode, 4> kBackgrounds({
    {BackgroundMode::Environment, "environment", "Environment"},
    {BackgroundMode::Blurred, "blurred", "Blurred environment"},
    {BackgroundMode::Color, "color", "Colour"},
    {BackgroundMode::Off, "off", "Off (transparent)"},
});
inline constexpr Choices<LightingMode, 8> kLightings({
    {LightingMode::Ibl, "ibl", "Image-based light"},
    {LightingMode::Cosine, "cosine", "N·L"},
    {LightingMode::ShIrradiance, "shIrradiance", "SH irradiance"},
    {LightingMode::Unshadowed, "unshadowed", "Unshadowed transfer"},
    {LightingMode::Shadowed, "shadowed", "Shadowed transfer"},
    {LightingMode::Prt, "prt", "Interreflected transfer"},
    {LightingMode::LightMap, "lightMap", "Light map"},
    {LightingMode::Radiosity, "radiosity", "Radiosity"},
});
// In files as the command line has them.
inline constexpr Choices<RadiosityMethod, 4> kRadiosityMethods({
    {RadiosityMethod::Raycast, "raycast", "Rays"},
    {RadiosityMethod::Hemicube, "hemicube", "Hemicube"},
    {RadiosityMethod::Analytic, "analytic", "Polygons"},
    {RadiosityMethod::Paraboloid, "paraboloid", "Paraboloid"},
});
inline constexpr Choices<RadiosityDivision, 5> kRadiosityDivisions({
    {RadiosityDivision::Gradient, "gradient", "Gradient"},
    {RadiosityDivision::Visibility, "visibility", "Partial visibility"},
    {RadiosityDivision::L1, "l1", "Next order, L1"},
    {RadiosityDivision::L2, "l2", "Next order, L2"},
    {RadiosityDivision::Linf, "linf", "Next order, L∞"},
});
inline constexpr Choices<RadiositySolver, 7> kRadiositySolvers({
    {RadiositySolver::Gathering, "gathering", "Gauss-Seidel"},
    {RadiositySolver::Jacobi, "jacobi", "Gathering (Jacobi)"},
    {RadiositySolver::Progressive, "progressive", "Progressive shooting"},
    {RadiositySolver::Southwell, "southwell", "Shooting (Southwell)"},
    {RadiositySolver::Overshooting, "overshooting", "Overshooting"},
    {RadiositySolver::Direct, "direct", "Direct (exact)"},
    {RadiositySolver::Hierarchical, "hierarchical", "Hierarchical (links)"},
});
inline constexpr Choices<Distribution, 3> kDistributions({
    {Distribution::GGX, "ggx", "GGX"},
    {Distribution::Beckmann, "beckmann", "Beckmann"},
    {Distribution::BlinnPhong, "blinnPhong", "Blinn-Phong"},
});
inline constexpr Choices<Visibility, 6> kVisibilities({
    {Visibility::SmithCorrelated, "smithCorrelated", "Smith, correlated"},
    {Visibility::SmithSeparable, "smithSeparable", "Smith, separable"},
    {Visibility::SchlickDirect, "schlickDirect", "Schlick-GGX, lights"},
    {Visibility::SchlickIbl, "schlickIbl", "Schlick-GGX, IBL"},
    {Visibility::Kelemen, "kelemen", "Kelemen"},
    {Visibility::Implicit, "implicit", "Implicit"},
});
inline constexpr Choices<Fresnel, 4> kFresnels({
    {Fresnel::Schlick, "schlick", "Schlick"},
    {Fresnel::SchlickF90, "schlickF90", "Schlick with f90"},
    {Fresnel::Dielectric, "dielectric", "Exact dielectric"},
    {Fresnel::Conductor, "conductor", "Exact conductor"},
});
inline constexpr Choices<Diffuse, 4> kDiffuses({
    {Diffuse::Lambert, "lambert", "Lambert"},
    {Diffuse::Burley, "burley", "Burley"},
    {Diffuse::OrenNayar, "orenNayar", "Oren-Nayar"},
    {Diffuse::Eon, "eon", "EON"},
});
inline constexpr Choices<LobeDirection, 2> kLobeDirections({
    {LobeDirection::Mean, "mean", "The lobe's mean"},
    {LobeDirection::Mirror, "mirror", "Mirror direction"},
});

} // namespace patina
