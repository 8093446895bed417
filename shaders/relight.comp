#version 450 core
// Radiance that surfaces of albedo 1 send out in the present light, for each vertex or texel: run
// when the light or the transfer has changed, so that a light that stands still costs frames
// nothing. Sloan, Kautz & Snyder 2002, "Precomputed Radiance Transfer", equation 1: a dot product.
// COLORED: a set of coefficients for each colour, light by way of other surfaces.
// OPEN_SKY: no bake; the clamped cosine about the normal of each vertex.
// The C++ side is render/pass/RelightPass.h.
#include "shared/sh.glsl"

layout(local_size_x = 64) in;

// Coefficients of the light, four to a vector: 16 of red, 16 of green, 16 of blue; zeros at the end.
layout(std140, binding = 7) uniform TransferLight {
    vec4 u_light[48];
};
layout(std430, binding = 3) buffer ExitRadiance {
    vec4 b_exit[];
};
// Coefficients of the chunk's elements; OPEN_SKY: the vertices, three vectors each.
layout(binding = 0) uniform samplerBuffer u_elements;

uniform int u_first;   // element of b_exit that the chunk begins with
uniform int u_count;   // elements in the chunk
uniform int u_vectors; // of an element and channel
uniform int u_adds;    // to what is there
#ifdef OPEN_SKY
uniform mat4 u_normalToWorld;
#endif

void main() {
    int i = int(gl_GlobalInvocationID.x);
    if (i >= u_count)
        return;
    vec3 sum = u_adds != 0 ? b_exit[u_first + i].rgb : vec3(0.0);
#if defined(OPEN_SKY)
    // Bands of u_light come multiplied by A_l / pi. Position, normal, tangent, uv: 12 floats.
    vec4 a = texelFetch(u_elements, 3 * i);
    vec4 b = texelFetch(u_elements, 3 * i + 1);
    float y[64];
    shBasis64(normalize(mat3(u_normalToWorld) * vec3(a.w, b.x, b.y)), y);
    for (int k = 0; k < 16; ++k) {
        vec4 t = vec4(y[4 * k], y[4 * k + 1], y[4 * k + 2], y[4 * k + 3]);
        sum += vec3(dot(t, u_light[k]), dot(t, u_light[16 + k]), dot(t, u_light[32 + k]));
    }
#elif defined(COLORED)
    int at = 3 * i * u_vectors;
    for (int k = 0; k < u_vectors; ++k) {
        sum.r += dot(texelFetch(u_elements, at + k), u_light[k]);
        sum.g += dot(texelFetch(u_elements, at + u_vectors + k), u_light[16 + k]);
        sum.b += dot(texelFetch(u_elements, at + 2 * u_vectors + k), u_light[32 + k]);
    }
#else
    int at = i * u_vectors;
    for (int k = 0; k < u_vectors; ++k) {
        vec4 t = texelFetch(u_elements, at + k);
        sum += vec3(dot(t, u_light[k]), dot(t, u_light[16 + k]), dot(t, u_light[32 + k]));
    }
#endif
    b_exit[u_first + i] = vec4(sum, 0.0);
}
