// Exposure and tone curves: from scene-linear light to display-linear light in 0…1, and the
// display's own curve, which comes last and only once. docs/maths/tone-mapping.md has the whole.
#ifndef PT_TONEMAP_GLSL
#define PT_TONEMAP_GLSL

#include "color.glsl"

// Which curve: the values of patina::ToneMap. OpenColorIO's displays are no formula of ours.
PT_CONST int kToneMapClamp = 0;
PT_CONST int kToneMapReinhard = 1;
PT_CONST int kToneMapReinhardPhotographic = 2;
PT_CONST int kToneMapExponential = 3;
PT_CONST int kToneMapPbrNeutral = 4;
PT_CONST int kToneMapAces = 5;
PT_CONST int kToneMapAgX = 6;
PT_CONST int kToneMapOpenColorIo = 7;

// Which transfer function the display has: the values of patina::DisplayTransfer.
PT_CONST int kDisplaySrgb = 0;
PT_CONST int kDisplayGamma = 1;

PT_CONST float kMiddleGrey = 0.18f;
// Reinhard et al. 2002, section 3: the key of a dark and of a bright picture.
PT_CONST float kReinhardKeyMin = 0.045f;
PT_CONST float kReinhardKeyMax = 0.72f;
// Same section, delta: keeps the logarithm of black finite.
PT_CONST float kLogDelta = 1e-4f;
// All curves have long been white here, and its square is still a float.
PT_CONST float kMaxRadiance = 1e9f;

struct ToneCurve {
    int curve;   // kToneMap…
    float scale; // photographic: key / log-average luminance
    float white; // photographic: smallest scaled luminance that becomes white; 0: none
    float k;     // exponential
    int perChannel; // Reinhard's: 1: on each channel, 0: on luminance
};

// --- Light of any kind made fit for the curves ---

// NaN and what is below black become black, infinity becomes kMaxRadiance.
PT_FN float finiteRadiance(float x) {
    return x > 0.0f ? min(x, kMaxRadiance) : 0.0f;
}

PT_FN vec3 finiteRadiance(vec3 c) {
    return vec3(finiteRadiance(c.x), finiteRadiance(c.y), finiteRadiance(c.z));
}

// --- Exposure and adaptation ---

// One EV is one photographic stop: a factor of two.
PT_FN vec3 applyExposure(vec3 c, float exposureEv) {
    return c * exp2(exposureEv);
}

// Reinhard et al. 2002, equation 1, for one pixel: the log-average luminance is exp2 of the mean of
// these. The paper prints 1/N outside of the exponential, which cannot be meant: the average of
// equal pixels would not be their luminance.
PT_FN float logLuminance(vec3 c) {
    return log2(kLogDelta + luminance(finiteRadiance(c)));
}

// The factor that brings a picture of this log-average luminance to middle grey.
PT_FN float automaticExposure(float logAverage) {
    return kMiddleGrey / max(logAverage, kLogDelta);
}

// How far the eye has come after so many seconds: 2 % of the way every 1/60 s. A power of the time,
// so that two half steps are one whole step, whatever the frame rate.
PT_FN float adaptationWeight(float seconds) {
    return 1.0f - pow(0.98f, 60.0f * seconds);
}

// Luminance the eye is used to, `seconds` after it was `adapted` and began to look at `measured`.
// Written as a blend of both, because L + (Lnew - L) loses a small Lnew beside a large L.
PT_FN float adaptLuminance(float adapted, float measured, float seconds) {
    float w = adaptationWeight(seconds);
    return adapted * (1.0f - w) + measured * w;
}

// Reinhard 2002, "Parameter estimation for photographic tone reproduction" (JGT 7(1)), equation 4:
// the key from where the log-average lies between the darkest and the brightest luminance.
PT_FN float reinhardAutoKey(float logAverage, float darkest, float brightest) {
    float low = log2(darkest);
    float range = log2(brightest) - low;
    if (!(range > 1e-3f)) // one luminance all over says nothing about the scene
        return kMiddleGrey;
    float f = (2.0f * (log2(logAverage) - low) - range) / range;
    return clamp(kMiddleGrey * exp2(2.0f * f), kReinhardKeyMin, kReinhardKeyMax);
}

// --- Curves: each takes radiance that is finite and not negative ---

// What a display does by itself: each channel cut at 0 and 1.
PT_FN vec3 toneMapClamp(vec3 c) {
    return clamp(c, vec3(0.0f), vec3(1.0f));
}

