#version 450 core
// Each work group sums up one tile of 64 × 64 pixels of the picture: those where the model is, and
// all of them.
#include "include/luminance.glsl"
#include "shared/tonemap.glsl"

layout(binding = 0) uniform sampler2D u_radiance; // premultiplied
layout(binding = 1) uniform sampler2D u_depth; // 1: no opaque surface
layout(std430, binding = 0) writeonly buffer Tiles { LuminanceSum b_tiles[]; }; // two for each

uniform int u_firstRow; // of tiles: a band of the picture is measured at a time

void main() {
    ivec2 size = textureSize(u_radiance, 0);
    ivec2 group = ivec2(gl_WorkGroupID.x, int(gl_WorkGroupID.y) + u_firstRow);
    ivec2 corner = group * 64;
    ivec2 first = corner + ivec2(gl_LocalInvocationIndex % 16u, gl_LocalInvocationIndex / 16u);
    LuminanceSum model = noPixels();
    LuminanceSum all = noPixels();
    for (int y = 0; y < 64; y += 16)
        for (int x = 0; x < 64; x += 16) {
            ivec2 p = first + ivec2(x, y);
            if (p.x >= size.x || p.y >= size.y)
                continue;
            vec4 c = texelFetch(u_radiance, p, 0);
            float alpha = finiteRadiance(c.a);
            if (alpha > 0.0) {
                float L = logLuminance(c.rgb / alpha);
                LuminanceSum pixel = LuminanceSum(alpha * L, alpha, L, L);
                all = add(all, pixel);
                if (texelFetch(u_depth, p, 0).r < 1.0)
                    model = add(model, pixel);
            }
        }
    model = addGroup(model);
    all = addGroup(all);
    if (gl_LocalInvocationIndex == 0u) {
        int tile = group.y * int(gl_NumWorkGroups.x) + group.x;
        b_tiles[2 * tile] = model;
        b_tiles[2 * tile + 1] = all;
    }
}
