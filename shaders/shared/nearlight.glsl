// What a point sees of lights that stand near it, as spherical harmonics: to be multiplied with its
// radiance transfer. core/math/ZonalHarmonics.h and PolygonHarmonics.h have the same in double
// precision. `order` counts bands, 1…8; only the first order² numbers are written.
#ifndef PT_NEARLIGHT_GLSL
#define PT_NEARLIGHT_GLSL

#include "constants.glsl"
#include "sh.glsl"

// Loops have constant ends where `order` is one: drivers that unroll them keep harmonics in registers.

// Each band of 64 harmonics times its factor.
PT_FN void scaleBands(int order, PT_ARRAY(float, factor, 8), PT_INOUT_ARRAY(float, y, 64)) {
    y[0] = y[0] * factor[0];
    if (order > 1)
        for (int i = 1; i < 4; ++i)
            y[i] = y[i] * factor[1];
    if (order > 2)
        for (int i = 4; i < 9; ++i)
            y[i] = y[i] * factor[2];
    if (order > 3)
        for (int i = 9; i < 16; ++i)
            y[i] = y[i] * factor[3];
    if (order > 4)
        for (int i = 16; i < 25; ++i)
            y[i] = y[i] * factor[4];
    if (order > 5)
        for (int i = 25; i < 36; ++i)
            y[i] = y[i] * factor[5];
    if (order > 6)
        for (int i = 36; i < 49; ++i)
            y[i] = y[i] * factor[6];
    if (order > 7)
        for (int i = 49; i < 64; ++i)
            y[i] = y[i] * factor[7];
}

// ---- Discs and spheres ------------------------------------------------------------------------

// ∫_cos^1 P_l dz, l = 0…7, of a cap with this cosine of its half angle, in units of sin²: (1 - cos)
// / sin² and P_l'(cos) / (l (l + 1)), by Legendre's equation. They keep their digits for the
// smallest of caps; for those that fill more than half of all directions the first one grows.
PT_FN void capBands(float cosine, PT_OUT_ARRAY(float, bands, 8)) {
    float p = cosine;
    float previousP = 1.0f;
    float slope = 1.0f;
    float previousSlope = 0.0f;
    bands[0] = 1.0f / max(1.0f + cosine, 1e-6f);
    for (int l = 1; l < 8; ++l) {
        float n = float(l);
        bands[l] = slope / (n * (n + 1.0f));
        float nextP = ((2.0f * n + 1.0f) * cosine * p - n * previousP) / (n + 1.0f);
        float nextSlope = previousSlope + (2.0f * n + 1.0f) * p;
        previousP = p;
        p = nextP;
        previousSlope = slope;
        slope = nextSlope;
    }
}

// What a cap of light is to be multiplied by so that a surface facing it gets its irradiance in
// spite of the bands that are left out and of the window: for the smallest of caps
// directionalScale() of core/math/ZonalHarmonics.h.
PT_FN float capScale(float cosine, int order, PT_ARRAY(float, window, 8)) {
    float bands[8];
    capBands(cosine, bands);
    float irradiance = 0.0f; // in units of sin²
    for (int l = 0; l < order; ++l)
        irradiance =
            irradiance + shCosineFactor(l) * window[l] * (float(l) + 0.5f) * bands[l];
    // More than half of all directions: everything above the horizon is light.
    float whole = cosine > 0.0f ? kPi : kPi / max(1.0f - cosine * cosine, 1e-6f);
    return whole / irradiance;
}

// A point of light in direction `d` (unit), of irradiance 1 on a surface that faces it.
PT_FN void nearPointSh(vec3 d, int order, PT_ARRAY(float, window, 8), PT_OUT_ARRAY(float, y, 64)) {
    shBasis64(d, y);
    float scale = capScale(1.0f, order, window);
    float factor[8];
    for (int l = 0; l < 8; ++l)
        factor[l] = scale * window[l];
    scaleBands(order, factor, y);
}

// A sphere of radiance 1, `toCenter` from its centre away; inside of it light comes from everywhere.
PT_FN void nearSphereSh(vec3 toCenter, float radius, int order, PT_ARRAY(float, window, 8),
                        PT_OUT_ARRAY(float, y, 64)) {
    float distance2 = max(dot(toCenter, toCenter), 1e-12f);
    float sin2 = radius * radius / distance2;
    bool inside = sin2 >= 1.0f;
    float cosine = sqrt(max(1.0f - sin2, 0.0f));
    float bands[8];
    capBands(cosine, bands);
    float scale = kTwoPi * sin2 * capScale(cosine, order, window);
    float factor[8];
    for (int l = 0; l < 8; ++l)
        factor[l] = inside ? (l == 0 ? 2.0f * kTwoPi : 0.0f) : scale * window[l] * bands[l];
    shBasis64(toCenter * inversesqrt(distance2), y);
    scaleBands(order, factor, y);
}

// ---- Rectangles -----------------------------------------------------------------------------------

