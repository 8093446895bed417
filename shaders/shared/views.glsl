// Every view of the shading equation: what surface.frag can record about a pixel. The C++ side, with
// labels, units and ranges, is core/document/Views.h.
#ifndef PT_VIEWS_GLSL
#define PT_VIEWS_GLSL

#include "macros.glsl"

// Picture.
PT_CONST int kViewFinal = 0;
PT_CONST int kViewLuminance = 1;
PT_CONST int kViewInvalid = 2;
PT_CONST int kViewClipped = 3;
PT_CONST int kViewOutOfGamut = 4;
PT_CONST int kViewFurnace = 5;

// Material.
PT_CONST int kViewBaseColor = 6;
PT_CONST int kViewMetallic = 7;
PT_CONST int kViewPerceptualRoughness = 8;
PT_CONST int kViewF0 = 9;
PT_CONST int kViewAo = 10;
PT_CONST int kViewNormalMap = 11;
PT_CONST int kViewEmissive = 12;
PT_CONST int kViewAlpha = 13;

// Geometry.
PT_CONST int kViewShadingNormal = 14;
PT_CONST int kViewGeometricNormal = 15;
PT_CONST int kViewTangent = 16;
PT_CONST int kViewBitangent = 17;
PT_CONST int kViewUvChecker = 18;
PT_CONST int kViewTexelDensity = 19;
PT_CONST int kViewMaterialId = 20;
PT_CONST int kViewMeshId = 21;
PT_CONST int kViewDepth = 22;
PT_CONST int kViewWireframe = 23;
PT_CONST int kViewFlat = 24;

// Factors of the specular lobe, for the chosen direction.
PT_CONST int kViewD = 25;
PT_CONST int kViewG = 26;
PT_CONST int kViewF = 27;
PT_CONST int kViewDGF = 28;
PT_CONST int kViewDiffuseLobe = 29;
PT_CONST int kViewNoL = 30;
PT_CONST int kViewNoV = 31;
PT_CONST int kViewNoH = 32;
PT_CONST int kViewVoH = 33;

// Analytic lights.
PT_CONST int kViewDirect = 34;
PT_CONST int kViewDirectDiffuse = 35;
PT_CONST int kViewDirectSpecular = 36;
PT_CONST int kViewShadow = 37;
PT_CONST int kViewLightArriving = 38;
PT_CONST int kViewLightDiffuse = 39;
PT_CONST int kViewLightSpecular = 40;

// Image-based light.
PT_CONST int kViewIrradiance = 41;
PT_CONST int kViewDiffuseIbl = 42;
PT_CONST int kViewDiffuseAlbedo = 43;
PT_CONST int kViewDiffuseOcclusion = 44;
PT_CONST int kViewPrefiltered = 45;
PT_CONST int kViewPrefilteredLevel = 46;
PT_CONST int kViewDfgScale = 47;
PT_CONST int kViewDfgBias = 48;
PT_CONST int kViewIblFresnel = 49;
PT_CONST int kViewTransmission = 50;
PT_CONST int kViewSpecularIbl = 51;
PT_CONST int kViewSingleScatterAlbedo = 52;
PT_CONST int kViewMultiScatterGain = 53;
PT_CONST int kViewSpecularOcclusion = 54;
PT_CONST int kViewAmbient = 55;

// What a bake of radiance transfer knows besides.
PT_CONST int kViewBentNormal = 56;
PT_CONST int kViewSkyVisibility = 57;
PT_CONST int kViewBakeError = 58;

// The picture in each lighting mode, whatever the document's is.
PT_CONST int kViewCosineLight = 59;
PT_CONST int kViewShLight = 60;
PT_CONST int kViewUnshadowedLight = 61;
PT_CONST int kViewShadowedLight = 62;
PT_CONST int kViewInterreflectedLight = 63;

PT_CONST int kViewCount = 64;

// What the explanation of a pixel needs besides; no views of their own.
PT_CONST int kRecordPosition = 64;
PT_CONST int kRecordToViewer = 65;
PT_CONST int kRecordUv = 66;
PT_CONST int kRecordDiffuseColor = 67;
PT_CONST int kRecordSpecularAlbedo = 68;
PT_CONST int kRecordDfgMean = 69;
PT_CONST int kRecordLobeDirection = 70;
PT_CONST int kRecordToLight = 71;
PT_CONST int kRecordVisibleCone = 72;
PT_CONST int kRecordTransfer = 73; // 1: transfer has the diffuse part of lights, too

PT_CONST int kRecordCount = 74;

#endif
