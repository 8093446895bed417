// The prefiltered environment. Includer has frame.glsl and shared/ibl.glsl.
#ifndef PT_PREFILTERED_GLSL
#define PT_PREFILTERED_GLSL

layout(binding = 7) uniform sampler2D u_prefiltered; // core/light/CubeAtlas.h

// Radiance around world direction `d`, which need not be unit, filtered for a roughness.
vec3 prefilteredRadiance(vec3 d, float perceptualRoughness) {
    vec3 at = cubeFacePosition(toEnvironment(d));
    float level = prefilteredLevel(perceptualRoughness, u_prefilteredLevels, u_prefilteredSide);
    int fine = int(level);
    // The last level has no next one: its share is zero.
    int coarse = min(fine + 1, u_prefilteredLevels - 1);
    vec2 scale = vec2(1.0) / vec2(textureSize(u_prefiltered, 0));
    vec2 uv0 = cubeAtlasTexel(at, fine, u_prefilteredSide) * scale;
    vec2 uv1 = cubeAtlasTexel(at, coarse, u_prefilteredSide) * scale;
    return u_radianceScale * mix(textureLod(u_prefiltered, uv0, 0.0).rgb,
                                 textureLod(u_prefiltered, uv1, 0.0).rgb, level - float(fine));
}

// Irradiance of a surface whose normal is the unit vector `n`.
vec3 environmentIrradiance(vec3 n) {
    vec3 at = cubeFacePosition(toEnvironment(n));
    vec2 scale = vec2(1.0) / vec2(textureSize(u_prefiltered, 0));
    vec2 texel = vec2(at.x * (u_irradianceSide + 2.0) + 1.0 + at.y * u_irradianceSide,
                      u_irradianceTop + 1.0 + at.z * u_irradianceSide);
    vec2 uv = texel * scale;
    return u_radianceScale * (kPi * textureLod(u_prefiltered, uv, 0.0).rgb);
}

#endif
