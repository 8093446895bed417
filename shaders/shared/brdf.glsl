// The surface's reflection of an analytic light, from terms to the shaded result:
//   term (D, V, F) -> dispatch (which D, which V) -> lobe (specular, diffuse) -> shading.
// Names as in the literature: n normal, v to the viewer, l to the light, h half vector;
// alpha = perceptualRoughness². BRDFs are in 1/sr and do not contain N·L.
#ifndef PT_BRDF_GLSL
#define PT_BRDF_GLSL

#include "constants.glsl"

// ---- The model ---------------------------------------------------------------------------------

// Which term stands for what: the enumerators of core/document/Document.h.
PT_CONST int kDistributionGGX = 0;
PT_CONST int kDistributionBeckmann = 1;
PT_CONST int kDistributionBlinnPhong = 2;
PT_CONST int kVisibilitySmithCorrelated = 0;
PT_CONST int kVisibilitySmithSeparable = 1;
PT_CONST int kVisibilitySchlickDirect = 2;
PT_CONST int kVisibilitySchlickIbl = 3;
PT_CONST int kVisibilityKelemen = 4;
PT_CONST int kVisibilityImplicit = 5;
PT_CONST int kFresnelSchlick = 0;
PT_CONST int kFresnelSchlickF90 = 1;
PT_CONST int kFresnelDielectric = 2;
PT_CONST int kFresnelConductor = 3;
PT_CONST int kDiffuseLambert = 0;
PT_CONST int kDiffuseBurley = 1;
PT_CONST int kDiffuseOrenNayar = 2;
PT_CONST int kDiffuseEon = 3;
PT_CONST int kLobeDirectionMean = 0;
PT_CONST int kLobeDirectionMirror = 1;

// The choice of terms and the numbers some of them need. On the CPU these are run-time values; the
// viewport's shader fills the choices with constants of its variant, so that the compiler leaves
// nothing of the terms that were not chosen.
struct BrdfModel {
    int distribution;
    int visibility;
    int fresnel;
    int diffuse;
    int multiScatter;  // 1: energy compensation, 0: single scattering only
    int lobeDirection; // where image-based specular light is looked up
    float f90;         // SchlickF90: reflectance at grazing incidence
    float ior;         // Dielectric: refractive index of non-metals, >= 1
    float dielectricF0; // the other models: reflectance of non-metals at normal incidence
    vec3 conductorN;   // Conductor: complex refractive index n + ik of metals, per channel
    vec3 conductorK;
};

// Patina's default: GGX, height-correlated Smith, Schlick, Lambert, nothing lost.
PT_FN BrdfModel defaultBrdfModel() {
    BrdfModel m;
    m.distribution = kDistributionGGX;
    m.visibility = kVisibilitySmithCorrelated;
    m.fresnel = kFresnelSchlick;
    m.diffuse = kDiffuseLambert;
    m.multiScatter = 1;
    m.lobeDirection = kLobeDirectionMean;
    m.f90 = 1.0f;
    m.ior = kDielectricIor;
    m.dielectricF0 = kDielectricF0;
    m.conductorN = vec3(1.0f);
    m.conductorK = vec3(1.0f);
    return m;
}

// ---- Terms: D ----------------------------------------------------------------------------------

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

// Beckmann & Spizzichino 1963; Walter et al. 2007, equation 25:
//   D = exp(-tan² / a²) / (pi a² cos⁴)
// The floor keeps 0 / 0 out at N·H = 0; the exponential is zero long before (tan² = 1e8).
PT_FN float D_Beckmann_Sin2(float NoH, float sin2, float alpha) {
    float a2 = alpha * alpha;
    float cos2 = max(NoH * NoH, 1e-8f);
    return exp(-sin2 / (a2 * cos2)) * kInvPi / (a2 * cos2 * cos2);
}

// log(1 - x) for x in 0…1. Where 1 - x would round the digits of x away, its Taylor series.
PT_FN float logOneMinus(float x) {
    if (x < 0.1f)
        return -x *
               (1.0f +
                x * (0.5f + x * (0.333333333f + x * (0.25f + x * (0.2f + x * 0.166666667f)))));
    return log(max(1.0f - x, 1e-30f));
}

