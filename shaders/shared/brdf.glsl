// The surface's reflection of an analytic light, from terms to the shaded result:
//   term (D, V, F) -> dispatch (which D, which V) -> lobe (specular, diffuse) -> shading.
// Names as in the literature: n normal, v to the viewer, l to the light, h half vector;
// alpha = perceptualRoughness². BRDFs are in 1/sr and do not contain N·L.
#ifndef PT_BRDF_GLSL
#define PT_BRDF_GLSL

#include "constants.glsl"

// ---- Terms -------------------------------------------------------------------------------------

// Trowbridge & Reitz 1975; Walter et al. 2007, equation 33, isotropic:
//   D = a² / (pi ((n·h)² (a² - 1) + 1)²)
// Written with sin² = 1 - (n·h)² the bracket is sin² + a² cos²: a sum of positive numbers, where
// the textbook form cancels all digits of a² = 1e-5 against 1. Pass |n × h|² where the vectors are
// known: it has full precision near the peak, which 1 - (n·h)² has not.
PT_FN float D_GGX_Sin2(float NoH, float sin2, float alpha) {
    float a2 = alpha * alpha;
    float b = alpha / (sin2 + a2 * NoH * NoH);
    return b * b * kInvPi;
}

PT_FN float D_GGX(float NoH, float alpha) {
    return D_GGX_Sin2(NoH, (1.0f - NoH) * (1.0f + NoH), alpha);
}

// V = G2 / (4 N·V N·L), Smith height-correlated: Heitz 2014, "Understanding the Masking-Shadowing
// Function", equation 99. Positive for NoV > 0, NoL >= 0, alpha > 0.
PT_FN float V_SmithGGXCorrelated(float NoV, float NoL, float alpha) {
    float a2 = alpha * alpha;
    float lambdaV = NoL * sqrt(NoV * NoV * (1.0f - a2) + a2);
    float lambdaL = NoV * sqrt(NoL * NoL * (1.0f - a2) + a2);
    return 0.5f / (lambdaV + lambdaL);
}

// Smith masking of one direction, Heitz 2014, equations 43 and 72.
PT_FN float G1_SmithGGX(float NoX, float alpha) {
    float a2 = alpha * alpha;
    return 2.0f * NoX / (NoX + sqrt(NoX * NoX * (1.0f - a2) + a2));
}

// Schlick 1994, equation 15, with reflectance f90 at grazing incidence.
PT_FN vec3 F_Schlick(vec3 f0, float f90, float VoH) {
    float m = clamp(1.0f - VoH, 0.0f, 1.0f);
    float m2 = m * m;
    return f0 + (vec3(f90) - f0) * (m2 * m2 * m);
}

// Lambert 1760: constant, so that the albedo is the directional-hemispherical reflectance.
PT_FN float Fd_Lambert() {
    return kInvPi;
}

// ---- Dispatch: the one place where a model is chosen -------------------------------------------

PT_FN float distribution(float NoH, float sin2, float alpha) {
    return D_GGX_Sin2(NoH, sin2, alpha);
}

PT_FN float visibility(float NoV, float NoL, float alpha) {
    return V_SmithGGXCorrelated(NoV, NoL, alpha);
}

PT_FN vec3 fresnel(vec3 f0, float VoH) {
    return F_Schlick(f0, 1.0f, VoH);
}

PT_FN float diffuse() {
    return Fd_Lambert();
}

// ---- The surface -------------------------------------------------------------------------------

// All that shading needs to know about a point; makeSurface() fills it.
struct SurfaceTerms {
    vec3 n;                    // shading normal, unit
    vec3 v;                    // to the viewer, unit
    float NoV;                 // >= kMinNoV
    float perceptualRoughness; // as authored, 0…1: picks the prefiltered level
    float alpha;               // of analytic lights: square of the clamped perceptual roughness
    vec3 diffuseColor;       // albedo of the diffuse lobe before the specular layer takes its share
    vec3 f0;                 // specular reflectance at normal incidence
    vec3 energyCompensation; // multiple scattering, factor on the single-scatter specular lobe
    vec3 specularAlbedo;     // directional albedo of the specular lobe, compensation included
    vec3 diffuseAlbedo;      // diffuseColor * (1 - specularAlbedo)
};

PT_FN float alphaFromPerceptualRoughness(float perceptualRoughness) {
    float r = clamp(perceptualRoughness, kMinPerceptualRoughness, 1.0f);
    return r * r;
}

