#version 450 core
// The finished picture into a window, or a part of one; where it is transparent a checkerboard shows.
#include "include/side.glsl"

layout(binding = 0) uniform sampler2D u_picture; // straight alpha
uniform vec2 u_origin; // lower left pixel of that part
uniform float u_opacity;
#ifdef STRETCHED // over more pixels than it has
in vec2 v_uv;
#endif
layout(location = 0) out vec4 o_color;

void main() {
    vec2 place = gl_FragCoord.xy - u_origin;
    keepToSide(place);
    ivec2 pixel = ivec2(place);
#ifdef STRETCHED
    vec4 c = texture(u_picture, v_uv);
#else
    vec4 c = texelFetch(u_picture, pixel, 0);
#endif
    ivec2 field = pixel / 16;
    vec3 checker = ((field.x + field.y) & 1) == 0 ? vec3(0.16) : vec3(0.20);
    o_color = vec4(mix(checker, c.rgb, c.a), u_opacity);
}
