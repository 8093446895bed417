#version 450 core
// Scene-linear radiance to display values: exposure, tone curve, the display's transfer function.
// TONE_MAP is one of kToneMap…: software renderers execute both sides of a branch, so that each
// curve is a program of its own. OPEN_COLOR_IO: what OpenColorIO makes of a configuration instead.
#include "include/exposure.glsl"
#include "include/side.glsl"

layout(binding = 0) uniform sampler2D u_radiance; // premultiplied
uniform int u_autoKey; // photographic: the key follows from the picture
uniform float u_reinhardKey, u_reinhardWhite;
uniform int u_reinhardPerChannel;
uniform float u_exponentialK;
uniform int u_transfer;
uniform float u_gamma;
uniform float u_ditherAmplitude; // of one step of the display's values
uniform float u_empty; // display value of what has no surface; negative: it stays transparent
uniform int u_markClipped; // marks instead of the picture

layout(location = 0) out vec4 o_color; // straight alpha

#ifdef OPEN_COLOR_IO
vec4 ocioDisplay(vec4 pixel); // OpenColorIO's text follows below

vec3 displayed(vec3 exposed) {
    vec3 c = ocioDisplay(vec4(finiteRadiance(exposed), 1.0)).rgb;
    return min(finiteRadiance(c), vec3(1.0)); // encoded already
}
#else
vec3 displayed(vec3 exposed) {
    ToneCurve t;
    t.curve = TONE_MAP;
    t.scale = 1.0;
    t.white = u_reinhardWhite;
    t.k = u_exponentialK;
    t.perChannel = u_reinhardPerChannel;
    if (TONE_MAP == kToneMapReinhardPhotographic) {
        float key =
            u_autoKey != 0 ? reinhardAutoKey(u_adapted, u_darkest, u_brightest) : u_reinhardKey;
        t.scale = key / u_adapted;
    }
    return displayEncode(toneMap(exposed, t), u_transfer, u_gamma);
}
#endif

// Jimenez 2014, "Next Generation Post Processing in Call of Duty: Advanced Warfare": noise whose
// values are spread evenly over every small neighbourhood. -0.5 … 0.5.
float interleavedGradientNoise(vec2 pixel) {
    return fract(52.9829189 * fract(dot(pixel, vec2(0.06711056, 0.00583715)))) - 0.5;
}

// What the display cannot show: all channels at their end white, one of them red, black blue.
vec3 marked(vec3 shown) {
    const float kStep = 1.0 / 255.0;
    float most = max(shown.r, max(shown.g, shown.b));
    float least = min(shown.r, min(shown.g, shown.b));
    if (least >= 1.0 - 0.5 * kStep)
        return vec3(1.0);
    if (most >= 1.0 - 0.5 * kStep)
        return vec3(1.0, 0.15, 0.1);
    if (most < 0.5 * kStep)
        return vec3(0.1, 0.25, 1.0);
    return vec3(0.1 + 0.4 * dot(shown, vec3(0.2126, 0.7152, 0.0722)));
}

void main() {
    keepToSide(gl_FragCoord.xy);
    vec4 c = texelFetch(u_radiance, ivec2(gl_FragCoord.xy), 0);
    vec3 radiance = c.a > 0.0 ? c.rgb / c.a : vec3(0.0);
    vec3 shown = displayed(expose(radiance));
    // Half a step at most: what lies exactly on a step stays there, so black stays black. Rounded
    // here, since graphics cards may round by up to .1 of a step elsewhere than in the middle.
    if (u_ditherAmplitude > 0.0) {
        float noise = u_ditherAmplitude * interleavedGradientNoise(gl_FragCoord.xy);
        shown = floor(255.0 * shown + noise + 0.5) / 255.0;
    }
    if (u_markClipped != 0)
        shown = marked(shown);
    o_color = u_empty < 0.0 ? vec4(shown, c.a) : vec4(mix(vec3(u_empty), shown, c.a), 1.0);
}
