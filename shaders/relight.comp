#version 450 core
// Radiance that surfaces of albedo 1 send out in the present light, for each vertex or texel: run
// when the light or the transfer has changed, so that a light that stands still costs frames
// nothing. Sloan, Kautz & Snyder 2002, "Precomputed Radiance Transfer", equation 1: a dot product.
// COLORED: besides, a set of coefficients for each colour, light by way of other surfaces.
// OPEN_SKY: no bake; the clamped cosine about the normal of each vertex.
// NEAR_LIGHTS: what nearlight.comp found is added.
// The C++ side is render/pass/RelightPass.h.
#include "shared/sh.glsl"

layout(local_size_x = 64) in;

// Light from far away, four coefficients to a vector: 16 of red, 16 of green, 16 of blue; zeros at
// the end.
layout(std140, binding = 7) uniform TransferLight {
    vec4 u_light[48];
};
layout(std430, binding = 3) buffer ExitRadiance {
    vec4 b_exit[];
};
#ifdef NEAR_LIGHTS
layout(std430, binding = 4) readonly buffer NearRadiance {
    vec4 b_near[];
};
#endif
// Coefficients of the chunk's elements; OPEN_SKY: the vertices, three vectors each.
layout(binding = 0) uniform samplerBuffer u_elements;
#ifdef COLORED
layout(binding = 1) uniform samplerBuffer u_bounced; // 3 · u_vectors each
#endif

uniform int u_first;   // element of b_exit that the chunk begins with
uniform int u_count;   // elements in the chunk
uniform int u_vectors; // of an element
uniform int u_adds;    // to light by way of other surfaces that is there; far light's share of
                       // u_bounced is left out then
#ifdef OPEN_SKY
uniform mat4 u_normalToWorld;
#endif
#ifdef OPEN_SKY
float s_cosine[64]; // A_l / pi Y_lm(n)
#endif

// Coefficients 4 k … 4 k + 3.
vec4 direct(int element, int k) {
#ifdef OPEN_SKY
    return vec4(s_cosine[4 * k], s_cosine[4 * k + 1], s_cosine[4 * k + 2], s_cosine[4 * k + 3]);
#else
    return texelFetch(u_elements, element * u_vectors + k);
#endif
}

#ifdef COLORED
vec3 bounced(int element, int k, vec4 red, vec4 green, vec4 blue) {
    int at = 3 * element * u_vectors + k;
    return vec3(dot(texelFetch(u_bounced, at), red),
                dot(texelFetch(u_bounced, at + u_vectors), green),
                dot(texelFetch(u_bounced, at + 2 * u_vectors), blue));
}
#endif

void main() {
    int i = int(gl_GlobalInvocationID.x);
    if (i >= u_count)
        return;
    vec3 sum = u_adds != 0 ? b_exit[u_first + i].rgb : vec3(0.0);
#ifdef OPEN_SKY
    // Position, normal, tangent, uv: 12 floats.
    vec4 a = texelFetch(u_elements, 3 * i);
    vec4 b = texelFetch(u_elements, 3 * i + 1);
    shBasis64(normalize(mat3(u_normalToWorld) * vec3(a.w, b.x, b.y)), s_cosine);
    for (int l = 0; l < 8; ++l)
        for (int k = l * l; k < (l + 1) * (l + 1); ++k)
            s_cosine[k] *= shCosineFactor(l) * kInvPi;
#endif
    for (int k = 0; k < u_vectors; ++k) {
        vec4 t = direct(i, k);
        sum += vec3(dot(t, u_light[k]), dot(t, u_light[16 + k]), dot(t, u_light[32 + k]));
    }
#ifdef COLORED
    if (u_adds == 0)
        for (int k = 0; k < u_vectors; ++k)
            sum += bounced(i, k, u_light[k], u_light[16 + k], u_light[32 + k]);
#endif
#ifdef NEAR_LIGHTS
    sum += b_near[u_first + i].rgb;
#endif
    b_exit[u_first + i] = vec4(sum, 0.0);
}
