#version 450 core
// Adds up the tiles of luminance.comp and lets the eye get used to what it sees.
#include "include/luminance.glsl"
#include "shared/tonemap.glsl"

layout(std430, binding = 0) readonly buffer Tiles { LuminanceSum b_tiles[]; };
layout(std430, binding = 1) buffer Adaptation { // as in include/exposure.glsl
    float b_logAverage;
    float b_adapted; // 0: the eye has seen nothing yet
    float b_darkest;
    float b_brightest;
};
uniform int u_tileCount;
uniform int u_wholeFrame; // all pixels count, not the model's alone
uniform float u_seconds; // since the last frame; negative: the eye has had all the time it needs

void main() {
    LuminanceSum model = noPixels();
    LuminanceSum all = noPixels();
    for (int i = int(gl_LocalInvocationIndex); i < u_tileCount; i += 256) {
        model = add(model, b_tiles[2 * i]);
        all = add(all, b_tiles[2 * i + 1]);
    }
    model = addGroup(model);
    all = addGroup(all);
    if (gl_LocalInvocationIndex != 0u)
        return;
    // A dark room around the model burns nothing out. Where there is no model, or only glass, the
    // whole picture counts.
    LuminanceSum sum = model.weight > 0.0 && u_wholeFrame == 0 ? model : all;
    // A picture without a pixel in it changes nothing.
    float logAverage = b_adapted > 0.0 ? b_logAverage : kMiddleGrey;
    if (sum.weight > 0.0) {
        logAverage = exp2(sum.weightedLog / sum.weight);
        b_darkest = exp2(sum.darkest);
        b_brightest = exp2(sum.brightest);
    }
    b_logAverage = logAverage;
    float adapted = u_seconds < 0.0 || !(b_adapted > 0.0)
                        ? logAverage
                        : adaptLuminance(b_adapted, logAverage, u_seconds);
    // The formula never arrives; 1/512 of a stop is nothing that anybody sees.
    b_adapted = abs(log2(adapted / logAverage)) < 1.0 / 512.0 ? logAverage : adapted;
}
