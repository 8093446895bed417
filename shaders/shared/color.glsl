// Colour: the sRGB curve, luminance, colours for names. All shading happens in linear Rec.709.
#ifndef PT_COLOR_GLSL
#define PT_COLOR_GLSL

#include "macros.glsl"

// Linear to encoded, IEC 61966-2-1:1999. The input is clamped to 0…1, what a display can show.
PT_FN float srgbEncode(float linearValue) {
    float x = clamp(linearValue, 0.0f, 1.0f);
    if (x <= 0.0031308f)
        return 12.92f * x;
    return 1.055f * pow(x, 1.0f / 2.4f) - 0.055f;
}

// Encoded to linear, IEC 61966-2-1:1999.
PT_FN float srgbDecode(float encoded) {
    float x = max(encoded, 0.0f);
    if (x <= 0.04045f)
        return x / 12.92f;
    return pow((x + 0.055f) / 1.055f, 2.4f);
}

PT_FN vec3 srgbEncode(vec3 c) {
    return vec3(srgbEncode(c.x), srgbEncode(c.y), srgbEncode(c.z));
}

PT_FN vec3 srgbDecode(vec3 c) {
    return vec3(srgbDecode(c.x), srgbDecode(c.y), srgbDecode(c.z));
}

// Relative luminance of linear Rec.709, ITU-R BT.709-6, item 3.2.
PT_FN float luminance(vec3 c) {
    return dot(c, vec3(0.2126f, 0.7152f, 0.0722f));
}

// A display colour for each whole number, far apart for neighbours: hue by the golden ratio, even
// and odd numbers in two steps of lightness.
PT_FN vec3 identityColor(float id) {
    vec3 hue = fract(vec3(id * 0.61803399f) + vec3(0.0f, 0.6666667f, 0.3333333f));
    vec3 color = clamp(abs(hue * 6.0f - vec3(3.0f)) - vec3(1.0f), vec3(0.0f), vec3(1.0f));
    float odd = id - 2.0f * floor(0.5f * id);
    return mix(vec3(0.5f), color, 0.55f) * (odd < 0.5f ? 0.95f : 0.7f);
}

#endif
