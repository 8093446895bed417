// Every view of the shading equation: what surface.frag can record about a pixel. The C++ side, with
// labels, units and ranges, is core/document/Views.h. Each number follows from the one before: a new
// view is a line anywhere, and its name in the next line.
#ifndef PT_VIEWS_GLSL
#define PT_VIEWS_GLSL

#include "macros.glsl"

// Picture.
PT_CONST int kViewFinal = 0;
PT_CONST int kViewLuminance = kViewFinal + 1;
PT_CONST int kViewInvalid = kViewLuminance + 1;
PT_CONST int kViewClipped = kViewInvalid + 1;
PT_CONST int kViewOutOfGamut = kViewClipped + 1;
PT_CONST int kViewFurnace = kViewOutOfGamut + 1;

// Material.
PT_CONST int kViewBaseColor = kViewFurnace + 1;
PT_CONST int kViewMetallic = kViewBaseColor + 1;
PT_CONST int kViewPerceptualRoughness = kViewMetallic + 1;
PT_CONST int kViewF0 = kViewPerceptualRoughness + 1;
PT_CONST int kViewAo = kViewF0 + 1;
PT_CONST int kViewNormalMap = kViewAo + 1;
PT_CONST int kViewEmissive = kViewNormalMap + 1;
PT_CONST int kViewAlpha = kViewEmissive + 1;

// Geometry.
PT_CONST int kViewShadingNormal = kViewAlpha + 1;
PT_CONST int kViewGeometricNormal = kViewShadingNormal + 1;
PT_CONST int kViewTangent = kViewGeometricNormal + 1;
PT_CONST int kViewBitangent = kViewTangent + 1;
PT_CONST int kViewUvChecker = kViewBitangent + 1;
PT_CONST int kViewTexelDensity = kViewUvChecker + 1;
PT_CONST int kViewMaterialId = kViewTexelDensity + 1;
PT_CONST int kViewMeshId = kViewMaterialId + 1;
PT_CONST int kViewDepth = kViewMeshId + 1;
PT_CONST int kViewWireframe = kViewDepth + 1;
PT_CONST int kViewFlat = kViewWireframe + 1;

// Factors of the specular lobe, for the chosen direction.
PT_CONST int kViewD = kViewFlat + 1;
PT_CONST int kViewG = kViewD + 1;
PT_CONST int kViewF = kViewG + 1;
PT_CONST int kViewDGF = kViewF + 1;
PT_CONST int kViewDiffuseLobe = kViewDGF + 1;
PT_CONST int kViewNoL = kViewDiffuseLobe + 1;
PT_CONST int kViewNoV = kViewNoL + 1;
PT_CONST int kViewNoH = kViewNoV + 1;
PT_CONST int kViewVoH = kViewNoH + 1;

// Analytic lights.
PT_CONST int kViewDirect = kViewVoH + 1;
PT_CONST int kViewDirectDiffuse = kViewDirect + 1;
PT_CONST int kViewDirectSpecular = kViewDirectDiffuse + 1;
PT_CONST int kViewShadow = kViewDirectSpecular + 1;
PT_CONST int kViewLightArriving = kViewShadow + 1;
PT_CONST int kViewLightDiffuse = kViewLightArriving + 1;
PT_CONST int kViewLightSpecular = kViewLightDiffuse + 1;

// Image-based light.
PT_CONST int kViewIrradiance = kViewLightSpecular + 1;
PT_CONST int kViewDiffuseIbl = kViewIrradiance + 1;
PT_CONST int kViewDiffuseAlbedo = kViewDiffuseIbl + 1;
PT_CONST int kViewDiffuseOcclusion = kViewDiffuseAlbedo + 1;
PT_CONST int kViewPrefiltered = kViewDiffuseOcclusion + 1;
PT_CONST int kViewPrefilteredLevel = kViewPrefiltered + 1;
PT_CONST int kViewDfgScale = kViewPrefilteredLevel + 1;
PT_CONST int kViewDfgBias = kViewDfgScale + 1;
PT_CONST int kViewIblFresnel = kViewDfgBias + 1;
PT_CONST int kViewTransmission = kViewIblFresnel + 1;
PT_CONST int kViewSpecularIbl = kViewTransmission + 1;
PT_CONST int kViewSingleScatterAlbedo = kViewSpecularIbl + 1;
PT_CONST int kViewMultiScatterGain = kViewSingleScatterAlbedo + 1;
PT_CONST int kViewSpecularOcclusion = kViewMultiScatterGain + 1;
PT_CONST int kViewAmbient = kViewSpecularOcclusion + 1;

// What a bake of radiance transfer knows besides.
PT_CONST int kViewBentNormal = kViewAmbient + 1;
PT_CONST int kViewSkyVisibility = kViewBentNormal + 1;
PT_CONST int kViewBakeError = kViewSkyVisibility + 1;

// The picture in each lighting mode, whatever the document's is.
PT_CONST int kViewCosineLight = kViewBakeError + 1;
PT_CONST int kViewShLight = kViewCosineLight + 1;
PT_CONST int kViewUnshadowedLight = kViewShLight + 1;
PT_CONST int kViewShadowedLight = kViewUnshadowedLight + 1;
PT_CONST int kViewInterreflectedLight = kViewShadowedLight + 1;

PT_CONST int kViewCount = kViewInterreflectedLight + 1;

// What the explanation of a pixel needs besides; no views of their own.
PT_CONST int kRecordPosition = kViewCount;
PT_CONST int kRecordToViewer = kRecordPosition + 1;
PT_CONST int kRecordUv = kRecordToViewer + 1;
PT_CONST int kRecordDiffuseColor = kRecordUv + 1;
PT_CONST int kRecordSpecularAlbedo = kRecordDiffuseColor + 1;
PT_CONST int kRecordDfgMean = kRecordSpecularAlbedo + 1;
PT_CONST int kRecordLobeDirection = kRecordDfgMean + 1;
PT_CONST int kRecordToLight = kRecordLobeDirection + 1;
PT_CONST int kRecordVisibleCone = kRecordToLight + 1;
PT_CONST int kRecordTransfer = kRecordVisibleCone + 1; // 1: transfer has the diffuse part of lights, too

PT_CONST int kRecordCount = kRecordTransfer + 1;

#endif
