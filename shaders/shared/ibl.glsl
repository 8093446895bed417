// Image-based light: split-sum specular, SH irradiance, and the mappings of environments.
#ifndef PT_IBL_GLSL
#define PT_IBL_GLSL

#include "brdf.glsl"
#include "sh.glsl"

// ---- Mappings ----------------------------------------------------------------------------------

// Unit direction to lat-long uv: the image centre is -Z, its top row +Y, +X to the right of the
// centre; u = 0.5 + atan2(x, -z) / 2pi, v = acos(y) / pi (the convention of USC's high-resolution
// probes). atan2 instead of acos: it keeps its digits at the poles.
PT_FN vec2 latLongFromDirection(vec3 d) {
    float rho = sqrt(d.x * d.x + d.z * d.z);
    float v = atan(rho, d.y) * kInvPi;
    if (rho < 1e-12f) // straight up or down: every u is right, and atan(0, 0) is undefined in GLSL
        return vec2(0.5f, v);
    return vec2(0.5f + atan(d.x, -d.z) / kTwoPi, v);
}

PT_FN vec3 directionFromLatLong(vec2 uv) {
    float phi = (uv.x - 0.5f) * kTwoPi;
    float theta = uv.y * kPi;
    float s = sin(theta);
    return vec3(s * sin(phi), cos(theta), -s * cos(phi));
}

// Turns d about +Y, counter-clockwise as seen from above. An environment rotated by `a` is looked up
// in the direction rotateY(d, -a).
PT_FN vec3 rotateY(vec3 d, float angleRad) {
    float c = cos(angleRad);
    float s = sin(angleRad);
    return vec3(c * d.x + s * d.z, d.y, c * d.z - s * d.x);
}

// ---- Levels of the prefiltered cubemap ---------------------------------------------------------
//
// Level i of n holds alpha = c (q^i - 1) with q^(n - 1) = 1 + 1 / c: evenly spaced where the lobe is
// narrower than a texel, in equal ratios where it is wider. c goes with the texel of level 0.

// 1 / c; `side`: of a face of level 0. c is 1.22 times the width of its texels, 2 / side.
PT_FN float levelDensity(float side) {
    return side * 0.411f;
}

// log2 of q.
PT_FN float levelStep(int levels, float side) {
    return log2(1.0f + levelDensity(side)) / float(levels - 1);
}

PT_FN float prefilteredRoughness(int level, int levels, float side) { // perceptual
    if (level <= 0 || levels <= 1)
        return 0.0f;
    float alpha = (exp2(float(level) * levelStep(levels, side)) - 1.0f) / levelDensity(side);
    return level >= levels - 1 ? 1.0f : sqrt(alpha);
}

// Between whole levels: the fraction is the share of the rougher one. With x = 1 + alpha / c, a to
// q a between two levels, it is linear in x + 1 / x, which goes with alpha² for alpha < c, as the
// lobe's tails do, and with alpha beyond, where its peak matters as well.
PT_FN float prefilteredLevel(float perceptualRoughness, int levels, float side) {
    if (levels <= 1)
        return 0.0f;
    float r = clamp(perceptualRoughness, 0.0f, 1.0f);
    float x = 1.0f + r * r * levelDensity(side);
    float steps = levelStep(levels, side);
    float q = exp2(steps);
    float first = min(floor(log2(x) / steps), float(levels - 2));
    float a = exp2(first * steps);
    float share = q * (x - a) * (a - 1.0f / x) / ((q - 1.0f) * (q * a * a - 1.0f));
    return first + clamp(share, 0.0f, 1.0f);
}

// Four levels have the full size, the next four half of it, then a quarter; the others an eighth,
// but not below 16 texels: a bilinear lookup in fewer shows its seams on a rough metal, however
// smooth the filtered light is. From level 20 on it is a quarter again: opposite a sun the widest
// lobes have an edge, where N·L is cut at zero. How often the side of whole level `level` is halved:
PT_CONST int kFirstWideLevel = 20;

PT_FN int cubeLevelHalvings(int level, float side) {
    int most = side < 32.0f ? 0 : (side < 64.0f ? 1 : (side < 128.0f || level >= kFirstWideLevel ? 2 : 3));
    return min(level >> 2, most);
}

// Side of a face that has been halved so often, at most three times; `side` is that of level 0, a power
// of two. Eighths instead of a division by 2^halvings: exact, and without a division.
PT_FN float cubeHalvedSide(int halvings, float side) {
    return side * (0.125f * float(8 >> halvings));
}

// Side of a face of whole level `level`.
PT_FN float cubeLevelSide(int level, float side) {
    return cubeHalvedSide(cubeLevelHalvings(level, side), side);
}

// The prefiltered cubemap lies in one flat texture (core/light/CubeAtlas.h). Six faces side by side,
// +X -X +Y -Y +Z -Z, each with a border of one texel, are a level; 1, 2, 4, 8 levels of one size are
// a row. Above the levels that are halved so often lie, in rows of texels, 4 side + 2 side / 2 + … and
// the borders, 2 for each row: with 1 / 2^halvings = e / 8, side (64 - e²) / 12 + 2 (8 - e), a whole
// number. The widest lobes' levels that are larger than those before lie below all.
PT_FN float cubeAtlasTop(float side, int halvings) {
    float eighths = float(8 >> halvings);
    return side * ((64.0f - eighths * eighths) * 0.0833333333f) + (16.0f - 2.0f * eighths);
}

