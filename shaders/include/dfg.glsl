// The DFG table of the model in use. Includer has shared/ibl.glsl.
#ifndef PT_DFG_GLSL
#define PT_DFG_GLSL

layout(binding = 8) uniform sampler2D u_dfg; // core/light/DfgTable.h

// Scale, bias and tilt.
vec3 dfgEntry(float NoV, float perceptualRoughness) {
    return textureLod(u_dfg, dfgTableUv(NoV, perceptualRoughness), 0.0).rgb;
}

#endif
