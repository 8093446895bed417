#version 450 core
// Which instance covers a pixel: for picking.
#include "include/instance.glsl"
#include "include/material.glsl"

in vec2 v_uv;
layout(location = 0) out uint o_id;

void main() {
#ifdef ALPHA_MASK
    float alpha = u_baseColor.a;
#ifdef HAS_BASE_COLOR_MAP
    alpha *= texture(u_baseColorTexture, mapUv(u_baseColorMap, v_uv)).a;
#endif
    if (alpha < u_emissive.a)
        discard;
#endif
    o_id = u_id;
}