// The row of texels where those begin.
PT_FN float cubeAtlasWideTop(float side) {
    return cubeAtlasTop(side, 3) + (cubeHalvedSide(3, side) + 2.0f); // one row of eight levels
}

PT_FN vec2 cubeAtlasSize(float side, int levels) {
    int halvings = cubeLevelHalvings(kFirstWideLevel - 1, side);
    bool wide = levels > kFirstWideLevel && side >= 128.0f;
    int inGroup = wide ? kFirstWideLevel : levels;
    float k = float(1 << halvings);
    float size = cubeHalvedSide(halvings, side);
    float rows = ceil(float(max(inGroup - 4 * halvings, 1)) / k);
    float height = cubeAtlasTop(side, halvings) + rows * (size + 2.0f);
    if (wide)
        height = height + ceil(float(levels - kFirstWideLevel) / 4.0f) * (side * 0.25f + 2.0f);
    return vec2(6.0f * (side + 2.0f * k), height);
}

// Face 0…5 and position 0…1 on it of a direction, not necessarily unit: OpenGL 4.6, table 8.19.
PT_FN vec3 cubeFacePosition(vec3 d) {
    vec3 a = abs(d);
    bool onZ = a.z >= max(a.x, a.y);
    bool onY = !onZ && a.y >= a.x;
    float major = onZ ? d.z : (onY ? d.y : d.x);
    float side = major < 0.0f ? -1.0f : 1.0f;
    float sc = onZ ? side * d.x : (onY ? d.x : -side * d.z);
    float tc = onY ? side * d.z : -d.y;
    float scale = 0.5f / max(abs(major), 1e-30f); // no direction at all: the middle of a face
    float face = onZ ? 4.0f : (onY ? 2.0f : 0.0f);
    return vec3(face + (major < 0.0f ? 1.0f : 0.0f), sc * scale + 0.5f, tc * scale + 0.5f);
}

// Where in the atlas, in texels, `at` (cubeFacePosition) lies on whole level `level`.
PT_FN vec2 cubeAtlasTexel(vec3 at, int level, float side) {
    int halvings = cubeLevelHalvings(level, side);
    bool wide = level >= kFirstWideLevel && side >= 128.0f;
    float size = cubeHalvedSide(halvings, side);
    float top = wide ? cubeAtlasWideTop(side) : cubeAtlasTop(side, halvings);
    int inGroup = level - (wide ? kFirstWideLevel : 4 * halvings);
    int row = inGroup >> halvings;
    float column = float(inGroup - (row << halvings));
    float pitch = size + 2.0f;
    return vec2((6.0f * column + at.x) * pitch + 1.0f + at.y * size,
                top + float(row) * pitch + 1.0f + at.z * size);
}

// Side of the DFG table (core/light/DfgTable.h). Its outer texels lie on the ends of both ranges:
// at N·V = 1 and at perceptualRoughness 1 much is looked at, and half a texel short of both E is
// 1.5 % high.
PT_CONST float kDfgTableSize = 128.0f;

PT_FN vec2 dfgTableUv(float NoV, float perceptualRoughness) {
    float scale = (kDfgTableSize - 1.0f) / kDfgTableSize;
    return vec2(NoV, perceptualRoughness) * scale + vec2(0.5f / kDfgTableSize);
}

// ---- Light -------------------------------------------------------------------------------------

// Irradiance from irradiance coefficients (radiance coefficients times A_l).
// Ramamoorthi & Hanrahan 2001, "An Efficient Representation for Irradiance Environment Maps",
// equation 10. Nine coefficients may go slightly negative opposite a small strong light (up to 4 %
// of its peak); irradiance cannot, so it is cut at zero here, where it is used.
PT_FN vec3 irradianceFromSh9(PT_ARRAY(vec3, irradianceSh, 9), vec3 n) {
    float y[9];
    shBasis9(n, y);
    vec3 sum = vec3(0.0f);
    for (int i = 0; i < 9; ++i)
        sum = sum + irradianceSh[i] * y[i];
    return max(sum, vec3(0.0f));
}

// Where to look the specular light up, not normalised: the lobe's mean direction, which leans from
// the mirror direction towards the normal the rougher the surface. `tilt`: third channel of the DFG
// table; 1 gives the mirror direction, which Karis 2013 uses.
PT_FN vec3 lobeDirection(SurfaceTerms s, float tilt) {
    vec3 r = reflect(-s.v, s.n);
    if (s.model.lobeDirection == kLobeDirectionMirror)
        return r;
    return mix(s.n, r, tilt);
}

