#version 450 core
// The ground plane y = 0 as a grid that fades with distance, hidden by what stands before it.
#include "include/frame.glsl"
#include "include/exposure.glsl"

in vec2 v_uv;

layout(binding = 0) uniform sampler2D u_depth;
layout(binding = 1) uniform sampler2D u_radiance;
uniform float u_spacing;    // metres between fine lines; every tenth is a strong one
uniform float u_fadeRadius; // metres from u_center
uniform vec3 u_center;

layout(location = 0) out vec4 o_color;

// Coverage of lines at whole numbers of `c`, about one pixel wide; they melt into an even tone
// where they come closer than a few pixels.
float lines(vec2 c, vec2 width) {
    vec2 distance_ = abs(fract(c - 0.5) - 0.5) / width;
    vec2 cover = (1.0 - clamp(distance_, 0.0, 1.0)) * (1.0 - smoothstep(0.15, 0.5, width));
    return max(cover.x, cover.y);
}

void main() {
    vec4 far = u_clipToWorld * vec4(v_uv * 2.0 - 1.0, 1.0, 1.0);
    vec3 d = far.xyz / far.w - u_cameraPosition.xyz;
    float t = -u_cameraPosition.y / d.y;
    vec3 p = u_cameraPosition.xyz + t * d;
    vec2 fine = p.xz / u_spacing;
    vec2 width = fwidth(fine);
    vec2 metres = max(fwidth(p.xz), vec2(1e-9));
    if (!(t > 0.0) || t > 1e6)
        discard;

    vec4 clip = u_worldToClip * vec4(p, 1.0);
    float depth = clip.z / clip.w * 0.5 + 0.5;
    ivec2 texel = ivec2(v_uv * vec2(textureSize(u_depth, 0))); // of a picture that may be coarser
    float sceneDepth = texelFetch(u_depth, texel, 0).r;
    // A floor at y = 0 keeps its grid.
    if (sceneDepth < 1.0 && depth - 1e-5 > sceneDepth)
        discard;

    float fade = 1.0 - smoothstep(0.25, 1.0, length(p - u_center) / u_fadeRadius);
    float strength = max(0.22 * lines(fine, width), 0.4 * lines(fine * 0.1, width * 0.1));
    // Light lines on a dark picture, dark ones on a bright one.
    vec3 behind = expose(texelFetch(u_radiance, texel, 0).rgb);
    vec3 color = vec3(mix(0.85, 0.05, smoothstep(0.05, 0.3, reinhard(luminance(behind)))));
    vec2 axis = 1.0 - clamp(abs(p.xz) / (1.5 * metres), 0.0, 1.0);
    if (axis.y > 0.0) { // z = 0: the x axis
        color = mix(color, vec3(0.86, 0.27, 0.32), axis.y);
        strength = max(strength, 0.75 * axis.y);
    }
    if (axis.x > 0.0) { // x = 0: the z axis
        color = mix(color, vec3(0.30, 0.50, 0.92), axis.x);
        strength = max(strength, 0.75 * axis.x);
    }
    o_color = vec4(color, strength * fade);
}