// Reinhard, Stark, Shirley & Ferwerda 2002, equation 3: L / (1 + L).
PT_FN float reinhard(float L) {
    return L / (1.0f + L);
}

// Same paper, equation 4: luminance Lwhite and above becomes 1.
PT_FN float reinhardExtended(float L, float Lwhite) {
    return L * (1.0f + L / (Lwhite * Lwhite)) / (1.0f + L);
}

// Equation 3 on luminance; the colour is scaled, so hue and saturation stay. A saturated channel
// may exceed 1 although its luminance does not, and is cut there.
PT_FN vec3 toneMapReinhard(vec3 c) {
    return min(c / (1.0f + luminance(c)), vec3(1.0f));
}

// Equation 3 on each channel: nothing is cut, bright colours fade to white, and hues shift on the way.
PT_FN vec3 toneMapReinhardChannels(vec3 c) {
    return c / (1.0f + c);
}

// The whole operator: luminance scaled so that the log-average falls on the key (equation 2), then
// equation 3, or 4 where there is a white point.
PT_FN vec3 toneMapReinhardPhotographic(vec3 c, float scale, float white) {
    float L = scale * luminance(c);
    float perL = 1.0f / (1.0f + L); // displayed luminance over L
    if (white > 0.0f)
        perL = L < white ? perL * (1.0f + L / (white * white)) : 1.0f / L;
    return min(c * (scale * perL), vec3(1.0f));
}

// The same on each channel in place of luminance; the log-average stays that of luminance.
PT_FN vec3 toneMapReinhardPhotographicChannels(vec3 c, float scale, float white) {
    vec3 x = scale * c;
    if (!(white > 0.0f))
        return toneMapReinhardChannels(x);
    return min(x * (1.0f + x / (white * white)) / (1.0f + x), vec3(1.0f));
}

// Film in a camera, as an exposure: 1 - e^(-k L), per channel.
PT_FN vec3 toneMapExponential(vec3 c, float k) {
    return 1.0f - exp(-k * c);
}

// Khronos PBR Neutral (Khronos Group 2024, "PBR Neutral Tone Mapper", specification): base colours
// of 0.08 … 0.8 under white light come out as they are, less the 4 % of a dielectric's reflection.
PT_CONST float kNeutralF90 = 0.04f;
PT_CONST float kNeutralStart = 0.76f; // 0.8 less the reflection: where compression begins

// The Fresnel reflection that is taken away, less of it near black. `x`: the smallest channel.
PT_FN float pbrNeutralReflection(float x) {
    return x < 2.0f * kNeutralF90 ? x - x * x / (4.0f * kNeutralF90) : kNeutralF90;
}

// What the largest channel becomes, for peak >= kNeutralStart: towards 1.
PT_FN float pbrNeutralPeak(float peak) {
    float d = 1.0f - kNeutralStart;
    return 1.0f - d * d / (peak + d - kNeutralStart);
}

PT_FN vec3 toneMapPbrNeutral(vec3 c) {
    vec3 body = c - vec3(pbrNeutralReflection(min(c.x, min(c.y, c.z))));
    float peak = max(body.x, max(body.y, body.z));
    if (peak < kNeutralStart)
        return body;

    // Compress the peak and let its colour fade to white.
    float desaturation = 0.15f;
    float compressed = pbrNeutralPeak(peak);
    float g = 1.0f / (desaturation * (peak - compressed) + 1.0f);
    return mix(vec3(compressed), body * (compressed / peak), g);
}

// ACES: Stephen Hill's fit of the reference rendering transform and the sRGB output transform of
// ACES 1 (in M. Pettineo & S. Hill, "BakingLab", 2016). The matrices go from linear Rec.709 to
// ACEScg with the RRT's desaturation, and back with the ODT's.
PT_FN vec3 acesInput(vec3 c) {
    return vec3(0.59719f * c.x + 0.35458f * c.y + 0.04823f * c.z,
                0.07600f * c.x + 0.90834f * c.y + 0.01566f * c.z,
                0.02840f * c.x + 0.13383f * c.y + 0.83777f * c.z);
}

PT_FN vec3 acesCurve(vec3 v) {
    vec3 a = v * (v + 0.0245786f) - 0.000090537f;
    vec3 b = v * (0.983729f * v + 0.4329510f) + 0.238081f;
    return a / b;
}

PT_FN vec3 acesOutput(vec3 v) {
    return vec3(1.60475f * v.x - 0.53108f * v.y - 0.07367f * v.z,
                -0.10208f * v.x + 1.10813f * v.y - 0.00605f * v.z,
                -0.00327f * v.x - 0.07276f * v.y + 1.07602f * v.z);
}