// glTF 2.0, appendix B.3.5: dielectrics have F0 = 0.04, metals the base colour.
PT_FN vec3 f0FromBaseColor(vec3 baseColor, float metallic) {
    return mix(vec3(kDielectricF0), baseColor, metallic);
}

// glTF 2.0, appendix B.3.5: metals have no diffuse lobe.
PT_FN vec3 diffuseColorFromBaseColor(vec3 baseColor, float metallic) {
    return baseColor * (1.0f - metallic);
}

// Light that single-scatter GGX loses between its facets comes back, tinted by F0:
// 1 + F0 (1 - E) / E with E = scale + bias, the albedo for F0 = 1.
// Turquin 2019, "Practical multiple scattering compensation for microfacet models", equation 16.
// E is never below 0.3 (1 - ln 2 at alpha = 1, N·V = 1); the floor guards an empty table.
PT_FN vec3 energyCompensationTurquin(vec3 f0, vec2 dfg) {
    float E = max(dfg.x + dfg.y, 1e-3f);
    return vec3(1.0f) + f0 * (1.0f / E - 1.0f);
}

// Split-sum albedo of the specular lobe, Karis 2013: F0 * scale + bias, then compensated.
PT_FN vec3 specularAlbedoFromDfg(vec3 f0, vec2 dfg) {
    return min((f0 * dfg.x + vec3(dfg.y)) * energyCompensationTurquin(f0, dfg), vec3(1.0f));
}

// `dfg`: (scale, bias) of the DFG table at (N·V, perceptualRoughness).
PT_FN SurfaceTerms makeSurface(vec3 baseColor, float metallic, float perceptualRoughness, vec3 n,
                               vec3 v, vec2 dfg) {
    SurfaceTerms s;
    s.n = n;
    s.v = v;
    s.NoV = max(dot(n, v), kMinNoV);
    s.perceptualRoughness = clamp(perceptualRoughness, 0.0f, 1.0f);
    s.alpha = alphaFromPerceptualRoughness(perceptualRoughness);
    s.diffuseColor = diffuseColorFromBaseColor(baseColor, metallic);
    s.f0 = f0FromBaseColor(baseColor, metallic);
    s.energyCompensation = energyCompensationTurquin(s.f0, dfg);
    s.specularAlbedo = specularAlbedoFromDfg(s.f0, dfg);
    // Albedo scaling: what the specular layer reflects towards the viewer cannot enter the diffuse
    // one (Kulla & Conty 2017, slide 26; OpenPBR 1.1, section 3.7). A white dielectric in a white
    // furnace then returns exactly 1 at every angle and roughness.
    s.diffuseAlbedo = s.diffuseColor * (vec3(1.0f) - s.specularAlbedo);
    return s;
}

// ---- Lobes -------------------------------------------------------------------------------------

// Cook & Torrance 1982: D V F, and the light scattered more than once. For NoL > 0.
PT_FN vec3 specularLobe(SurfaceTerms s, float NoH, float sin2, float NoL, float VoH) {
    float D = distribution(NoH, sin2, s.alpha);
    float V = visibility(s.NoV, NoL, s.alpha);
    return fresnel(s.f0, VoH) * s.energyCompensation * (D * V);
}

PT_FN vec3 diffuseLobe(SurfaceTerms s) {
    return s.diffuseAlbedo * diffuse();
}

// ---- Shading -----------------------------------------------------------------------------------

// Reflected radiance of one source of light, by lobe.
struct ShadedLight {
    vec3 diffuse;
    vec3 specular;
};

// `l`: unit vector to the light; `irradiance`: of a surface that faces the light. Directional
// light: its intensity E; point light of intensity I (W/sr) at distance d: I / d².
PT_FN ShadedLight shadeDirect(SurfaceTerms s, vec3 l, vec3 irradiance) {
    ShadedLight result;
    result.diffuse = vec3(0.0f);
    result.specular = vec3(0.0f);
    float NoL = dot(s.n, l);
    if (NoL <= 0.0f)
        return result;
    vec3 h = s.v + l;
    float length2 = dot(h, h);
    result.diffuse = diffuseLobe(s) * irradiance * NoL;
    if (length2 <
        1e-12f) // v = -l: no half vector, a surface between viewer and light reflects none
        return result;
    h = h * inversesqrt(length2);
    vec3 nxh = cross(s.n, h);
    float NoH = clamp(dot(s.n, h), 0.0f, 1.0f);
    float VoH = clamp(dot(s.v, h), 0.0f, 1.0f);
    result.specular = specularLobe(s, NoH, dot(nxh, nxh), NoL, VoH) * irradiance * NoL;
    return result;
}

#endif
