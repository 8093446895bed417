// Soft shadows of directional lights and spots: percentage-closer soft shadows (Fernando 2005), with
// a penumbra of the geometric width. The C++ side is render/pass/ShadowPass.h and
// render/scene/Blocks.h; docs/maths/lights.md has the method.
#ifndef PT_SHADOW_GLSL
#define PT_SHADOW_GLSL

struct Shadow {
    mat4 worldToMap; // to u, v and depth of the light's map, homogeneous
    mat4 planeToMap; // its inverse transpose: carries planes over
    vec4 light;      // xyz: position, or direction to it where w = 0
    vec4 tile;       // xy: where the map begins in the texture, zw: its size there
    float penumbra;  // diameter, in u, per difference in depth of receiver and occluder
    float texelDepth;
    float maxSlope;
    float texel; // in u; 0: the map is empty
};

layout(std140, binding = 4) uniform Shadows {
    Shadow u_shadows[4];
};
layout(binding = 10) uniform sampler2DShadow u_shadowDepth;
layout(binding = 11) uniform sampler2D u_shadowNearest; // depth of 2 × 2 texels and more, by level
layout(binding = 12) uniform sampler2D u_shadowRange;   // nearest and farthest, neighbours included

// Nearest and farthest depth within `radius` of `uv`: cells include their neighbours, so that one of
// at least that size knows.
vec2 shadowRange(vec4 tile, vec2 uv, float radius, float cells) {
    float level = clamp(ceil(log2(max(radius * cells, 1.0))), 0.0, log2(cells));
    return textureLod(u_shadowRange, tile.xy + tile.zw * uv, level).rg;
}

// The share of a light that reaches a point of a face. `faceNormal`: of the triangle; either side.
// `n`: the shading normal; what turns away from the light is not looked at.
float shadowVisibility(Shadow s, vec3 position, vec3 faceNormal, vec3 n) {
    vec4 h = s.worldToMap * vec4(position, 1.0);
    vec3 p = h.xyz / max(h.w, 1e-6);
    // What the map does not cover is lit.
    bool covered = dot(n, s.light.xyz - s.light.w * position) > 0.0 && s.texel > 0.0 && h.w > 0.0 && p.x > 0.0 && p.y > 0.0 && p.x < 1.0 &&
                   p.y < 1.0 && p.z > 0.0;
    p = clamp(p, vec3(0.0), vec3(1.0));

    // The receiver is taken as the plane of its triangle: depths around the point are compared with
    // that plane, not with the point, so that wide filters do not darken slopes. What is left is the
    // step from texel to texel.
    vec4 plane = s.planeToMap * vec4(faceNormal, -dot(faceNormal, position));
    vec2 slope = -plane.xy / (abs(plane.z) < 1e-6 ? 1e-6 : plane.z);
    slope *= min(1.0, s.maxSlope / max(abs(slope.x) + abs(slope.y), 1e-6));
    float steepness = abs(slope.x) + abs(slope.y);
    float bias = steepness * s.texel + s.texelDepth;

    // How far occluders may be from the line to the light: first anything up to the light, then what
    // was found there. Most points are decided by this. Loops instead of branches: a software
    // rasteriser skips only those.
    float finest = 1.5 * s.texel; // less than this the map does not resolve
    float radius = 0.5 * s.penumbra * p.z + s.texel;
    float cells = float(textureSize(u_shadowRange, 0).x) * s.tile.z;
    vec2 range = shadowRange(s.tile, p.xy, radius, cells);
    radius = min(radius, 0.5 * s.penumbra * max(p.z - range.x, 0.0) + s.texel);
    int rounds = covered && radius > finest ? 1 : 0;
    for (int i = 0; i < rounds; ++i) {
        range = shadowRange(s.tile, p.xy, radius, cells);
        radius = min(radius, 0.5 * s.penumbra * max(p.z - range.x, 0.0) + s.texel);
    }
    float tilt = steepness * radius;
    bool lit = !covered || range.x >= p.z + tilt - bias;
    bool dark = range.y < p.z - tilt - bias;

    // The mean distance of the occluders gives the width of the penumbra.
    const int kSearchTaps = 12;
    const mat2 kGoldenAngle = mat2(-0.7373688, -0.6754902, 0.6754902, -0.7373688);
    int searchTaps = lit || dark || radius <= finest ? 0 : kSearchTaps;
    float level = clamp(floor(log2(max(0.5 * radius * cells, 1.0))), 0.0, log2(cells));
    vec2 direction = vec2(1.0, 0.0);
    float gaps = 0.0;
    float found = 0.0;
    for (int i = 0; i < searchTaps; ++i) {
        vec2 offset = direction * (radius * sqrt((float(i) + 0.5) / float(kSearchTaps)));
        direction = kGoldenAngle * direction;
        vec2 uv = clamp(p.xy + offset, vec2(s.texel), vec2(1.0 - s.texel));
        float depth = textureLod(u_shadowNearest, s.tile.xy + s.tile.zw * uv, level).r;
        float gap = p.z + dot(slope, offset) - depth;
        float blocks = gap > bias ? 1.0 : 0.0;
        gaps += blocks * gap;
        found += blocks;
    }

    // The share of the disc of that width that sees the light.
    if (searchTaps > 0) {
        lit = found == 0.0;
        radius = clamp(0.5 * s.penumbra * gaps / max(found, 1.0), s.texel, radius);
    }
    // Neighbouring samples overlap in the bilinear comparison up to some four texels.
    int taps = lit || dark ? 0 : int(clamp(radius / s.texel * 6.0, 4.0, 32.0));
    float sum = 0.0;
    direction = vec2(1.0, 0.0);
    for (int i = 0; i < taps; ++i) {
        vec2 offset = direction * (radius * sqrt((float(i) + 0.5) / float(taps)));
        direction = kGoldenAngle * direction;
        vec2 uv = clamp(p.xy + offset, vec2(s.texel), vec2(1.0 - s.texel));
        sum += textureLod(u_shadowDepth,
                          vec3(s.tile.xy + s.tile.zw * uv, p.z + dot(slope, offset) - bias), 0.0);
    }
    float open = taps > 0 ? sum / float(taps) : 1.0;
    return lit ? 1.0 : (dark ? 0.0 : open);
}

#endif
