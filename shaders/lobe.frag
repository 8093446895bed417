#version 450 core
// A lobe on the surface: a translucent body with rings at every quarter of its radius, drawn over the
// displayed picture. What the scene hides of it stays as a shadow of itself.
#include "include/frame.glsl"

in vec3 v_world;
in vec3 v_normal;
in vec3 v_color;
in float v_radius;

layout(binding = 0) uniform sampler2D u_depth;
uniform vec3 u_color;

layout(location = 0) out vec4 o_color;

void main() {
    vec3 n = normalize(v_normal);
    vec3 v = normalize(u_cameraPosition.xyz - v_world);
    float facing = abs(dot(n, v));
    float lit = 0.45 + 0.55 * facing;
    float ring = abs(v_radius * 4.0 - round(v_radius * 4.0));
    float line = v_radius > 0.06 && v_radius < 0.985
                     ? 1.0 - smoothstep(0.0, 1.5, ring / max(fwidth(v_radius * 4.0), 1e-6))
                     : 0.0;
    vec3 tint = mix(u_color, sqrt(v_color), 0.35);
    // Thin where it is seen along its skin, as glass is not, so that its edge is soft.
    float alpha = 0.62 * smoothstep(0.0, 0.35, facing);
    // The picture may be coarser than what the lobe is drawn on.
    vec2 at = gl_FragCoord.xy * u_viewport.zw * vec2(textureSize(u_depth, 0));
    float scene = texelFetch(u_depth, ivec2(at), 0).r;
    // The foot lies on the surface itself.
    if (scene < 1.0 && gl_FragCoord.z - 2e-5 > scene)
        alpha *= 0.16;
    o_color = vec4(tint * lit * (1.0 - 0.5 * line), alpha);
}
