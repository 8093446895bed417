#version 450 core
// Each work group sums up one tile of 64 × 64 pixels of the picture.
#include "include/luminance.glsl"
#include "shared/tonemap.glsl"

layout(binding = 0) uniform sampler2D u_radiance; // premultiplied
layout(std430, binding = 0) writeonly buffer Tiles { LuminanceSum b_tiles[]; };

void main() {
    ivec2 size = textureSize(u_radiance, 0);
    ivec2 corner = ivec2(gl_WorkGroupID.xy) * 64;
    ivec2 first = corner + ivec2(gl_LocalInvocationIndex % 16u, gl_LocalInvocationIndex / 16u);
    LuminanceSum sum = noPixels();
    for (int y = 0; y < 64; y += 16)
        for (int x = 0; x < 64; x += 16) {
            ivec2 p = first + ivec2(x, y);
            if (p.x >= size.x || p.y >= size.y)
                continue;
            vec4 c = texelFetch(u_radiance, p, 0);
            float alpha = finiteRadiance(c.a);
            if (alpha > 0.0) {
                float L = logLuminance(c.rgb / alpha);
                sum = add(sum, LuminanceSum(alpha * L, alpha, L, L));
            }
        }
    sum = addGroup(sum);
    if (gl_LocalInvocationIndex == 0u)
        b_tiles[gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x] = sum;
}