// Solid angle of a triangle, positive where its corners run clockwise as seen from the origin. Van
// Oosterom & Strackee 1983, "The Solid Angle of a Plane Triangle". Unit vectors.
PT_FN float triangleSolidAngle(vec3 a, vec3 b, vec3 c) {
    float volume = dot(a, cross(b - a, c - a));
    float divisor = 1.0f + dot(a, b) + dot(b, c) + dot(c, a);
    return volume == 0.0f ? 0.0f : 2.0f * atan(volume, divisor);
}

// Band l of the slope across a meridian whose azimuth has these cosines and sines of its multiples.
PT_FN void addMeridianBand(int l, PT_ARRAY(float, a, 8), PT_ARRAY(float, c, 8),
                           PT_ARRAY(float, s, 8), PT_INOUT_ARRAY(float, y, 64)) {
    int center = l * (l + 1);
    for (int m = 1; m <= l; ++m) {
        y[center + m] = y[center + m] + a[m] * s[m];
        y[center - m] = y[center - m] - a[m] * c[m];
    }
}

// The share of an edge in the harmonics about an axis that it runs along: its place in the plane
// across (x, y), where it begins along the axis (z), and its length. Δ Y_lm = -l (l + 1) Y_lm, so by
// Gauss' theorem on the sphere the slope across the border is left; such an edge lies on a meridian,
// where that is ∂/∂φ: of m √2 K_lm / (l (l + 1)) ∫ P_lm(sin s) / cos s ds the integrand is a
// trigonometric polynomial of the latitude s. docs/maths/spherical-harmonics.md.
PT_FN void addMeridianSh(vec2 across, float begin, float size, float sign, int order,
                         PT_INOUT_ARRAY(float, y, 64)) {
    float rho2 = dot(across, across);
    float end = begin + size;
    // Else we look along the edge.
    if (rho2 > 1e-14f * max(begin * begin, end * end)) {
        float invRho = inversesqrt(rho2);
        float rho = rho2 * invRho;
        float invBegin = inversesqrt(rho2 + begin * begin);
        float invEnd = inversesqrt(rho2 + end * end);
        // Of the whole angle; from the length, so that short edges keep their digits.
        float sinWhole = rho * size * invBegin * invEnd;
        float cosWhole = (rho2 + begin * end) * invBegin * invEnd;
        vec2 middle = vec2(rho * (invBegin + invEnd), begin * invBegin + end * invEnd);
        float twoCos = max(length(middle), 1e-6f); // of the half
        middle = middle / twoCos;

        // ∫ cos ks ds and ∫ sin ks ds.
        float even[7];
        float odd[7];
        even[0] = sign * atan(sinWhole, cosWhole);
        odd[0] = 0.0f;
        float kernel = sign * 2.0f * sinWhole / twoCos; // 2 sin(k half)
        float before = 0.0f;
        vec2 turned = middle;
        for (int k = 1; k < 7; ++k) {
            even[k] = kernel * turned.x / float(k);
            odd[k] = kernel * turned.y / float(k);
            float next = twoCos * kernel - before;
            before = kernel;
            kernel = next;
            turned = vec2(turned.x * middle.x - turned.y * middle.y,
                          turned.x * middle.y + turned.y * middle.x);
        }
        float c[8]; // cos m phi
        float s[8];
        vec2 azimuth = across * invRho;
        c[0] = 1.0f;
        s[0] = 0.0f;
        for (int m = 1; m < 8; ++m) {
            c[m] = c[m - 1] * azimuth.x - s[m - 1] * azimuth.y;
            s[m] = c[m - 1] * azimuth.y + s[m - 1] * azimuth.x;
        }
        float a[8];
        if (order > 1) {
            a[1] = -0.244301256f * even[0];
            addMeridianBand(1, a, c, s, y);
        }
        if (order > 2) {
            a[1] = -0.182091405f * odd[1];
            a[2] = 0.182091405f * even[1];
            addMeridianBand(2, a, c, s, y);
        }
        if (order > 3) {
            a[1] = -0.0571307249f * even[0] + 0.0952178749f * even[2];
            a[2] = 0.120442143f * odd[2];
            a[3] = -0.0737554487f * even[0] - 0.0737554487f * even[2];
            addMeridianBand(3, a, c, s, y);
        }
        if (order > 4) {
            a[1] = -0.0752677362f * odd[1] + 0.0585415726f * odd[3];
            a[2] = 0.0354815511f * even[1] - 0.0827902859f * even[3];
            a[3] = -0.0663799039f * odd[1] - 0.0663799039f * odd[3];
            a[4] = 0.0938753603f * even[1] + 0.0312917868f * even[3];
            addMeridianBand(4, a, c, s, y);
        }
        if (order > 5) {
            a[1] = -0.0283091657f * even[0] + 0.052843776f * even[2] - 0.039632832f * even[4];
            a[2] = 0.0399461399f * odd[2] - 0.0599192098f * odd[4];
            a[3] = -0.0305773937f * even[0] + 0.024461915f * even[2] + 0.0550393087f * even[4];
            a[4] = 0.0691887438f * odd[2] + 0.0345943719f * odd[4];
            a[5] = -0.0410238786f * even[0] - 0.0546985047f * even[2] - 0.0136746262f * even[4];
            addMeridianBand(5, a, c, s, y);
        }
        if (order > 6) {
            a[1] = -0.0433498038f * odd[1] + 0.0390148234f * odd[3] - 0.0286108705f * odd[5];
            a[2] = 0.0137084116f * even[1] - 0.0370127113f * even[3] + 0.0452377583f * even[5];
            a[3] = -0.0411252348f * odd[1] + 0.00411252348f * odd[3] + 0.0452377583f * odd[5];
            a[4] = 0.030033625f * even[1] - 0.0450504376f * even[3] - 0.0330369875f * even[5];
            a[5] = -0.0352175471f * odd[1] - 0.0528263206f * odd[3] - 0.0176087735f * odd[5];
            a[6] = 0.0609985808f * even[1] + 0.0304992904f * even[3] + 0.00609985808f * even[5];
            addMeridianBand(6, a, c, s, y);
        }
        if (order > 7) {
            a[1] = -0.0176428921f * even[0] + 0.0340255776f * even[2] - 0.0299425083f * even[4] + 0.0216251449f * even[6];
            a[2] = 0.0185211785f * odd[2] - 0.0325972742f * odd[4] + 0.0353137137f * odd[6];
            a[3] = -0.0183350313f * even[0] + 0.0248832568f * even[2] + 0.00576243841f * even[4] - 0.0374558497f * even[6];
            a[4] = 0.0347488111f * odd[2] - 0.0277990489f * odd[4] - 0.0301156363f * odd[6];
            a[5] = -0.0202701398f * even[0] + 0.00434360138f * even[2] + 0.0434360138f * even[4] + 0.0188222727f * even[6];
            a[6] = 0.0442962164f * odd[2] + 0.0354369731f * odd[4] + 0.00885924329f * odd[6];
            a[7] = -0.0276235442f * even[0] - 0.0414353164f * even[2] - 0.0165741265f * even[4] - 0.00276235442f * even[6];
            addMeridianBand(7, a, c, s, y);
        }
    }
}

