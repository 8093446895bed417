// Colour: the sRGB curve and luminance. All shading happens in linear Rec.709.
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

#endif
