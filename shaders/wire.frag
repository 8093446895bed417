#version 450 core
// The edges of triangles, from a mask, over the displayed picture.
#include "include/side.glsl"

layout(binding = 0) uniform sampler2D u_mask;
layout(location = 0) out vec4 o_color;

void main() {
    keepToSide(gl_FragCoord.xy);
    float covered = texelFetch(u_mask, ivec2(gl_FragCoord.xy), 0).r;
    // Dark lines with a light seam would hide the picture; a blue that few materials have does not.
    o_color = vec4(0.05, 0.35, 0.75, 0.8 * covered);
}