// Blinn 1977 as a normalised distribution of normals: (p + 2) / 2pi (n·h)^p, Walter et al. 2007,
// equation 30, with the exponent p = 2 / a² - 2 that gives the peak of GGX and Beckmann,
// 1 / (pi a²). (n·h)^p = (1 - sin²)^(p / 2).
PT_FN float D_BlinnPhong_Sin2(float sin2, float alpha) {
    float inverseA2 = 1.0f / (alpha * alpha);
    return exp((inverseA2 - 1.0f) * logOneMinus(sin2)) * inverseA2 * kInvPi;
}

// ---- Terms: V = G2 / (4 N·V N·L) ---------------------------------------------------------------
// For NoV > 0, NoL >= 0, alpha > 0.

// Smith height-correlated: Heitz 2014, "Understanding the Masking-Shadowing Function", equation 99.
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

// Smith separable, G2 = G1(v) G1(l): Walter et al. 2007, equations 23 and 34.
PT_FN float V_SmithGGXSeparable(float NoV, float NoL, float alpha) {
    float a2 = alpha * alpha;
    return 1.0f / ((NoV + sqrt(NoV * NoV * (1.0f - a2) + a2)) *
                   (NoL + sqrt(NoL * NoL * (1.0f - a2) + a2)));
}

// N·X Lambda(X) of Beckmann: Heitz 2014, equation 68's rational fit (from Walter et al. 2007,
// equation 27, relative error of G1 below 0.35 %); the exact form needs erf, which GLSL has not.
// Times N·X, because Lambda alone has a pole at the horizon. Blinn-Phong has no closed form and
// borrows it, as Walter et al. recommend: their a = sqrt(p / 2 + 1) / tan is 1 / (alpha tan) here.
PT_FN float scaledLambdaBeckmann(float NoX, float alpha) {
    float alphaSin = alpha * sqrt(max(1.0f - NoX * NoX, 0.0f));
    if (NoX >= 1.6f * alphaSin)
        return 0.0f;
    float a = NoX / alphaSin;
    return alphaSin * max(1.0f + a * (0.396f * a - 1.259f), 0.0f) / (3.535f + 2.181f * a);
}

PT_FN float G1_SmithBeckmann(float NoX, float alpha) {
    return NoX / (NoX + scaledLambdaBeckmann(NoX, alpha));
}

// G2 = 1 / (1 + Lambda(v) + Lambda(l)), Heitz 2014, equation 99.
PT_FN float V_SmithBeckmannCorrelated(float NoV, float NoL, float alpha) {
    return 0.25f / (NoV * NoL + NoL * scaledLambdaBeckmann(NoV, alpha) +
                    NoV * scaledLambdaBeckmann(NoL, alpha));
}

PT_FN float V_SmithBeckmannSeparable(float NoV, float NoL, float alpha) {
    return 0.25f / ((NoV + scaledLambdaBeckmann(NoV, alpha)) *
                    (NoL + scaledLambdaBeckmann(NoL, alpha)));
}

// G1 = N·X / (N·X (1 - k) + k), Schlick 1994, equation 19, as Karis 2013, "Real Shading in Unreal
// Engine 4", uses it: with k = (r + 1)² / 8 for analytic lights and k = alpha / 2 for images.
PT_FN float V_SchlickGGX(float NoV, float NoL, float k) {
    return 0.25f / ((NoV * (1.0f - k) + k) * (NoL * (1.0f - k) + k));
}

PT_FN float schlickKDirect(float perceptualRoughness) {
    return (perceptualRoughness + 1.0f) * (perceptualRoughness + 1.0f) / 8.0f;
}

// G = N·V N·L / (V·H)²: Kelemen & Szirmay-Kalos 2001, "A Microfacet Based Coupled Specular-Matte
// BRDF Model", equation 6. The floor bounds opposite directions at grazing angles, where it has a
// pole.
PT_FN float V_Kelemen(float VoH) {
    return 0.25f / max(VoH * VoH, 1e-4f);
}

