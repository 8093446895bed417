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

// ---- Half vectors with density D N·H -----------------------------------------------------------
// u.x gives the angle from the normal: the inverse of its cumulative distribution.

PT_FN vec3 directionFromSin2(float sin2, float phi) {
    float s = sqrt(clamp(sin2, 0.0f, 1.0f));
    return vec3(s * cos(phi), s * sin(phi), sqrt(clamp(1.0f - sin2, 0.0f, 1.0f)));
}

// sin² = a² u / (1 + (a² - 1) u), that is tan² = a² u / (1 - u): Walter et al. 2007, equation 35.
PT_FN vec3 sampleHalfVectorGGX(vec2 u, float alpha) {
    float a2 = alpha * alpha;
    return directionFromSin2(a2 * u.x / (1.0f + (a2 - 1.0f) * u.x), kTwoPi * u.y);
}

// tan² = -a² log(1 - u): Walter et al. 2007, equation 28.
PT_FN vec3 sampleHalfVectorBeckmann(vec2 u, float alpha) {
    float tan2 = -alpha * alpha * logOneMinus(u.x);
    return directionFromSin2(tan2 / (1.0f + tan2), kTwoPi * u.y);
}

// cos² = (1 - u)^(a²), from Walter et al. 2007, equation 31 with p + 2 = 2 / a². Where the power is
// close to 1, 1 - exp(-t) by its Taylor series.
PT_FN vec3 sampleHalfVectorBlinnPhong(vec2 u, float alpha) {
    float t = -alpha * alpha * logOneMinus(u.x);
    float sin2 = 1.0f - exp(-t);
    if (t < 0.1f)
        sin2 = t * (1.0f - 0.5f * t * (1.0f - t / 3.0f * (1.0f - 0.25f * t)));
    return directionFromSin2(sin2, kTwoPi * u.y);
}

// Of the model's distribution around +z, for wo with wo.z > 0: the visible normals of GGX, all
// normals of the others.
PT_FN vec3 sampleHalfVector(BrdfModel m, vec2 u, vec3 wo, float alpha) {
    if (m.distribution == kDistributionBeckmann)
        return sampleHalfVectorBeckmann(u, alpha);
    if (m.distribution == kDistributionBlinnPhong)
        return sampleHalfVectorBlinnPhong(u, alpha);
    return sampleVndfGGX(u, wo, alpha);
}

// Density over wi of reflecting wo at such a half vector; `sin2` = |n × h|². D N·H / (4 V·H):
// Walter et al. 2007, equations 14 and 24; V·H falls to zero together with the lobe.
PT_FN float specularReflectionPdf(BrdfModel m, float NoV, float NoH, float sin2, float VoH,
                                  float alpha) {
    float D = distribution(m, NoH, sin2, alpha);
    if (m.distribution == kDistributionGGX) {
        float a2 = alpha * alpha;
        return D / (2.0f * (NoV + sqrt(NoV * NoV * (1.0f - a2) + a2)));
    }
    return D * NoH / (4.0f * max(VoH, 1e-6f));
}

// ---- EON ---------------------------------------------------------------------------------------
// Portsmouth, Kutz & Hill 2025, JCGT 14(1), section 4: a linearly transformed cosine, clipped to
// the hemisphere, mixed with the uniform hemisphere.

// The transform's entries (a b; c; d 1) for a viewer at cosine mu; listing 3.
PT_FN vec4 cltcCoefficients(float mu, float r) {
    float a = 1.0f + r * (0.303392f + (-0.518982f + 0.111709f * mu) * mu +
                          (-0.276266f + 0.335918f * mu) * r);
    float b = r * (-1.16407f + 1.15859f * mu + (0.150815f - 0.150105f * mu) * r) /
              (mu * mu * mu - 1.43545f);
    float c = 1.0f + (0.20013f + (-0.506373f + 0.261777f * mu) * mu) * r;
    float d = (0.540852f + (-1.01625f + 0.475392f * mu) * mu) * r /
              (-1.0743f + mu * (0.0725628f + mu));
    return vec4(a, b, c, d);
}

// Share of the uniform hemisphere; section 4.3.
PT_FN float eonUniformShare(float mu, float r) {
    return pow(r, 0.1f) * (0.162925f + mu * (-0.372058f + (0.538233f - 0.290822f * mu) * mu));
}

// The plane of wo and z is the transform's xz plane; straight down any plane is.
PT_FN vec2 cltcAxis(vec3 wo) {
    float length2 = wo.x * wo.x + wo.y * wo.y;
    if (length2 < 1e-12f)
        return vec2(1.0f, 0.0f);
    return vec2(wo.x, wo.y) * inversesqrt(length2);
}