// Which way a viewer looks through a clear solid body, as far as one of its faces can tell: refracted
// there by Snell's law, and again where a ball would be left, whose normal is the face's mirrored in
// the ray. So a ball shows the environment as it does, and other bodies alike.
PT_FN vec3 throughDirection(vec3 n, vec3 v, float ior) {
    float entering = clamp(dot(n, v), 0.0f, 1.0f);
    float inside = sqrt(max(1.0f - (1.0f - entering * entering) / (ior * ior), 0.0f));
    vec3 d = (entering / ior - inside) * n - v / ior;
    vec3 far = n + 2.0f * inside * d;
    return ior * d + (entering - ior * inside) * far;
}

// The roughness of a reflection that is as blurred as what is seen through both faces of a body: a
// facet tilted by a small angle turns reflected light by twice that, and light that goes through by
// (n - 1) times that; two faces add up by their squares, so that alpha is (n - 1) / sqrt(2) of it.
PT_FN float throughRoughness(float perceptualRoughness, float ior) {
    return perceptualRoughness * sqrt(clamp((ior - 1.0f) * 0.70710678f, 0.0f, 1.0f));
}

// How much of the specular lobe an ambient visibility of `ao` leaves open.
// Lagarde & de Rousiers 2014, "Moving Frostbite to PBR", listing 26.
PT_FN float specularOcclusion(float NoV, float ao, float alpha) {
    return clamp(pow(NoV + ao, exp2(-16.0f * alpha - 1.0f)) - 1.0f + ao, 0.0f, 1.0f);
}

// Arc cosine of what may lie a rounding error outside of [-1, 1]. Drivers' acos is good to 1e-4
// only, their atan to the last digits.
PT_FN float angleOf(float cosine) {
    return atan(sqrt(max((1.0f - cosine) * (1.0f + cosine), 0.0f)), cosine);
}

// Solid angle that two caps of directions share, over 2 pi; all three cosines: of the caps' half angles
// and of the angle between their axes. Exact where one cap holds the other or they are apart, smooth
// between. Oat & Sander 2007, "Ambient Aperture Lighting", equation 2.
PT_FN float sharedCap(float cosA, float cosB, float cosBetween) {
    float a = angleOf(cosA);
    float b = angleOf(cosB);
    float between = angleOf(cosBetween);
    float smaller = 1.0f - max(cosA, cosB);
    float inside = abs(a - b);
    float x = clamp((between - inside) / max(a + b - inside, 1e-4f), 0.0f, 1.0f);
    return smaller * (1.0f - x * x * (3.0f - 2.0f * x));
}

// How much of the specular lobe about the unit vector `r` a baked transfer leaves open. `cone`: of its
// bands 0 and 1, along the bent normal and the ambient visibility. Jimenez, Wu, Pesce & Jarabo 2016,
// "Practical Realtime Strategies for Accurate Indirect Occlusion", section 5.2: what is visible is
// taken for a cone about the bent normal, of half angle arccos sqrt(1 - visibility), and the lobe for
// one of the same mean cosine, which 1 / (1 + 2 alpha^1.25) gives within 0.02 of GGX' prefilter kernel.
// Their share is divided by that of the open hemisphere, so that nothing is lost where nothing is
// hidden; a lobe on the horizon keeps 0.07 at least, and what points further down fades out.
// Bands 0 and 1 know no sharp edges: the lobe is never narrower than that of alpha = 0.15.
PT_FN float coneOcclusion(vec4 cone, vec3 n, vec3 r, float alpha) {
    vec3 bent = vec3(cone.x, cone.y, cone.z);
    float length2 = dot(bent, bent);
    vec3 axis = length2 > 1e-8f ? bent * inversesqrt(length2) : n;
    float cosLobe = 1.0f / (1.0f + 2.0f * pow(max(alpha, 0.15f), 1.25f));
    float cosVisible = sqrt(clamp(1.0f - cone.w, 0.0f, 1.0f));
    float open = sharedCap(0.0f, cosLobe, dot(n, r));
    return clamp(sharedCap(cosVisible, cosLobe, dot(axis, r)) / max(open, 0.05f), 0.0f, 1.0f);
}

// ---- Shading -----------------------------------------------------------------------------------

// Diffuse light of irradiance E, as if it came evenly from all sides: exact for Lambert; the other
// lobes prefer directions, which an irradiance does not know.
PT_FN vec3 shadeIrradiance(SurfaceTerms s, vec3 irradiance) {
    return s.diffuseAlbedo * irradiance * kInvPi;
}

// The split sum, Karis 2013, "Real Shading in Unreal Engine 4", equation 7: prefiltered radiance
// times the lobe's albedo.
PT_FN vec3 shadePrefiltered(SurfaceTerms s, vec3 prefilteredRadiance) {
    return s.specularAlbedo * prefilteredRadiance;
}

// What is seen through a clear body under the layer; `behind`: radiance that arrives there.
PT_FN vec3 shadeThrough(SurfaceTerms s, vec3 behind) {
    return s.transmission * s.clearColor * behind;
}

PT_FN ShadedLight shadeEnvironment(SurfaceTerms s, vec3 irradiance, vec3 prefilteredRadiance) {
    ShadedLight result;
    result.diffuse = shadeIrradiance(s, irradiance);
    result.specular = shadePrefiltered(s, prefilteredRadiance);
    return result;
}

#endif
