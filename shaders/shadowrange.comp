#version 450 core
// One level of the pyramids over a shadow map: nearest and farthest depth of 2 × 2 texels below, or,
// DILATE, of a texel and its neighbours.
layout(local_size_x = 8, local_size_y = 8) in;

layout(binding = 0) uniform sampler2D u_below; // FROM_DEPTH: the map, otherwise the pyramid
layout(binding = 0, rg32f) writeonly uniform image2D u_level;

uniform int u_fromLevel; // of the pyramid
uniform int u_firstX;    // of the map's square in this level
uniform int u_firstY;
uniform int u_size; // of the square

vec2 below(ivec2 texel) {
#ifdef FROM_DEPTH
    return texelFetch(u_below, texel, 0).rr;
#else
    return texelFetch(u_below, texel, u_fromLevel).rg;
#endif
}

void main() {
    if (any(greaterThanEqual(gl_GlobalInvocationID.xy, uvec2(u_size))))
        return;
    ivec2 first = ivec2(u_firstX, u_firstY);
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy) + first;
    vec2 range = vec2(1.0, 0.0);
#ifdef DILATE
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x) {
            vec2 r = below(clamp(texel + ivec2(x, y), first, first + u_size - 1));
            range = vec2(min(range.x, r.x), max(range.y, r.y));
        }
#else
    for (int i = 0; i < 4; ++i) {
        vec2 r = below(2 * texel + ivec2(i & 1, i >> 1));
        range = vec2(min(range.x, r.x), max(range.y, r.y));
    }
#endif
    imageStore(u_level, texel, vec4(range, 0, 0));
}
