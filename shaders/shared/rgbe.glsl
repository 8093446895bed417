// RGBE: three 8-bit mantissas that share an exponent. G. Ward 1991, "Real Pixels", Graphics Gems
// II, p. 80; the numbers are those of Radiance's color.c and B. Walter's rgbe.c.
#ifndef PT_RGBE_GLSL
#define PT_RGBE_GLSL

#include "macros.glsl"

// The largest number the format holds, 255 · 2^119, and the one that is already black.
PT_CONST float kRgbeMax = 1.6947656946e38f;
PT_CONST float kRgbeBlack = 1e-32f;

// What the format can say about a component: NaN and negative numbers are 0 (the comparison is
// false for NaN). Infinity and whatever exceeds the largest number become that: an exponent of
// 2^127 or more would wrap around in its byte.
PT_FN float rgbeClamp(float component) {
    return component > 0.0f ? min(component, kRgbeMax) : 0.0f;
}

// Linear RGB to the four bytes as numbers 0…255: red, green, blue, exponent. Mantissas are
// truncated: the largest component loses up to 1/128 of itself, others that much of the largest.
PT_FN vec4 rgbeEncode(vec3 color) {
    vec3 c = vec3(rgbeClamp(color.x), rgbeClamp(color.y), rgbeClamp(color.z));
    float largest = max(c.x, max(c.y, c.z));
    if (largest <= kRgbeBlack)
        return vec4(0.0f, 0.0f, 0.0f, 0.0f);
    int exponent = 0;
    frexp(largest, exponent); // largest = f · 2^exponent with 0.5 <= f < 1
    // Scaling by a power of two is exact, so that the bytes are, too.
    int shift = 8 - exponent;
    return vec4(floor(ldexp(c.x, shift)), floor(ldexp(c.y, shift)), floor(ldexp(c.z, shift)),
                float(exponent + 128));
}

// The inverse: mantissa · 2^(exponent - 136). Radiance itself adds half a step to each mantissa,
// which halves the mean error but turns black components grey and 1 into 1.004; every other reader
// does without, and so do we: what is written comes back.
PT_FN vec3 rgbeDecode(vec4 bytes) {
    if (bytes.w <= 0.0f)
        return vec3(0.0f, 0.0f, 0.0f);
    int shift = int(bytes.w) - 136;
    return vec3(ldexp(bytes.x, shift), ldexp(bytes.y, shift), ldexp(bytes.z, shift));
}

#endif
