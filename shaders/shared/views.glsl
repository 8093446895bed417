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
PT_CONST int kViewAo = 9;
PT_CONST int kViewNormalMap = 10;
PT_CONST int kViewEmissive = 11;
PT_CONST int kViewAlpha = 12;

// Geometry.
PT_CONST int kViewShadingNormal = 13;
PT_CONST int kViewGeometricNormal = 14;
PT_CONST int kViewTangent = 15;
PT_CONST int kViewBitangent = 16;
PT_CONST int kViewUvChecker = 17;
PT_CONST int kViewTexelDensity = 18;
PT_CONST int kViewMaterialId = 19;
PT_CONST int kViewMeshId = 20;
PT_CONST int kViewDepth = 21;
PT_CONST int kViewWireframe = 22;
PT_CONST int kViewFlat = 23;

// Factors of the specular lobe, for the chosen direction.
PT_CONST int kViewD = 24;
PT_CONST int kViewG = 25;
PT_CONST int kViewF = 26;
PT_CONST int kViewDGF = 27;
PT_CONST int kViewNoL = 28;
PT_CONST int kViewNoV = 29;
PT_CONST int kViewNoH = 30;
PT_CONST int kViewVoH = 31;

// Analytic lights.
PT_CONST int kViewDirect = 32;
PT_CONST int kViewDirectDiffuse = 33;
PT_CONST int kViewDirectSpecular = 34;
PT_CONST int kViewShadow = 35;

// Image-based light.
PT_CONST int kViewIrradiance = 36;
PT_CONST int kViewDiffuseIbl = 37;
PT_CONST int kViewPrefiltered = 38;
PT_CONST int kViewPrefilteredLevel = 39;
PT_CONST int kViewDfgScale = 40;
PT_CONST int kViewDfgBias = 41;
PT_CONST int kViewIblFresnel = 42;
PT_CONST int kViewTransmission = 43;
PT_CONST int kViewSpecularIbl = 44;
PT_CONST int kViewMultiScatterGain = 45;
PT_CONST int kViewAmbient = 46;

PT_CONST int kViewCount = 47;

// What the explanation of a pixel needs besides; no views of their own.
PT_CONST int kRecordPosition = 47;
PT_CONST int kRecordToViewer = 48;
PT_CONST int kRecordUv = 49;
PT_CONST int kRecordF0 = 50;
PT_CONST int kRecordDiffuseColor = 51;
PT_CONST int kRecordSpecularAlbedo = 52;
PT_CONST int kRecordSpecularOcclusion = 53;
PT_CONST int kRecordDfgMean = 54;
PT_CONST int kRecordLobeDirection = 55;
PT_CONST int kRecordToLight = 56;
PT_CONST int kRecordEnergyCompensation = 57;

PT_CONST int kRecordCount = 58;

#endif
