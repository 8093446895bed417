// What a baked light map says of a place: how its light differs from image-based light. Includer has
// shared/sh.glsl; core/bake/lightmap/LightMap.h says what the vectors are.
#ifndef PT_LIGHTMAP_GLSL
#define PT_LIGHTMAP_GLSL

layout(binding = 13) uniform sampler3D u_lightMap; // one vector in each slice

const int kLightMapSlices = 10;

struct LightMapTexel {
    vec3 irradiance; // to be added, before the albedo
    vec3 radiance;   // to be added to what is left of the prefiltered radiance
    float hidden;    // share of that which is missing, -1…1; below 0: there is more
};

LightMapTexel noLightMap() {
    return LightMapTexel(vec3(0.0), vec3(0.0), 0.0);
}

// `mirrored`: unit. The back of a surface has none.
LightMapTexel lightMapTexel(vec2 uv, vec3 mirrored) {
    if (!gl_FrontFacing)
        return noLightMap();
    float y[9];
    shBasis9(mirrored, y);
    vec4 sum = vec4(0.0);
    for (int i = 0; i < 9; ++i)
        sum += y[i] * texture(u_lightMap, vec3(uv, (float(i) + 1.5) / float(kLightMapSlices)));
    vec3 irradiance = texture(u_lightMap, vec3(uv, 0.5 / float(kLightMapSlices))).rgb;
    return LightMapTexel(irradiance, sum.rgb, clamp(sum.a, -1.0, 1.0));
}

#endif
