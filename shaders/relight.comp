#version 450 core
// Radiance that surfaces of albedo 1 send out in the present light, for each vertex or texel: run
// when the light or the transfer has changed, so that a light that stands still costs frames
// nothing. Sloan, Kautz & Snyder 2002, "Precomputed Radiance Transfer", equation 1: a dot product.
// COLORED: besides, a set of coefficients for each colour, light by way of other surfaces.
// OPEN_SKY: no bake; the clamped cosine about the normal of each vertex.
// NEAR_POINTS, NEAR_SPHERES, NEAR_RECTANGLES: lights near by, which every place sees differently.
// The C++ side is render/pass/RelightPass.h.
#include "shared/sh.glsl"
#if defined(NEAR_POINTS) || defined(NEAR_SPHERES) || defined(NEAR_RECTANGLES)
#define NEAR_LIGHTS
#include "include/frame.glsl"
#include "shared/lights.glsl"
#include "shared/nearlight.glsl"
#endif

layout(local_size_x = 64) in;

// Light from far away, four coefficients to a vector: 16 of red, 16 of green, 16 of blue; zeros at
// the end.
layout(std140, binding = 7) uniform TransferLight {
    vec4 u_light[48];
    vec4 u_window[2]; // of the bands of lights near by
};
layout(std430, binding = 3) buffer ExitRadiance {
    vec4 b_exit[];
};
// Coefficients of the chunk's elements; OPEN_SKY: the vertices, three vectors each.
layout(binding = 0) uniform samplerBuffer u_elements;
#ifdef COLORED
layout(binding = 1) uniform samplerBuffer u_bounced; // 3 · u_vectors each
#endif

uniform int u_first;   // element of b_exit that the chunk begins with
uniform int u_count;   // elements in the chunk
uniform int u_vectors; // of an element
uniform int u_order;   // bands
uniform int u_adds;    // to light by way of other surfaces that is there; far light's share of
                       // u_bounced is left out then
#ifdef OPEN_SKY
uniform mat4 u_normalToWorld;
#endif
#ifdef NEAR_LIGHTS
layout(binding = 2) uniform samplerBuffer u_places; // of the chunk's elements
uniform int u_placeVectors;                         // the first holds the position
uniform mat4 u_placeToWorld;
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

#ifdef NEAR_LIGHTS
// One loop for all kinds, so that what they share is compiled once.
vec3 nearLight(int element, vec3 place) {
    float window[8] = float[8](u_window[0].x, u_window[0].y, u_window[0].z, u_window[0].w,
                               u_window[1].x, u_window[1].y, u_window[1].z, u_window[1].w);
    vec3 sum = vec3(0.0);
    float y[64];
    for (int i = 0; i < 64; ++i) // the last vector may hold more than u_order bands
        y[i] = 0.0;
    for (int i = u_lightEnds.x; i < u_lightEnds.w; ++i) {
        vec3 toLight = u_lights[i].place.xyz - place;
        float reaches = 1.0;
#ifdef NEAR_POINTS
        if (i < u_lightEnds.y) {
            float distance2 = dot(toLight, toLight);
            vec3 l = toLight * inversesqrt(max(distance2, 1e-12));
            reaches = pointFalloff(distance2, u_lights[i].color.w) *
                      spotFalloff(dot(u_lights[i].axis.xyz, l), 1.0, u_lights[i].axis.w);
            nearPointSh(l, u_order, window, y);
        }
#endif
#ifdef NEAR_SPHERES
        if (i >= u_lightEnds.y && i < u_lightEnds.z)
            nearSphereSh(toLight, u_lights[i].axis.x, u_order, window, y);
#endif
#ifdef NEAR_RECTANGLES
        if (i >= u_lightEnds.z)
            nearRectangleSh(toLight, u_lights[i].axis.xyz, u_lights[i].side.xyz, u_order, window, y);
#endif
        vec3 seen = vec3(0.0);
        for (int k = 0; k < u_vectors; ++k) {
            vec4 part = vec4(y[4 * k], y[4 * k + 1], y[4 * k + 2], y[4 * k + 3]);
            seen += vec3(dot(direct(element, k), part));
#ifdef COLORED
            seen += bounced(element, k, part, part, part);
#endif
        }
        sum += u_lights[i].color.rgb * reaches * seen;
    }
    return sum;
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
    vec3 place = (u_placeToWorld * vec4(texelFetch(u_places, i * u_placeVectors).xyz, 1.0)).xyz;
    sum += nearLight(i, place);
#endif
    b_exit[u_first + i] = vec4(sum, 0.0);
}