// G = N·V N·L, so that nothing remains to be computed (Hoffman 2013, SIGGRAPH course notes).
PT_FN float V_Implicit() {
    return 0.25f;
}

// ---- Terms: F ----------------------------------------------------------------------------------

PT_FN float schlickWeight(float cosine) {
    float m = clamp(1.0f - cosine, 0.0f, 1.0f);
    float m2 = m * m;
    return m2 * m2 * m;
}

// Schlick 1994, equation 15, with reflectance f90 at grazing incidence.
PT_FN vec3 F_Schlick(vec3 f0, float f90, float VoH) {
    return f0 + (vec3(f90) - f0) * schlickWeight(VoH);
}

PT_FN float f0FromIor(float ior) {
    float q = (ior - 1.0f) / (ior + 1.0f);
    return q * q;
}

// Fresnel's equations for unpolarised light on a dielectric of relative index ior >= 1: Cook &
// Torrance 1982, equation 17; Walter et al. 2007, equation 22. The floor guards ior = 1 at the
// horizon, where nothing is reflected.
PT_FN float F_Dielectric(float VoH, float ior) {
    float c = clamp(VoH, 0.0f, 1.0f);
    float g = sqrt(max(ior * ior - 1.0f + c * c, 0.0f));
    float a = (g - c) / max(g + c, 1e-6f);
    float b = (c * (g + c) - 1.0f) / (c * (g - c) + 1.0f);
    return 0.5f * a * a * (1.0f + b * b);
}

// Fresnel's equations for unpolarised light on a conductor of complex index n + ik in air, per
// channel: Born & Wolf 1999, section 14.2, in the real form of Lagarde 2013, "Memo on Fresnel
// equations". For n > 0.
PT_FN vec3 F_Conductor(float VoH, vec3 n, vec3 k) {
    float c = clamp(VoH, 0.0f, 1.0f);
    float c2 = c * c;
    float s2 = 1.0f - c2;
    vec3 d = n * n - k * k - vec3(s2);
    vec3 a2b2 = sqrt(d * d + 4.0f * (n * n) * (k * k));
    vec3 a = sqrt(max(0.5f * (a2b2 + d), vec3(0.0f)));
    vec3 p = a2b2 + vec3(c2);
    vec3 q = 2.0f * c * a;
    vec3 rs = max(p - q, vec3(0.0f)) / (p + q);
    vec3 u = c2 * a2b2 + vec3(s2 * s2);
    vec3 w = q * s2;
    return 0.5f * rs * (vec3(1.0f) + (u - w) / (u + w));
}

// ---- Terms: diffuse ----------------------------------------------------------------------------

// Lambert 1760: constant, so that the albedo is the directional-hemispherical reflectance.
PT_FN float Fd_Lambert() {
    return kInvPi;
}

// Burley 2012, "Physically Based Shading at Disney", section 5.3.
PT_FN float Fd_Burley(float NoV, float NoL, float VoH, float perceptualRoughness) {
    float f = 2.0f * perceptualRoughness * VoH * VoH - 0.5f; // FD90 - 1
    return kInvPi * (1.0f + f * schlickWeight(NoL)) * (1.0f + f * schlickWeight(NoV));
}

// Its directional albedo in closed form. With m + r sin sin' cos(phi) for FD90 - 1, where
// m = r (1 + N·V N·L) - 1/2, the azimuth integrates away and a polynomial in N·L remains; the
// fractions are ∫ x^k (1 - x)^5 dx = k! 5! / (k + 6)!. Reaches 1.56 at the horizon for r = 1.
PT_FN float E_Burley(float NoV, float perceptualRoughness) {
    float r = perceptualRoughness;
    float p = r - 0.5f;
    float q = r * NoV;
    float w = schlickWeight(NoV);
    float once = p / 42.0f + q / 168.0f + w * (0.5f * p + q / 3.0f);
    float twice = w * (p * p / 42.0f + p * q / 84.0f + q * q / 504.0f +
                       0.5f * r * r * (1.0f - NoV * NoV) * (1.0f / 42.0f - 1.0f / 504.0f));
    return 1.0f + 2.0f * (once + twice);
}

