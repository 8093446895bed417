// The shading model of the document. Its choices are defines of the shader variant, so that the
// terms that were not chosen cost nothing (render/pass/SurfacePass.cpp); its numbers are a block.
// The C++ side is render/scene/Blocks.h.
#ifndef PT_MODEL_GLSL
#define PT_MODEL_GLSL

#include "../shared/brdf.glsl"

layout(std140, binding = 3) uniform Model {
    vec4 u_conductorN; // rgb, f90
    vec4 u_conductorK; // rgb, ior
};

#ifndef MODEL_DISTRIBUTION
#define MODEL_DISTRIBUTION kDistributionGGX
#endif
#ifndef MODEL_VISIBILITY
#define MODEL_VISIBILITY kVisibilitySmithCorrelated
#endif
#ifndef MODEL_FRESNEL
#define MODEL_FRESNEL kFresnelSchlick
#endif
#ifndef MODEL_DIFFUSE
#define MODEL_DIFFUSE kDiffuseLambert
#endif
#ifndef MODEL_MULTI_SCATTER
#define MODEL_MULTI_SCATTER 1
#endif
#ifndef MODEL_LOBE_DIRECTION
#define MODEL_LOBE_DIRECTION kLobeDirectionMean
#endif

BrdfModel shadingModel() {
    BrdfModel m;
    m.distribution = MODEL_DISTRIBUTION;
    m.visibility = MODEL_VISIBILITY;
    m.fresnel = MODEL_FRESNEL;
    m.diffuse = MODEL_DIFFUSE;
    m.multiScatter = MODEL_MULTI_SCATTER;
    m.lobeDirection = MODEL_LOBE_DIRECTION;
    m.f90 = u_conductorN.w;
    m.ior = u_conductorK.w;
    m.dielectricF0 = kDielectricF0; // makeSurface() has that of the material
    m.conductorN = u_conductorN.xyz;
    m.conductorK = u_conductorK.xyz;
    return m;
}

#endif
