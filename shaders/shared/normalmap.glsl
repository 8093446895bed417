// Tangent-space normal maps.
#ifndef PT_NORMALMAP_GLSL
#define PT_NORMALMAP_GLSL

#include "macros.glsl"

// Texel (0…1) to unit tangent-space normal; x along growing u, y up in the image, z outwards.
// `strength` scales the slope (glTF 2.0, normalTextureInfo.scale). `greenUp`: +1 for maps whose
// green points up (OpenGL, glTF), -1 for green down (DirectX).
// z is kept above zero: a normal that points into the surface is damaged data, and a texel of
// mid grey must not become a zero vector.
PT_FN vec3 decodeNormalTs(vec3 texel, float strength, float greenUp) {
    vec3 n = texel * 2.0f - vec3(1.0f);
    return normalize(vec3(n.x * strength, n.y * greenUp * strength, max(n.z, 1e-3f)));
}

// Tangent space to world. `tangent`.w = ±1 gives the side of the bitangent: cross(n, t) * w points
// up in the image. `normal` is unit; the tangent needs to be neither unit nor orthogonal, as after
// interpolation. A tangent parallel to the normal leaves the normal unchanged.
PT_FN vec3 normalTsToWorld(vec3 normalTs, vec3 normal, vec4 tangent) {
    vec3 t = vec3(tangent.x, tangent.y, tangent.z);
    t = t - normal * dot(normal, t);
    float length2 = dot(t, t);
    if (length2 < 1e-12f)
        return normal;
    t = t * inversesqrt(length2);
    vec3 b = cross(normal, t) * tangent.w;
    return normalize(t * normalTs.x + b * normalTs.y + normal * normalTs.z);
}

#endif