// The coefficients (A, B) of Oren & Nayar 1994, "Generalization of Lambert's Reflectance Model",
// equation 30: the qualitative model; sigma, the deviation of the facets' slope angle, in radians.
PT_FN vec2 orenNayarCoefficients(float sigma) {
    float s2 = sigma * sigma;
    return vec2(1.0f - 0.5f * s2 / (s2 + 0.33f), 0.45f * s2 / (s2 + 0.09f));
}

// A + B max(0, cos phi) sin(larger angle) tan(smaller angle), without angles.
PT_FN float Fd_OrenNayar(float NoV, float NoL, float VoL, float sigma) {
    vec2 c = orenNayarCoefficients(sigma);
    float s = max(VoL - NoL * NoV, 0.0f);
    return kInvPi * (c.x + c.y * s / max(max(NoL, NoV), 1e-6f));
}

// Its directional albedo in closed form: A + B / pi (s (theta - s cos) + 2/3 tan (1 - s³)), s = sin
// theta of the viewer. 1 - s³ = cos² (1 + s + s²) / (1 + s) has no cancelling digits, and takes the
// tangent's pole away.
PT_FN float E_OrenNayar(float NoV, float sigma) {
    vec2 c = orenNayarCoefficients(sigma);
    float x = clamp(NoV, 0.0f, 1.0f);
    float s = sqrt(1.0f - x * x);
    float g = s * (acos(x) - s * x) + 2.0f / 3.0f * s * x * (1.0f + s + s * s) / (1.0f + s);
    return c.x + c.y * kInvPi * g;
}

// EON: Portsmouth, Kutz & Hill 2025, "EON: A Practical Energy-Preserving Rough Diffuse BRDF", JCGT
// 14(1). Fujii's Oren-Nayar (FON) for light scattered once, r = 0…1, and a lobe for the rest.
PT_CONST float kFonA = 0.287793409210806f;   // 1/2 - 2 / 3pi
PT_CONST float kFonAvg = 0.0724882124569155f; // 2/3 - 28 / 15pi

// Albedo of FON at albedo 1: equation 14's polynomial fit, within 0.1 % of the exact one.
PT_FN float E_FON(float NoX, float r) {
    float x = 1.0f - NoX;
    float g = x * (0.0571085289f +
                   x * (0.491881867f + x * (-0.332181442f + x * 0.0714429953f))); // G / pi
    return (1.0f + r * g) / (1.0f + kFonA * r);
}

// Albedo of light scattered twice and more, a geometric series: section 3. It has no sum for albedos
// far above 1, which a renderer may be handed; its ratio is cut at that of white.
PT_FN vec3 multiScatterAlbedoEon(vec3 rho, float r) {
    float average = (1.0f + kFonAvg * r) / (1.0f + kFonA * r);
    return rho * rho * average / (vec3(1.0f) - min(rho, vec3(1.0f)) * (1.0f - average));
}

// Listing 1; 1e-7 keeps 0 / 0 out at r = 0, where there is no second lobe; s is below -1 only for
// viewers behind the surface, whose N·V is not that of v.
PT_FN vec3 Fd_Eon(vec3 rho, float NoV, float NoL, float VoL, float r) {
    float s = VoL - NoL * NoV;
    float t = s > 0.0f ? s / max(max(NoL, NoV), 1e-6f) : max(s, -1.0f);
    float single = (1.0f + r * t) / (1.0f + kFonA * r);
    float average = (1.0f + kFonAvg * r) / (1.0f + kFonA * r);
    float multiple = max(1.0f - E_FON(NoV, r), 1e-7f) * max(1.0f - E_FON(NoL, r), 1e-7f) /
                     max(1.0f - average, 1e-7f);
    return kInvPi * (rho * single + multiScatterAlbedoEon(rho, r) * multiple);
}