PT_FN vec3 toneMapAces(vec3 c) {
    return clamp(acesOutput(acesCurve(acesInput(c))), vec3(0.0f), vec3(1.0f));
}

// The scale that lets slope * x / (1 + (slope * x / scale)^power)^(1 / power) reach y at x: solved
// for the scale.
PT_FN float agxScale(float x, float y, float slope, float power) {
    return slope * x / pow(pow(slope * x / y, power) - 1.0f, 1.0f / power);
}

// Troy Sobotka's AgX curve (AgX, 2022): an S through (0, 0), the pivot and (1, 1), straight with
// slope 2 at the pivot, where middle grey lies, with a toe of power 3 and a shoulder of 3.25.
PT_FN float agxCurve(float x) {
    float pivotX = 10.0f / 16.5f; // middle grey: 10 of 16.5 stops
    float pivotY = 0.5f;
    float slope = 2.0f;
    bool toe = x < pivotX;
    float power = toe ? 3.0f : 3.25f;
    float scale = toe ? agxScale(pivotX, pivotY, slope, power)
                      : agxScale(1.0f - pivotX, 1.0f - pivotY, slope, power);
    float t = slope * abs(x - pivotX);
    float rise = t / pow(1.0f + pow(t / scale, power), 1.0f / power);
    return toe ? pivotY - rise : pivotY + rise;
}

// AgX: primaries drawn together, 16.5 stops around middle grey as logarithm, the curve per channel,
// primaries drawn apart again. Matrices: B. Wrensch 2023, "Minimal AgX Implementation", for linear
// Rec.709. The curve makes values for a display of pure gamma 2.2, which is undone here.
PT_FN vec3 agxInset(vec3 c) {
    return vec3(0.8424790623f * c.x + 0.0784335999f * c.y + 0.0792237451f * c.z,
                0.0423282422f * c.x + 0.8784686365f * c.y + 0.0791661275f * c.z,
                0.0423756549f * c.x + 0.0784336000f * c.y + 0.8791429738f * c.z);
}

// 0…1 over the 16.5 stops from 10 below middle grey.
PT_FN vec3 agxStops(vec3 v) {
    float darkest = log2(kMiddleGrey) - 10.0f;
    return clamp((log2(max(v, vec3(1e-10f))) - darkest) / 16.5f, vec3(0.0f), vec3(1.0f));
}

PT_FN vec3 agxOutset(vec3 s) {
    return vec3(1.1968790051f * s.x - 0.0980208811f * s.y - 0.0990297441f * s.z,
                -0.0528968518f * s.x + 1.1519031299f * s.y - 0.0989611768f * s.z,
                -0.0529716355f * s.x - 0.0980434501f * s.y + 1.1510736726f * s.z);
}

PT_FN vec3 toneMapAgX(vec3 c) {
    vec3 stops = agxStops(agxInset(c));
    vec3 shown = agxOutset(vec3(agxCurve(stops.x), agxCurve(stops.y), agxCurve(stops.z)));
    return pow(clamp(shown, vec3(0.0f), vec3(1.0f)), vec3(2.2f));
}

// Dispatch: exposed radiance of any kind, NaN and infinity included, to 0…1.
PT_FN vec3 toneMap(vec3 radiance, ToneCurve t) {
    vec3 c = finiteRadiance(radiance);
    if (t.curve == kToneMapReinhard)
        return t.perChannel != 0 ? toneMapReinhardChannels(c) : toneMapReinhard(c);
    if (t.curve == kToneMapReinhardPhotographic)
        return t.perChannel != 0 ? toneMapReinhardPhotographicChannels(c, t.scale, t.white)
                                 : toneMapReinhardPhotographic(c, t.scale, t.white);
    if (t.curve == kToneMapExponential)
        return toneMapExponential(c, t.k);
    if (t.curve == kToneMapPbrNeutral)
        return toneMapPbrNeutral(c);
    if (t.curve == kToneMapAces)
        return toneMapAces(c);
    if (t.curve == kToneMapAgX)
        return toneMapAgX(c);
    return toneMapClamp(c);
}

// --- The display ---

// What a display wants to be sent for linear light 0…1: the sRGB curve, or a pure power.
PT_FN vec3 displayEncode(vec3 c, int transfer, float gamma) {
    if (transfer == kDisplayGamma)
        return pow(clamp(c, vec3(0.0f), vec3(1.0f)), vec3(1.0f / gamma));
    return srgbEncode(c);
}

#endif
