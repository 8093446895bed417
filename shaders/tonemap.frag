#version 450 core
// Scene-linear radiance to display values: exposure, tone curve, sRGB.
#include "shared/tonemap.glsl"

layout(binding = 0) uniform sampler2D u_radiance; // premultiplied
uniform float u_exposureEv;
uniform int u_curve;

layout(location = 0) out vec4 o_color; // straight alpha

void main() {
    vec4 c = texelFetch(u_radiance, ivec2(gl_FragCoord.xy), 0);
    vec3 radiance = c.a > 0.0 ? c.rgb / c.a : vec3(0.0);
    o_color = vec4(srgbEncode(toneMap(applyExposure(radiance, u_exposureEv), u_curve)), c.a);
}