// Listing 2: 1 for rho = 1 at every angle and roughness.
PT_FN vec3 E_Eon(vec3 rho, float NoV, float r) {
    float E = E_FON(NoV, r);
    return rho * E + multiScatterAlbedoEon(rho, r) * (1.0f - E);
}

// ---- Dispatch: the one place where a model is chosen -------------------------------------------

PT_FN float distribution(BrdfModel m, float NoH, float sin2, float alpha) {
    if (m.distribution == kDistributionBeckmann)
        return D_Beckmann_Sin2(NoH, sin2, alpha);
    if (m.distribution == kDistributionBlinnPhong)
        return D_BlinnPhong_Sin2(sin2, alpha);
    return D_GGX_Sin2(NoH, sin2, alpha);
}

// The Smith terms are those of the distribution. All pairs keep E <= 1 but Blinn-Phong with the Smith
// terms it borrows: for r > 0.5 at grazing views E grows to 1.7.
PT_FN float visibility(BrdfModel m, float NoV, float NoL, float VoH, float alpha) {
    if (m.visibility == kVisibilitySmithSeparable) {
        if (m.distribution == kDistributionGGX)
            return V_SmithGGXSeparable(NoV, NoL, alpha);
        return V_SmithBeckmannSeparable(NoV, NoL, alpha);
    }
    if (m.visibility == kVisibilitySchlickDirect)
        return V_SchlickGGX(NoV, NoL, schlickKDirect(sqrt(alpha)));
    if (m.visibility == kVisibilitySchlickIbl)
        return V_SchlickGGX(NoV, NoL, 0.5f * alpha);
    if (m.visibility == kVisibilityKelemen)
        return V_Kelemen(VoH);
    if (m.visibility == kVisibilityImplicit)
        return V_Implicit();
    if (m.distribution == kDistributionGGX)
        return V_SmithGGXCorrelated(NoV, NoL, alpha);
    return V_SmithBeckmannCorrelated(NoV, NoL, alpha);
}

// The model as it holds for a non-metal of refractive index `ior` (KHR_materials_ior). At the
// standard index F0 is the constant itself, not its quotient, so that no picture depends on
// rounding; and the exact dielectric takes the model's index, which stands for all such materials.
PT_FN BrdfModel modelOfIndex(BrdfModel model, float ior) {
    BrdfModel m = model;
    bool standard = ior == kDielectricIor;
    m.dielectricF0 = standard ? kDielectricF0 : f0FromIor(ior);
    m.ior = standard && m.fresnel == kFresnelDielectric ? model.ior : ior;
    return m;
}

// Reflectance at normal incidence. glTF 2.0, appendix B.3.5: dielectrics have F0 = 0.04, those of
// another index that of the index, metals the base colour; an exact conductor has that of its
// index, whatever its base colour.
PT_FN vec3 normalReflectance(BrdfModel m, vec3 baseColor, float metallic) {
    if (m.fresnel == kFresnelDielectric)
        return mix(vec3(f0FromIor(m.ior)), baseColor, metallic);
    if (m.fresnel == kFresnelConductor)
        return mix(vec3(m.dielectricF0), F_Conductor(1.0f, m.conductorN, m.conductorK), metallic);
    return mix(vec3(m.dielectricF0), baseColor, metallic);
}

// `f0`: normalReflectance(). The exact dielectric replaces Schlick for non-metals and the exact
// conductor for metals; the other of the two keeps Schlick.
PT_FN vec3 fresnel(BrdfModel m, vec3 f0, float metallic, float VoH) {
    float other = 1.0f - metallic;
    if (m.fresnel == kFresnelDielectric) {
        vec3 metal = max(f0 - vec3(other * f0FromIor(m.ior)), vec3(0.0f)); // its share of f0
        return vec3(other * F_Dielectric(VoH, m.ior)) + F_Schlick(metal, metallic, VoH);
    }
    if (m.fresnel == kFresnelConductor)
        return other * F_Schlick(vec3(m.dielectricF0), 1.0f, VoH) +
               metallic * F_Conductor(VoH, m.conductorN, m.conductorK);
    if (m.fresnel == kFresnelSchlickF90)
        return F_Schlick(f0, m.f90, VoH);
    return F_Schlick(f0, 1.0f, VoH);
}

