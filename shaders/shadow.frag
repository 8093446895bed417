#version 450 core
// Depth alone, for shadow maps: what is cut out casts no shadow.
#include "include/material.glsl"

in vec2 v_uv;

void main() {
#ifdef ALPHA_MASK
    float alpha = u_baseColor.a;
#ifdef HAS_BASE_COLOR_MAP
    alpha *= texture(u_baseColorTexture, mapUv(u_baseColorMap, v_uv)).a;
#endif
    if (alpha < u_emissive.a)
        discard;
#endif
}
