#version 450 core
// What lights near by add to the radiance that surfaces of albedo 1 send out, for each vertex or
// texel: each place sees them differently, so their harmonics are made there, in closed form, and
// multiplied with its transfer. Run when one of them, the transfer or a place has changed. Where the
// share of a light that arrives was traced, that part is its closed form times the share, and the
// transfer is asked for nothing but what bounces.
// NEAR_POINTS, NEAR_SPHERES: the lights u_lightBegin … u_lightEnd - 1; NEAR_RECTANGLE: one light.
// ORDER: bands; known to the compiler, so that harmonics stay in registers.
// COLORED, OPEN_SKY: as in relight.comp. The C++ side is render/pass/NearLightPass.h.
#include "include/frame.glsl"
#include "shared/lights.glsl"
#include "shared/nearlight.glsl"

layout(local_size_x = 64) in;

#define COUNT (ORDER * ORDER)
#define VECTORS ((COUNT + 3) / 4)

layout(std430, binding = 4) buffer NearRadiance {
    vec4 b_near[];
};
// Of each light a row of shares for the elements: 0…1, or negative where there is none.
layout(std430, binding = 6) readonly buffer NearShares {
    float b_shares[];
};
// The row of each of LIGHTS, counted over all buffers of shares; -1: none.
layout(std430, binding = 1) readonly buffer NearRows {
    int b_rows[];
};
layout(std140, binding = 8) uniform NearLight {
    vec4 u_window[2]; // of the bands
    // Of a rectangle: position, unit vectors along its sides with half of their lengths, normal.
    vec4 u_center;
    vec4 u_sideX;
    vec4 u_sideY;
    vec4 u_normal;
    vec4 u_turnFirst[154]; // NearRectangle::turnFirst
    vec4 u_turnSecond[154];
};
// Of the chunk's elements: coefficients, VECTORS each (OPEN_SKY: vertices, three vectors each); the
// same of what comes by way of other surfaces, three times as many; positions.
layout(binding = 0) uniform samplerBuffer u_elements;
#ifdef COLORED
layout(binding = 1) uniform samplerBuffer u_bounced;
#endif
layout(binding = 2) uniform samplerBuffer u_places;

uniform int u_first;        // element of b_near that the chunk begins with
uniform int u_count;        // elements in the chunk
uniform int u_adds;         // to what is there
uniform int u_placeVectors; // of u_places: 3: a vertex; 2: a texel's position and its normal
uniform mat4 u_placeToWorld;
uniform int u_lightBegin;
uniform int u_lightEnd;
uniform int u_shareRows;    // that b_shares may have; 0: none is bound
uniform int u_firstRow;     // in b_shares
uniform int u_elementCount; // of a row
uniform mat4 u_normalToWorld;

float[8] window() {
    return float[8](u_window[0].x, u_window[0].y, u_window[0].z, u_window[0].w, u_window[1].x,
                    u_window[1].y, u_window[1].z, u_window[1].w);
}

vec3 normalOf(int element) {
    int at = element * u_placeVectors;
    vec4 a = texelFetch(u_places, at);
    vec4 b = texelFetch(u_places, at + 1);
    vec3 n = mat3(u_normalToWorld) * (u_placeVectors == 3 ? vec3(a.w, b.x, b.y) : b.xyz);
    return n * inversesqrt(max(dot(n, n), 1e-30));
}

// The transfer of an element, times light; `direct` 0: of what bounces alone.
vec3 transferred(int element, float light[64], float direct) {
    vec3 sum = vec3(0.0);
#ifdef OPEN_SKY
    // Position, normal, tangent, uv: 12 floats.
    vec4 a = texelFetch(u_elements, 3 * element);
    vec4 b = texelFetch(u_elements, 3 * element + 1);
    float cosine[64];
    shBasis64(normalize(mat3(u_normalToWorld) * vec3(a.w, b.x, b.y)), cosine);
    float factor[8];
    for (int l = 0; l < 8; ++l)
        factor[l] = shCosineFactor(l) * kInvPi;
    scaleBands(ORDER, factor, cosine);
    for (int k = 0; k < VECTORS; ++k)
        for (int c = 0; c < 4; ++c)
            sum += 4 * k + c < COUNT ? cosine[4 * k + c] * light[4 * k + c] : 0.0;
#else
    for (int k = 0; k < VECTORS; ++k) {
        vec4 part;
        for (int c = 0; c < 4; ++c) // the last vector may hold more than there is
            part[c] = 4 * k + c < COUNT ? light[4 * k + c] : 0.0;
        sum += vec3(direct * dot(texelFetch(u_elements, element * VECTORS + k), part));
#ifdef COLORED
        int at = 3 * element * VECTORS + k;
        sum += vec3(dot(texelFetch(u_bounced, at), part),
                    dot(texelFetch(u_bounced, at + VECTORS), part),
                    dot(texelFetch(u_bounced, at + 2 * VECTORS), part));
#endif
    }
#endif
    return sum;
}

#ifdef NEAR_RECTANGLE
// Band l from the light's frames to the world.
void turnBand(int l, int begin, float first[64], float second[64], inout float y[64]) {
    for (int row = 0; row < 2 * l + 1; ++row) {
        float sum = 0.0;
        for (int c = 0; c < 2 * l; ++c) {
            int at = begin + row * 2 * l + c;
            int from = l * l + c + (c < l ? 0 : 1); // m = 0 is left out
            sum += u_turnFirst[at >> 2][at & 3] * first[from] +
                   u_turnSecond[at >> 2][at & 3] * second[from];
        }
        y[l * l + row] = sum;
    }
}