// The diffuse BRDF of albedo rho. Oren-Nayar's sigma is the diffuse roughness in radians (as in
// MaterialX). At grazing views Burley's lobe returns up to 1.56 and Oren-Nayar's up to 1.01 of what
// arrives: both are limited to 1.
PT_FN vec3 diffuse(BrdfModel m, vec3 rho, float perceptualRoughness, float diffuseRoughness,
                   float NoV, float NoL, float VoH) {
    float VoL = 2.0f * VoH * VoH - 1.0f;
    if (m.diffuse == kDiffuseBurley)
        return rho * (Fd_Burley(NoV, NoL, VoH, perceptualRoughness) /
                      max(E_Burley(NoV, perceptualRoughness), 1.0f));
    if (m.diffuse == kDiffuseOrenNayar)
        return rho * (Fd_OrenNayar(NoV, NoL, VoL, diffuseRoughness) /
                      max(E_OrenNayar(NoV, diffuseRoughness), 1.0f));
    if (m.diffuse == kDiffuseEon)
        return Fd_Eon(rho, NoV, NoL, VoL, diffuseRoughness);
    return rho * Fd_Lambert();
}

// Its directional albedo: ∫ diffuse() cos dω over the lights.
PT_FN vec3 diffuseReflectance(BrdfModel m, vec3 rho, float perceptualRoughness,
                              float diffuseRoughness, float NoV) {
    if (m.diffuse == kDiffuseBurley)
        return rho * min(E_Burley(NoV, perceptualRoughness), 1.0f);
    if (m.diffuse == kDiffuseOrenNayar)
        return rho * min(E_OrenNayar(NoV, diffuseRoughness), 1.0f);
    if (m.diffuse == kDiffuseEon)
        return E_Eon(rho, NoV, diffuseRoughness);
    return rho;
}

// ---- The surface -------------------------------------------------------------------------------

// What a material says of a point: its numbers, times their maps. Every number but the diffuse
// roughness and the index is an input of the table core/material/MaterialInputs.h.
struct SurfaceInputs {
    vec3 baseColor PT_INIT(1.0f);           // linear sRGB, 0…1
    float metallic PT_INIT(1.0f);            // 0…1
    float perceptualRoughness PT_INIT(0.5f); // as authored, 0…1
    float diffuseRoughness PT_INIT(0.0f);    // 0…1, of Oren-Nayar and EON
    float transmission PT_INIT(0.0f);        // 0…1, share of a non-metal's body that is clear
    float ior PT_INIT(1.5f);                 // refractive index of non-metals, >= 1
    PT_EQUALITY(SurfaceInputs)
};

// All that shading needs to know about a point; makeSurface() fills it.
struct SurfaceTerms {
    BrdfModel model;
    vec3 n;                    // shading normal, unit
    vec3 v;                    // to the viewer, unit
    float NoV;                 // >= kMinNoV
    float metallic;            // 0…1
    float perceptualRoughness; // as authored, 0…1: picks the prefiltered level
    float alpha;               // of analytic lights: square of the clamped perceptual roughness
    float diffuseRoughness;    // 0…1, of Oren-Nayar and EON
    vec3 diffuseColor;       // albedo of the diffuse lobe before the specular layer takes its share
    vec3 f0;                 // specular reflectance at normal incidence
    vec3 energyCompensation; // multiple scattering, factor on the single-scatter specular lobe
    vec3 specularAlbedo;     // directional albedo of the specular lobe, compensation included
    vec3 transmission;       // 1 - specularAlbedo: what the layer lets through to the diffuse lobe;
                             // of a faded layer (fadeSpecularLayer) the more
    vec3 diffuseAlbedo;      // directional albedo of the diffuse lobe under the layer
    vec3 clearColor;         // what a clear body lets through, before the layer takes its share
};

