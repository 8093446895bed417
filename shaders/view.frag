#version 450 core
// The numbers of a view to display values: through a colour map, as a colour, direction or identity,
// or as a judgement of the picture's radiance. The C++ side is render/pass/ViewPass.h.
#include "include/exposure.glsl"
#include "include/side.glsl"
#include "generated/views.glsl"

layout(binding = 0) uniform sampler2D u_values; // premultiplied where they are radiance
layout(binding = 1) uniform sampler2D u_colors; // rows: ColorMap
uniform int u_kind;  // kView…
// ViewValue: 1 colour, 2 scalar, 3 direction, 4 identity, 5 picture; -1: the view does not apply, and
// u_values hold N·V
uniform int u_value;
uniform vec2 u_range;
uniform int u_logarithmic;
uniform int u_colorMap;
uniform float u_marks; // 0…1: strength of the marks, so that they can blink
uniform int u_transfer;
uniform float u_gamma;
uniform vec3 u_empty; // where nothing is, display values

layout(location = 0) out vec4 o_color;

vec3 mapped(float t) {
    int last = textureSize(u_colors, 0).x - 1;
    float at = clamp(t, 0.0, 1.0) * float(last);
    int first = min(int(at), last - 1);
    return mix(texelFetch(u_colors, ivec2(first, u_colorMap), 0).rgb,
               texelFetch(u_colors, ivec2(first + 1, u_colorMap), 0).rgb, at - float(first));
}

float placed(float x) {
    if (u_logarithmic != 0)
        return log2(max(x, 1e-30) / u_range.x) / log2(u_range.y / u_range.x);
    return (x - u_range.x) / (u_range.y - u_range.x);
}

vec3 judged(vec3 radiance) {
    float grey = 0.35 * srgbEncode(expose(max(radiance, vec3(0.0)))).g;
    if (u_kind == kViewLuminance) {
        float ev = log2(max(luminance(expose(radiance)), 1e-30) / kMiddleGrey);
        return mapped(placed(ev));
    }
    vec3 mark = vec3(grey);
    if (u_kind == kViewInvalid) {
        bvec3 nan = isnan(radiance);
        bvec3 inf = isinf(radiance);
        if (any(nan))
            mark = vec3(1.0, 0.0, 1.0);
        else if (any(inf))
            mark = vec3(1.0, 0.9, 0.0);
        else if (any(lessThan(radiance, vec3(0.0))))
            mark = vec3(0.0, 0.9, 0.9);
        else
            return vec3(grey);
        return mix(vec3(0.1), mark, u_marks);
    }
    if (any(lessThan(radiance, vec3(-1e-6)))) // out of gamut
        return vec3(1.0, 0.2, 0.8);
    return vec3(grey);
}

void main() {
    keepToSide(gl_FragCoord.xy);
    vec4 c = texelFetch(u_values, ivec2(gl_FragCoord.xy), 0);
    vec3 shown;
    if (u_value < 0) {
        // Stripes: nobody takes them for numbers.
        float stripe = fract((gl_FragCoord.x + gl_FragCoord.y) / 16.0) < 0.5 ? 0.20 : 0.26;
        shown = vec3(stripe * (0.4 + 0.6 * c.r));
    } else if (u_value == 1)
        shown = displayEncode(c.rgb / u_range.y, u_transfer, u_gamma);
    else if (u_value == 2)
        shown = mapped(placed(c.r));
    else if (u_value == 3)
        shown = 0.5 + 0.5 * c.rgb;
    else if (u_value == 4)
        shown = identityColor(c.r);
    else
        shown = judged(c.a > 0.0 ? c.rgb / c.a : c.rgb);
    o_color = vec4(c.a > 0.0 || u_value == 5 ? shown : u_empty, 1.0);
}