PT_FN vec3 sampleCltc(vec2 u, vec3 wo, float r) {
    vec4 k = cltcCoefficients(wo.z, r);
    float radius = sqrt(u.x);
    float phi = kTwoPi * u.y;
    float x = radius * cos(phi);
    float y = radius * sin(phi);
    float s = 0.5f + 0.5f * inversesqrt(k.w * k.w + 1.0f);
    x = -mix(sqrt(max(1.0f - y * y, 0.0f)), x, s);
    float z = sqrt(max(1.0f - (x * x + y * y), 0.0f));
    vec3 w = normalize(vec3(k.x * x + k.y * z, k.z * y, k.w * x + z));
    vec2 axis = cltcAxis(wo);
    return vec3(axis.x * w.x - axis.y * w.y, axis.y * w.x + axis.x * w.y, max(w.z, 0.0f));
}

PT_FN float cltcPdf(vec3 wo, vec3 wi, float r) {
    vec4 k = cltcCoefficients(wo.z, r);
    vec2 axis = cltcAxis(wo);
    vec2 w = vec2(axis.x * wi.x + axis.y * wi.y, axis.x * wi.y - axis.y * wi.x);
    float determinant = k.z * (k.x - k.y * k.w);
    vec3 h = vec3(k.z * (w.x - k.y * wi.z), (k.x - k.y * k.w) * w.y,
                  -k.z * (k.w * w.x - k.x * wi.z));
    float length2 = dot(h, h);
    float s = 0.5f + 0.5f * inversesqrt(k.w * k.w + 1.0f);
    return determinant * determinant / (length2 * length2) * max(h.z, 0.0f) * kInvPi / s;
}

// Around +z, for wo.z > 0; diffuse roughness r in 0…1.
PT_FN vec3 sampleEon(vec2 u, vec3 wo, float r) {
    float uniformShare = eonUniformShare(wo.z, r);
    if (u.x < uniformShare) {
        float z = u.x / uniformShare;
        float rho = sqrt(max(1.0f - z * z, 0.0f));
        return vec3(rho * cos(kTwoPi * u.y), rho * sin(kTwoPi * u.y), z);
    }
    return sampleCltc(vec2((u.x - uniformShare) / (1.0f - uniformShare), u.y), wo, r);
}

PT_FN float eonPdf(vec3 wo, vec3 wi, float r) {
    if (wi.z <= 0.0f)
        return 0.0f;
    return mix(cltcPdf(wo, wi, r), 1.0f / kTwoPi, eonUniformShare(wo.z, r));
}

// ---- The whole surface -------------------------------------------------------------------------

// How often the specular lobe is sampled: by what each lobe reflects; neither lobe is starved,
// because albedos are averages over lights and a single bright one may shine into the weaker lobe.
PT_FN float specularProbability(SurfaceTerms s) {
    float specular = dot(s.specularAlbedo, vec3(1.0f));
    float diffuse = dot(s.diffuseAlbedo, vec3(1.0f));
    if (diffuse <= 0.0f)
        return 1.0f;
    return clamp(specular / (specular + diffuse), 0.1f, 0.9f);
}

// The viewer in the frame whose z is the normal; never below it.
PT_FN vec3 viewerInFrame(SurfaceTerms s, vec3 t, vec3 b) {
    return normalize(vec3(dot(s.v, t), dot(s.v, b), s.NoV));
}

// Density of sampleBrdf() at `l`; 0 below the horizon.
PT_FN float brdfPdf(SurfaceTerms s, vec3 l) {
    vec3 t;
    vec3 b;
    orthonormalBasis(s.n, t, b);
    vec3 wo = viewerInFrame(s, t, b);
    vec3 wi = vec3(dot(l, t), dot(l, b), dot(l, s.n));
    if (wi.z <= 0.0f)
        return 0.0f;
    float pdf = cosineHemispherePdf(wi.z);
    if (s.model.diffuse == kDiffuseEon)
        pdf = eonPdf(wo, wi, s.diffuseRoughness);
    vec3 h = wo + wi;
    float length2 = dot(h, h);
    float specular = 0.0f;
    if (length2 > 1e-12f) {
        h = h * inversesqrt(length2);
        specular = specularReflectionPdf(s.model, wo.z, h.z, h.x * h.x + h.y * h.y,
                                         clamp(dot(wo, h), 0.0f, 1.0f), s.alpha);
    }
    return mix(pdf, specular, specularProbability(s));
}

// A direction to a light with about the density of the reflection: u.z chooses the lobe, u.xy the
// direction. pdf = 0: it points below the surface and carries no light. The estimate of what is
// reflected is shadeDirect(s, l, radiance) / pdf.
PT_FN vec3 sampleBrdf(SurfaceTerms s, vec3 u, PT_OUT(float) pdf) {
    vec3 t;
    vec3 b;
    orthonormalBasis(s.n, t, b);
    vec3 wo = viewerInFrame(s, t, b);
    vec2 point = vec2(u.x, u.y);
    vec3 wi;
    if (u.z < specularProbability(s))
        wi = reflect(-wo, sampleHalfVector(s.model, point, wo, s.alpha));
    else if (s.model.diffuse == kDiffuseEon)
        wi = sampleEon(point, wo, s.diffuseRoughness);
    else
        wi = cosineHemisphere(point);
    vec3 l = normalize(wi.x * t + wi.y * b + wi.z * s.n);
    pdf = brdfPdf(s, l);
    return l;
}

#endif
