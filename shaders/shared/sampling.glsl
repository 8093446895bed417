// Warping uniform numbers into directions, and the densities that result.
#ifndef PT_SAMPLING_GLSL
#define PT_SAMPLING_GLSL

#include "brdf.glsl"

// A right-handed frame (t, b, n) around the unit vector n, continuous except at n.z = 0.
// Duff et al. 2017, "Building an Orthonormal Basis, Revisited", JCGT 6(1), listing 3.
PT_FN void orthonormalBasis(vec3 n, PT_OUT(vec3) t, PT_OUT(vec3) b) {
    float s = n.z >= 0.0f ? 1.0f : -1.0f;
    float p = -1.0f / (s + n.z);
    float q = n.x * n.y * p;
    t = vec3(1.0f + s * n.x * n.x * p, s * q, -s * n.x);
    b = vec3(q, s + n.y * n.y * p, -n.y);
}

// Unit square to unit disc, area-preserving and with little distortion, so that stratification
// survives. Shirley & Chiu 1997, "A Low Distortion Map Between Disk and Square".
PT_FN vec2 concentricDisc(vec2 u) {
    float a = 2.0f * u.x - 1.0f;
    float b = 2.0f * u.y - 1.0f;
    if (a == 0.0f && b == 0.0f)
        return vec2(0.0f);
    if (abs(a) > abs(b)) {
        float phi = 0.25f * kPi * (b / a);
        return vec2(a * cos(phi), a * sin(phi));
    }
    float theta = 0.5f * kPi - 0.25f * kPi * (a / b);
    return vec2(b * cos(theta), b * sin(theta));
}

// Around +z with density cos(theta) / pi (Malley's method).
PT_FN vec3 cosineHemisphere(vec2 u) {
    vec2 p = concentricDisc(u);
    return vec3(p.x, p.y, sqrt(max(1.0f - dot(p, p), 0.0f)));
}

PT_FN float cosineHemispherePdf(float cosTheta) {
    return max(cosTheta, 0.0f) * kInvPi;
}

// All directions with density 1 / 4pi (Archimedes' hat-box theorem).
PT_FN vec3 uniformSphere(vec2 u) {
    float z = 1.0f - 2.0f * u.x;
    float r = 2.0f * sqrt(max(u.x * (1.0f - u.x), 0.0f));
    float phi = kTwoPi * u.y;
    return vec3(r * cos(phi), r * sin(phi), z);
}

// A half vector with the density of visible GGX normals, for wo with wo.z > 0 in the frame whose z
// is the normal. Dupuy & Benyoub 2023, "Sampling Visible GGX Normals with Spherical Caps",
// listings 1 and 3.
PT_FN vec3 sampleVndfGGX(vec2 u, vec3 wo, float alpha) {
    vec3 woStd = normalize(vec3(wo.x * alpha, wo.y * alpha, wo.z));
    float phi = kTwoPi * u.x;
    // z of a cap around +z that starts at -woStd.z: (1 - u)(1 + wo.z) - wo.z
    float z = (1.0f - u.y) * (1.0f + woStd.z) - woStd.z;
    float r = sqrt(clamp(1.0f - z * z, 0.0f, 1.0f));
    vec3 wmStd = vec3(r * cos(phi), r * sin(phi), z) + woStd;
    return normalize(vec3(wmStd.x * alpha, wmStd.y * alpha, wmStd.z));
}

// Density over wi of reflecting wo at such a half vector: G1(wo) D(wm) / (4 N·V), that is
// D / (2 (N·V + sqrt(N·V² (1 - alpha²) + alpha²))). Same paper, section 2; Heitz 2014.
PT_FN float vndfReflectionPdf(float NoV, float NoH, float alpha) {
    float a2 = alpha * alpha;
    return D_GGX(NoH, alpha) / (2.0f * (NoV + sqrt(NoV * NoV * (1.0f - a2) + a2)));
}

#endif