PT_FN float alphaFromPerceptualRoughness(float perceptualRoughness) {
    float r = clamp(perceptualRoughness, kMinPerceptualRoughness, 1.0f);
    return r * r;
}

// glTF 2.0, appendix B.3.5: metals have no diffuse lobe.
PT_FN vec3 diffuseColorFromBaseColor(vec3 baseColor, float metallic) {
    return baseColor * (1.0f - metallic);
}

// Light that single-scatter GGX loses between its facets comes back, tinted by F0:
// 1 + F0 (1 - E) / E with E = scale + bias, the albedo for F0 = 1.
// Turquin 2019, "Practical multiple scattering compensation for microfacet models", equation 16.
// E is never below 0.3 (1 - ln 2 at alpha = 1, N·V = 1) for Smith; the floor guards an empty table.
// Where E exceeds 1 (see visibility()) it takes light away, from an F0 above 1 at most all.
PT_FN vec3 energyCompensationTurquin(vec3 f0, vec2 dfg) {
    float E = max(dfg.x + dfg.y, 1e-3f);
    return max(vec3(1.0f) + f0 * (1.0f / E - 1.0f), vec3(0.0f));
}

PT_FN vec3 energyCompensation(BrdfModel m, vec3 f0, vec2 dfg) {
    if (m.multiScatter == 0)
        return vec3(1.0f);
    return energyCompensationTurquin(f0, dfg);
}

// Directional albedo of the single-scatter specular lobe from the table (scale, bias) of its D and
// V. Schlick's is linear in (1 - V·H)⁵ and splits exactly: F0 scale + F90 bias (Karis 2013). The
// exact equations are taken at the one angle whose (1 - V·H)⁵ is the lobe's mean, bias / E: exact
// for a mirror, and elsewhere several times closer than their Schlick fit (docs/maths/brdf.md).
PT_FN vec3 singleScatterAlbedo(BrdfModel m, vec3 f0, float metallic, vec2 dfg) {
    if (m.fresnel == kFresnelDielectric || m.fresnel == kFresnelConductor) {
        float E = dfg.x + dfg.y;
        float cosine = 1.0f - pow(clamp(dfg.y / max(E, 1e-3f), 0.0f, 1.0f), 0.2f);
        return E * fresnel(m, f0, metallic, cosine);
    }
    if (m.fresnel == kFresnelSchlickF90)
        return f0 * dfg.x + vec3(m.f90 * dfg.y);
    return f0 * dfg.x + vec3(dfg.y);
}

// With compensation; without it, what a lobe returns in excess (see visibility()) is cut at 1.
PT_FN vec3 specularAlbedo(BrdfModel m, vec3 f0, float metallic, vec2 dfg) {
    return min(singleScatterAlbedo(m, f0, metallic, dfg) * energyCompensation(m, f0, dfg),
               vec3(1.0f));
}

// `dfg`: (scale, bias) of the model's DFG table at (N·V, perceptualRoughness).
PT_FN SurfaceTerms makeSurface(BrdfModel model, SurfaceInputs inputs, vec3 n, vec3 v, vec2 dfg) {
    SurfaceTerms s;
    s.model = modelOfIndex(model, inputs.ior);
    s.n = n;
    s.v = v;
    s.NoV = clamp(dot(n, v), kMinNoV, 1.0f);
    s.metallic = inputs.metallic;
    s.perceptualRoughness = clamp(inputs.perceptualRoughness, 0.0f, 1.0f);
    s.alpha = alphaFromPerceptualRoughness(inputs.perceptualRoughness);
    s.diffuseRoughness = clamp(inputs.diffuseRoughness, 0.0f, 1.0f);
    // KHR_materials_transmission: under the layer light goes into the diffuse body or through.
    vec3 body = diffuseColorFromBaseColor(inputs.baseColor, inputs.metallic);
    s.diffuseColor = body * (1.0f - inputs.transmission);
    s.clearColor = body * inputs.transmission;
    s.f0 = normalReflectance(s.model, inputs.baseColor, inputs.metallic);
    s.energyCompensation = energyCompensation(s.model, s.f0, dfg);
    s.specularAlbedo = specularAlbedo(s.model, s.f0, s.metallic, dfg);
    // Albedo scaling: what the specular layer reflects towards the viewer cannot enter the diffuse
    // one (Kulla & Conty 2017, slide 26; OpenPBR 1.1, section 3.7). A white dielectric in a white
    // furnace then returns exactly 1 at every angle and roughness.
    s.transmission = vec3(1.0f) - s.specularAlbedo;
    s.diffuseAlbedo = s.transmission * diffuseReflectance(model, s.diffuseColor,
                                                          s.perceptualRoughness,
                                                          s.diffuseRoughness, s.NoV);
    return s;
}

