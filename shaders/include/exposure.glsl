// How bright the picture is shown: exposure set by hand, or for the luminance that the eye is used
// to. The C++ side is render/pass/AdaptationPass.h.
#ifndef PT_EXPOSURE_GLSL
#define PT_EXPOSURE_GLSL

#include "../shared/tonemap.glsl"

// What luminance.comp and adapt.comp found out. Meaningless while nothing asks for it.
layout(std140, binding = 5) uniform Adaptation {
    float u_logAverage; // log-average luminance of the picture
    float u_adapted;    // the one that the eye is used to, on its way to u_logAverage
    float u_darkest;    // luminances of the darkest and the brightest pixel, plus kLogDelta
    float u_brightest;
};

uniform float u_exposureEv;
uniform int u_automatic; // exposure by u_adapted; u_exposureEv corrects it

vec3 expose(vec3 radiance) {
    float scale = u_automatic != 0 ? automaticExposure(u_adapted) : 1.0;
    return applyExposure(radiance * scale, u_exposureEv);
}

#endif