vec3 rectangleLight(int element, vec3 place, float direct) {
    vec3 toCenter = u_center.xyz - place;
    float first[64];
    float second[64];
    float seen = rectangleSh(vec3(dot(toCenter, u_sideX.xyz), dot(toCenter, u_sideY.xyz),
                                  dot(toCenter, u_normal.xyz)),
                             vec2(u_sideX.w, u_sideY.w), ORDER, first, second);
    if (seen == 0.0)
        return vec3(0.0);
    float y[64];
    if (seen < 0.0) {
        shBasis64(normalize(toCenter), y);
        for (int row = 0; row < 8; ++row)
            for (int i = 0; i < 8; ++i)
                y[8 * row + i] *= -seen;
    } else {
        y[0] = 0.282094791773878 * seen;
        if (ORDER > 1)
            turnBand(1, 0, first, second, y);
        if (ORDER > 2)
            turnBand(2, 6, first, second, y);
        if (ORDER > 3)
            turnBand(3, 26, first, second, y);
        if (ORDER > 4)
            turnBand(4, 68, first, second, y);
        if (ORDER > 5)
            turnBand(5, 140, first, second, y);
        if (ORDER > 6)
            turnBand(6, 250, first, second, y);
        if (ORDER > 7)
            turnBand(7, 406, first, second, y);
    }
    float factor[8];
    rectangleFactors(abs(seen), ORDER, window(), factor);
    scaleBands(ORDER, factor, y);
    return LIGHTS[u_lightBegin].color.rgb * transferred(element, y, direct);
}

// What a surface of albedo 1 at `place` sends out of the whole rectangle.
vec3 openLight(int k, vec3 place, vec3 n) {
    vec3 x;
    vec3 y;
    orthonormalBasis(n, x, y);
    vec3 toCenter = LIGHTS[k].place.xyz - place;
    vec3 center = vec3(dot(x, toCenter), dot(y, toCenter), dot(n, toCenter));
    vec3 axis = LIGHTS[k].axis.xyz;
    vec3 side = LIGHTS[k].side.xyz;
    vec3 hx = vec3(dot(x, axis), dot(y, axis), dot(n, axis));
    vec3 hy = vec3(dot(x, side), dot(y, side), dot(n, side));
    return LIGHTS[k].color.rgb * quadFormFactor(center - hx - hy, center + hx - hy,
                                                  center + hx + hy, center - hx + hy);
}
#elif defined(NEAR_POINTS)
float reaches(int k, vec3 toLight, vec3 l) {
    return pointFalloff(dot(toLight, toLight), LIGHTS[k].color.w) *
           spotFalloff(dot(LIGHTS[k].axis.xyz, l), 1.0, LIGHTS[k].axis.w);
}

vec3 openLight(int k, vec3 place, vec3 n) {
    vec3 toLight = LIGHTS[k].place.xyz - place;
    vec3 l = toLight * inversesqrt(max(dot(toLight, toLight), 1e-12));
    return LIGHTS[k].color.rgb * reaches(k, toLight, l) * max(dot(n, l), 0.0) * kInvPi;
}
#else
vec3 openLight(int k, vec3 place, vec3 n) {
    vec3 toCenter = LIGHTS[k].place.xyz - place;
    float distance2 = max(dot(toCenter, toCenter), 1e-12);
    float sin2 = LIGHTS[k].axis.x * LIGHTS[k].axis.x / distance2;
    float cosBeta = dot(n, toCenter) * inversesqrt(distance2);
    return LIGHTS[k].color.rgb * (sin2 >= 1.0 ? 1.0 : sphereFormFactor(cosBeta, sin2));
}
#endif

// Of a light, at an element of the chunk; negative: it has none.
float shareOf(int k, int element) {
    if (u_shareRows == 0)
        return -1.0;
    int row = b_rows[k] - u_firstRow;
    if (row < 0 || row >= u_shareRows)
        return -1.0;
    return b_shares[row * u_elementCount + u_first + element];
}

void main() {
    int i = int(gl_GlobalInvocationID.x);
    if (i >= u_count)
        return;
    vec3 place = (u_placeToWorld * vec4(texelFetch(u_places, i * u_placeVectors).xyz, 1.0)).xyz;
    vec3 sum = u_adds != 0 ? b_near[u_first + i].rgb : vec3(0.0);
    vec3 n = u_shareRows != 0 ? normalOf(i) : vec3(0.0, 0.0, 1.0);
    for (int k = u_lightBegin; k < u_lightEnd; ++k) {
        float direct = 1.0; // of the transfer
        float share = shareOf(k, i);
        if (share >= 0.0) {
            direct = 0.0;
            sum += share * openLight(k, place, n);
#if !defined(COLORED) && !defined(OPEN_SKY)
            continue; // nothing bounces
#endif
        }
#ifdef NEAR_RECTANGLE
        sum += rectangleLight(i, place, direct);
#else
        vec3 toLight = LIGHTS[k].place.xyz - place;
        float y[64];
#ifdef NEAR_POINTS
        float distance2 = dot(toLight, toLight);
        vec3 l = toLight * inversesqrt(max(distance2, 1e-12));
        float arrives = reaches(k, toLight, l);
        if (arrives == 0.0)
            continue;
        nearPointSh(l, ORDER, window(), y);
#else
        const float arrives = 1.0;
        nearSphereSh(toLight, LIGHTS[k].axis.x, ORDER, window(), y);
#endif
        sum += LIGHTS[k].color.rgb * arrives * transferred(i, y, direct);
#endif
    }
    b_near[u_first + i] = vec4(sum, 0.0);
}
