// A material's numbers and maps. The C++ side is render/scene/Blocks.h; what is generated follows from
// the table core/material/MaterialInputs.h.
#ifndef PT_MATERIAL_GLSL
#define PT_MATERIAL_GLSL

// Where a map is looked up and which channel counts.
struct Map {
    vec4 uvMatrix;  // rows of the 2 × 2 matrix
    vec4 uvOffset;  // xy
    vec4 channel;   // weights, of colour maps; x < 0: the colour as it is
};

layout(std140, binding = 2) uniform Material {
    vec4 u_baseColor;       // rgb, opacity
    vec4 u_emissive;        // rgb, alpha cutoff
    vec4 u_normalBasis;     // rows: map x and y of the normal to tangent and bitangent
    float u_normalGreenUp;  // +1 OpenGL, -1 DirectX
    float u_placeholder;    // share of the pattern that stands for a missing map
    float u_diffuseRoughness;
    float u_ior;
#include "generated/input-block.glsl"
};

vec2 mapUv(Map map, vec2 uv) {
#ifndef HAS_MOVED_MAPS
    return uv;
#endif
    return vec2(dot(map.uvMatrix.xy, uv), dot(map.uvMatrix.zw, uv)) + map.uvOffset.xy;
}

vec3 mapColor(Map map, vec4 texel) {
#ifndef HAS_PICKED_COLORS
    return texel.rgb;
#endif
    return map.channel.x < 0.0 ? texel.rgb : vec3(dot(map.channel, texel));
}

#include "generated/inputs.glsl"

// A magenta and black board of eight fields per unit of texture space: nobody takes it for a
// material.
vec3 placeholderPattern(vec2 uv) {
    vec2 field = floor(uv * 8.0);
    return mod(field.x + field.y, 2.0) < 0.5 ? vec3(1.0, 0.0, 1.0) : vec3(0.01);
}

#endif
