// What a point sees of lights that stand near it, as spherical harmonics: to be multiplied with its
// radiance transfer. core/math/ZonalHarmonics.h and PolygonHarmonics.h have the same in double
// precision. `order` counts bands, 1…8; only the first order² numbers are written.
#ifndef PT_NEARLIGHT_GLSL
#define PT_NEARLIGHT_GLSL

#include "constants.glsl"
#include "sh.glsl"

// shBasis64() up to a band that is not known before, by the recurrences of associated Legendre
// functions: a few instructions, where the polynomials' hundreds, inlined at each call, take software
// OpenGL ten seconds to compile.
PT_FN void shBasisOfOrder(vec3 d, int order, PT_OUT_ARRAY(float, y, 64)) {
    float diagonal = 0.282094791773878f; // normalised P_mm, without sin^m
    float c = 1.0f;                      // sin^m cos(m phi)
    float s = 0.0f;                      // sin^m sin(m phi)
    for (int m = 0; m < order; ++m) {
        float m2 = float(m * m);
        float p = m > 0 ? 1.41421356237310f * diagonal : diagonal;
        float previous = 0.0f;
        for (int l = m; l < order; ++l) {
            int center = l * (l + 1);
            y[center - m] = p * s;
            y[center + m] = p * c;
            float l2 = float(l * l);
            float n2 = float((l + 1) * (l + 1));
            float next = sqrt((4.0f * n2 - 1.0f) / (n2 - m2)) *
                         (d.z * p - sqrt((l2 - m2) / (4.0f * l2 - 1.0f)) * previous);
            previous = p;
            p = next;
        }
        diagonal = -diagonal * sqrt((2.0f * float(m) + 3.0f) / (2.0f * float(m) + 2.0f));
        float turned = c * d.x - s * d.y;
        s = c * d.y + s * d.x;
        c = turned;
    }
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
    shBasisOfOrder(d, order, y);
    float scale = capScale(1.0f, order, window);
    for (int l = 0; l < order; ++l)
        for (int i = l * l; i < (l + 1) * (l + 1); ++i)
            y[i] = y[i] * scale * window[l];
}

// A sphere of radiance 1, `toCenter` from its centre away; inside of it light comes from everywhere.
PT_FN void nearSphereSh(vec3 toCenter, float radius, int order, PT_ARRAY(float, window, 8),
                        PT_OUT_ARRAY(float, y, 64)) {
    float distance2 = dot(toCenter, toCenter);
    float sin2 = radius * radius / max(distance2, 1e-12f);
    if (sin2 >= 1.0f) {
        for (int i = 1; i < order * order; ++i)
            y[i] = 0.0f;
        y[0] = 3.54490770181103f; // sqrt(4pi)
    } else {
        float cosine = sqrt(1.0f - sin2);
        float bands[8];
        capBands(cosine, bands);
        shBasisOfOrder(toCenter * inversesqrt(distance2), order, y);
        float scale = kTwoPi * sin2 * capScale(cosine, order, window);
        for (int l = 0; l < order; ++l)
            for (int i = l * l; i < (l + 1) * (l + 1); ++i)
                y[i] = y[i] * scale * window[l] * bands[l];
    }
}

// ---- Polygons -----------------------------------------------------------------------------------

// Solid angle of a triangle, positive where its corners run clockwise as seen from the origin. Van
// Oosterom & Strackee 1983, "The Solid Angle of a Plane Triangle". Unit vectors.
PT_FN float triangleSolidAngle(vec3 a, vec3 b, vec3 c) {
    float volume = dot(a, cross(b - a, c - a));
    float divisor = 1.0f + dot(a, b) + dot(b, c) + dot(c, a);
    return volume == 0.0f ? 0.0f : 2.0f * atan(volume, divisor);
}

// ∫ Y_i along an arc of a great circle, `angle` long about `middle`, where it runs `along`. On the
// circle a harmonic of band l is a trigonometric polynomial of the frequencies l, l - 2, …; `order`
// samples on half of the circle hold it, and the integral of each sample's interpolation kernel is
// its weight.
PT_FN void arcSh(vec3 middle, vec3 along, float angle, int order, PT_OUT_ARRAY(float, sums, 64)) {
    for (int i = 0; i < order * order; ++i)
        sums[i] = 0.0f;
    float share = 1.0f / float(order);
    for (int j = 0; j < order; ++j) {
        float t = kPi * float(j) * share;
        float even = angle;
        float odd = 0.0f;
        for (int k = 1; k < order; ++k) {
            float n = float(k);
            float kernel = 4.0f / n * sin(0.5f * n * angle) * cos(n * t);
            if (k == 2 || k == 4 || k == 6)
                even = even + kernel;
            else
                odd = odd + kernel;
        }
        float y[64];
        shBasisOfOrder(middle * cos(t) + along * sin(t), order, y);
        for (int l = 0; l < order; ++l) {
            float weight = (l == 0 || l == 2 || l == 4 || l == 6 ? even : odd) * share;
            for (int i = l * l; i < (l + 1) * (l + 1); ++i)
                sums[i] = sums[i] + weight * y[i];
        }
    }
}

// Of complex harmonics, Y_lm = (Y_l,m + i Y_l,-m) / sqrt 2 for m > 0 and Y_l,-m = (-1)^m conj(Y_lm).
PT_FN vec2 complexSh(PT_ARRAY(float, y, 64), int l, int m) {
    int size = m < 0 ? -m : m;
    if (size > l)
        return vec2(0.0f);
    int center = l * (l + 1);
    if (m == 0)
        return vec2(y[center], 0.0f);
    vec2 value = 0.707106781186548f * vec2(y[center + size], y[center - size]);
    if (m > 0)
        return value;
    float sign = size == 2 || size == 4 || size == 6 ? 1.0f : -1.0f;
    return vec2(sign * value.x, -sign * value.y);
}

