// Exposure and tone curves: from scene-linear to display-linear light. The sRGB curve comes after.
#ifndef PT_TONEMAP_GLSL
#define PT_TONEMAP_GLSL

#include "color.glsl"

// Which curve: the values of patina::ToneMap.
PT_CONST int kToneMapClamp = 0;
PT_CONST int kToneMapReinhard = 1;

// One EV is one photographic stop: a factor of two.
PT_FN vec3 applyExposure(vec3 c, float exposureEv) {
    return c * exp2(exposureEv);
}

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
    vec3 positive = max(c, vec3(0.0f));
    return min(positive / (1.0f + luminance(positive)), vec3(1.0f));
}

// Dispatch.
PT_FN vec3 toneMap(vec3 c, int curve) {
    if (curve == kToneMapReinhard)
        return toneMapReinhard(c);
    return toneMapClamp(c);
}

#endif
