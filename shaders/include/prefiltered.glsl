// The prefiltered surroundings. Includer has frame.glsl and shared/ibl.glsl.
#ifndef PT_PREFILTERED_GLSL
#define PT_PREFILTERED_GLSL

layout(binding = 7) uniform sampler2D u_prefiltered; // core/light/CubeAtlas.h

// Radiance around world direction `d`, which need not be unit, filtered for a roughness.
vec3 prefilteredRadiance(vec3 d, float perceptualRoughness) {
    vec3 at = cubeFacePosition(toEnvironment(d));
    float level = prefilteredLevel(perceptualRoughness, u_prefilteredLevels);
    float fine = floor(level);
    vec2 scale = vec2(1.0) / cubeAtlasSize(u_prefilteredSide);
    // Beyond the last level the atlas is black, and its share is zero.
    vec2 uv0 = cubeAtlasTexel(at, fine, u_prefilteredSide) * scale;
    vec2 uv1 = cubeAtlasTexel(at, fine + 1.0, u_prefilteredSide) * scale;
    return u_radianceScale * mix(textureLod(u_prefiltered, uv0, 0.0).rgb,
                                 textureLod(u_prefiltered, uv1, 0.0).rgb, level - fine);
}

#endif