// The surface under a specular layer of which only `shown`, 0…1, is there: it takes that much less
// from the diffuse lobe, so that diffuse + shown * specular keeps its energy, and without a layer the
// diffuse lobe has all of its albedo.
PT_FN SurfaceTerms fadeSpecularLayer(SurfaceTerms surface, float shown) {
    SurfaceTerms s = surface;
    s.transmission = vec3(1.0f) - shown * s.specularAlbedo;
    s.diffuseAlbedo = s.transmission * diffuseReflectance(s.model, s.diffuseColor,
                                                          s.perceptualRoughness,
                                                          s.diffuseRoughness, s.NoV);
    return s;
}

// ---- Lobes -------------------------------------------------------------------------------------

// Cook & Torrance 1982: D V F, and the light scattered more than once. For NoL > 0.
PT_FN vec3 specularLobe(SurfaceTerms s, float NoH, float sin2, float NoL, float VoH) {
    float D = distribution(s.model, NoH, sin2, s.alpha);
    float V = visibility(s.model, s.NoV, NoL, VoH, s.alpha);
    return fresnel(s.model, s.f0, s.metallic, VoH) * s.energyCompensation * (D * V);
}

PT_FN vec3 diffuseLobe(SurfaceTerms s, float NoL, float VoH) {
    return s.transmission * diffuse(s.model, s.diffuseColor, s.perceptualRoughness,
                                    s.diffuseRoughness, s.NoV, NoL, VoH);
}

// ---- Shading -----------------------------------------------------------------------------------

// Reflected radiance of one source of light, by lobe.
struct ShadedLight {
    vec3 diffuse;
    vec3 specular;
};

// `l`: unit vector to the light; `irradiance`: of a surface that faces the light. Directional
// light: its intensity E; point light of intensity I (W/sr) at distance d: I / d².
//
// Nothing is left early: software OpenGL computes both sides of a branch, and shares nothing between
// those of several lights.
PT_FN ShadedLight shadeDirect(SurfaceTerms s, vec3 l, vec3 irradiance) {
    float NoL = clamp(dot(s.n, l), 0.0f, 1.0f);
    vec3 h = s.v + l;
    float length2 = dot(h, h);
    // v = -l: no half vector, a surface between viewer and light reflects none
    bool opposite = length2 < 1e-12f;
    h = h * inversesqrt(max(length2, 1e-12f));
    vec3 nxh = cross(s.n, h);
    float NoH = clamp(dot(s.n, h), 0.0f, 1.0f);
    float VoH = opposite ? 0.0f : clamp(dot(s.v, h), 0.0f, 1.0f);
    vec3 arriving = irradiance * NoL;
    vec3 diffuse = diffuseLobe(s, NoL, VoH) * arriving;
    vec3 specular = specularLobe(s, NoH, min(dot(nxh, nxh), 1.0f), NoL, VoH) * arriving;
    // Chosen, not multiplied by 0: a lobe may have no value there, an irradiance be infinite.
    ShadedLight result;
    result.diffuse = NoL > 0.0f ? diffuse : vec3(0.0f);
    result.specular = NoL > 0.0f && !opposite ? specular : vec3(0.0f);
    return result;
}

#endif