// A rectangle of radiance 1 in a frame of its own: `center` is where it lies along its two sides and
// before us, `half` half of its sides. Dark from behind, edge-on and on a corner; not cut off at any
// horizon. Bands 1 and up as two sums, in harmonics about its first side (with the second as their
// x) and about its second side (with the normal as their x); those of m = 0 stay zero. Returns the
// solid angle, negative where it is so small that a sample in its middle says more than edges, which
// keep 1e-7 / size; the sample is off by some l² size² / 16.
PT_FN float rectangleSh(vec3 center, vec2 halfSides, int order, PT_OUT_ARRAY(float, first, 64),
                        PT_OUT_ARRAY(float, second, 64)) {
    for (int band = 0; band < 8; ++band)
        for (int i = 0; i < 8; ++i) {
            first[8 * band + i] = 0.0f;
            second[8 * band + i] = 0.0f;
        }
    vec2 low = vec2(center.x - halfSides.x, center.y - halfSides.y);
    vec2 high = vec2(center.x + halfSides.x, center.y + halfSides.y);
    vec3 a = vec3(low.x, low.y, center.z);
    vec3 b = vec3(high.x, low.y, center.z);
    vec3 c = vec3(high.x, high.y, center.z);
    vec3 d = vec3(low.x, high.y, center.z);
    if (center.z <= 0.0f || min(min(dot(a, a), dot(b, b)), min(dot(c, c), dot(d, d))) < 1e-18f)
        return 0.0f;
    a = normalize(a);
    b = normalize(b);
    c = normalize(c);
    d = normalize(d);
    float solidAngle = max(triangleSolidAngle(a, b, c) + triangleSolidAngle(a, c, d), 0.0f);
    vec3 across = a - c;
    vec3 other = b - d;
    if (max(dot(across, across), dot(other, other)) < 1e-4f)
        return -solidAngle;
    if (order > 1) {
        vec2 sides = 2.0f * halfSides;
        addMeridianSh(vec2(low.y, center.z), low.x, sides.x, 1.0f, order, first);
        addMeridianSh(vec2(high.y, center.z), low.x, sides.x, -1.0f, order, first);
        addMeridianSh(vec2(center.z, high.x), low.y, sides.y, 1.0f, order, second);
        addMeridianSh(vec2(center.z, low.x), low.y, sides.y, -1.0f, order, second);
    }
    return solidAngle;
}

// The factors of a rectangle's bands: as of the cap of the same solid angle.
PT_FN void rectangleFactors(float solidAngle, int order, PT_ARRAY(float, window, 8),
                            PT_OUT_ARRAY(float, factor, 8)) {
    float scale = capScale(1.0f - solidAngle / kTwoPi, order, window);
    for (int l = 0; l < 8; ++l)
        factor[l] = scale * window[l];
}

#endif
