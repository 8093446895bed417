#version 450 core
// A line around the pixels that a mask covers.
#include "include/frame.glsl"

in vec2 v_uv;

layout(binding = 0) uniform sampler2D u_mask;
uniform vec3 u_color;
uniform float u_radius; // pixels

layout(location = 0) out vec4 o_color;

void main() {
    const int kDirections = 12;
    float inside = texture(u_mask, v_uv).r;
    float around = 0.0;
    for (int i = 0; i < kDirections; ++i) {
        float angle = 6.2831853 * (float(i) + 0.5) / float(kDirections);
        vec2 offset = u_radius * vec2(cos(angle), sin(angle)) * u_viewport.zw;
        around += texture(u_mask, v_uv + offset).r + texture(u_mask, v_uv + 0.5 * offset).r;
    }
    float edge = smoothstep(0.0, 0.25 * float(kDirections), around) * (1.0 - inside);
    if (edge <= 0.0)
        discard;
    o_color = vec4(u_color, edge);
}