// ∫ n·∇(r^l Y_lm) along an arc from the integrals of the harmonics of band l - 1: derivatives of solid
// harmonics are solid harmonics of one degree less.
PT_FN vec2 arcSlope(PT_ARRAY(float, arc, 64), vec3 n, int l, int m) {
    vec2 same = complexSh(arc, l - 1, m);
    vec2 up = complexSh(arc, l - 1, m + 1);
    vec2 down = complexSh(arc, l - 1, m - 1);
    float a = float(l);
    float b = float(m);
    float kSame = n.z * sqrt((a - b) * (a + b));
    float kUp = 0.5f * sqrt(max((a - b) * (a - b - 1.0f), 0.0f));
    float kDown = 0.5f * sqrt((a + b) * (a + b - 1.0f));
    // conj(n) up and n down, n = n.x + i n.y
    vec2 turnedUp = vec2(n.x * up.x + n.y * up.y, n.x * up.y - n.y * up.x);
    vec2 turnedDown = vec2(n.x * down.x - n.y * down.y, n.x * down.y + n.y * down.x);
    return sqrt((2.0f * a + 1.0f) / (2.0f * a - 1.0f)) *
           (kSame * same + kUp * turnedUp - kDown * turnedDown);
}

// The share of the edge from p to q in the harmonics of bands 1 and up: Δ Y_lm = -l (l + 1) Y_lm, so
// by Gauss' theorem on the sphere the slope across the border is left.
PT_FN void addEdgeSh(vec3 p, vec3 q, int order, PT_INOUT_ARRAY(float, y, 64)) {
    vec3 normal = cross(p, q - p);
    float size = length(normal);
    if (size > 1e-7f * sqrt(dot(p, p) * dot(q, q))) { // otherwise it points at us
        vec3 n = normal / size;
        float angle = atan(size, dot(p, q));
        vec3 from = normalize(p);
        vec3 across = cross(n, from);
        float c = cos(0.5f * angle);
        float s = sin(0.5f * angle);
        float arc[64];
        arcSh(from * c + across * s, across * c - from * s, angle, order - 1, arc);
        for (int l = 1; l < order; ++l) {
            int center = l * (l + 1);
            float share = 1.0f / float(center);
            for (int m = 0; m <= l; ++m) {
                vec2 slope = share * arcSlope(arc, n, l, m);
                float both = m > 0 ? 1.41421356237310f : 1.0f;
                y[center + m] = y[center + m] + both * slope.x;
                if (m > 0)
                    y[center - m] = y[center - m] + both * slope.y;
            }
        }
    }
}

// ∫ Y_i over the directions to a planar convex quadrilateral; its lit side is the one from which the
// corners run clockwise, from the other it is dark. Not cut off at any horizon. The integral over a
// polygon becomes ones along its edges as in Wang & Ramamoorthi 2018, "Analytic Spherical Harmonic
// Coefficients for Polygonal Area Lights"; docs/maths/spherical-harmonics.md. Returns the solid angle.
PT_FN float quadSh(vec3 a, vec3 b, vec3 c, vec3 d, int order, PT_OUT_ARRAY(float, y, 64)) {
    for (int i = 0; i < order * order; ++i)
        y[i] = 0.0f;
    float nearest2 = min(min(dot(a, a), dot(b, b)), min(dot(c, c), dot(d, d)));
    if (nearest2 < 1e-18f) // on a corner
        return 0.0f;
    vec3 ua = normalize(a);
    vec3 ub = normalize(b);
    vec3 uc = normalize(c);
    vec3 ud = normalize(d);
    float solidAngle = triangleSolidAngle(ua, ub, uc) + triangleSolidAngle(ua, uc, ud);
    if (solidAngle <= 0.0f) // from behind, or edge-on
        return 0.0f;
    vec3 middle = ua + ub + uc + ud;
    vec3 across = ua - uc;
    vec3 other = ub - ud;
    // In single precision the edges' sum keeps 1e-7 / size; a sample in the middle is off by some
    // l² size² / 16.
    if (max(dot(across, across), dot(other, other)) < 1e-4f) {
        shBasisOfOrder(normalize(middle), order, y);
        for (int i = 0; i < order * order; ++i)
            y[i] = y[i] * solidAngle;
    } else {
        y[0] = 0.282094791773878f * solidAngle;
        // A loop, and not four calls: drivers inline them, and compile for a minute.
        for (int edge = 0; edge < 4 && order > 1; ++edge) {
            vec3 from = edge == 0 ? ua : edge == 1 ? ub : edge == 2 ? uc : ud;
            vec3 to = edge == 0 ? ub : edge == 1 ? uc : edge == 2 ? ud : ua;
            addEdgeSh(from, to, order, y);
        }
    }
    return solidAngle;
}

// A rectangle of radiance 1: `toCenter` to its centre, `halfX` and `halfY` half of its sides; the
// side that cross(halfY, halfX) points to shines, as in shadeRectangle().
PT_FN void nearRectangleSh(vec3 toCenter, vec3 halfX, vec3 halfY, int order,
                           PT_ARRAY(float, window, 8), PT_OUT_ARRAY(float, y, 64)) {
    float solidAngle = quadSh(toCenter - halfX - halfY, toCenter + halfX - halfY,
                              toCenter + halfX + halfY, toCenter - halfX + halfY, order, y);
    // As the cap of the same solid angle.
    float scale = capScale(1.0f - solidAngle / kTwoPi, order, window);
    for (int l = 0; l < order; ++l)
        for (int i = l * l; i < (l + 1) * (l + 1); ++i)
            y[i] = y[i] * scale * window[l];
}

#endif
