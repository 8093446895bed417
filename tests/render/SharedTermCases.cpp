#include "tests/render/SharedTermCases.h"

#include "core/math/Shading.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>

namespace patina::render {

void InputMaker::direction(std::span<float> in) {
    const float z = uniform(-1.0f, 1.0f), phi = uniform(0.0f, 6.2831853f);
    const float r = std::sqrt(1.0f - z * z);
    in[0] = r * std::cos(phi);
    in[1] = r * std::sin(phi);
    in[2] = z;
}

void InputMaker::directionAbove(std::span<const float> n, std::span<float> in) {
    direction(in);
    if (n[0] * in[0] + n[1] * in[1] + n[2] * in[2] < 0.0f)
        for (float& value : in)
            value = -value;
}

namespace {

using namespace shading; // NOLINT: the bodies are GLSL, too

using In = std::span<float>;

void unit(InputMaker& make, In in) {
    make.numbers(in, 0.0f, 1.0f);
}
// cosines and alpha above zero, as the terms ask for
void aboveZero(InputMaker& make, In in) {
    make.numbers(in, 0.01f, 1.0f);
}
void hdr(InputMaker& make, In in) {
    for (float& value : in)
        value = std::exp2(make.uniform(-8.0f, 8.0f));
}
void signedNumbers(InputMaker& make, In in) {
    make.numbers(in, -2.0f, 2.0f);
}
void directions(InputMaker& make, In in) {
    for (std::size_t i = 0; i + 3 <= in.size(); i += 3)
        make.direction(in.subspan(i, 3));
}
// n, v, l, then base colour, metallic, roughness, dfg, light.
void surface(InputMaker& make, In in) {
    make.numbers(in, 0.0f, 1.0f);
    make.direction(in.subspan(0, 3));
    make.directionAbove(in.subspan(0, 3), in.subspan(3, 3));
    make.direction(in.subspan(6, 3));
    in[14] = make.uniform(0.3f, 0.9f);
    in[15] = make.uniform(0.0f, 0.1f);
}

// As surface(), then in 16…19 a lobe's fit, in 20…22 a place, in 23…31 shapes. The fit is a lobe
// that the table holds (a matrix of positive determinant).
void areaLight(InputMaker& make, In in) {
    surface(make, in);
    in[16] = make.uniform(0.5f, 1.5f);
    in[17] = make.uniform(-0.4f, 0.4f);
    in[18] = make.uniform(-0.2f, 0.2f);
    in[19] = make.uniform(0.3f, 1.0f);
    make.numbers(in.subspan(20), -2.0f, 2.0f);
}
// A surface at the ends of what can happen: roughness and metallic 0 and 1 and beyond, normal and
// light along, against and across the viewer, black and too bright albedo, 1e14 of light (a lamp
// inside the surface). The choices of the model stay random.
void extremes(InputMaker& make, In in) {
    surface(make, in);
    const auto pick = [&make](std::initializer_list<float> values) {
        return values.begin()[static_cast<std::size_t>(make.uniform(0.0f, 0.999f) *
                                                       static_cast<float>(values.size()))];
    };
    for (std::size_t i = 0; i < 3; ++i)
        in[9 + i] = pick({0.0f, 0.5f, 1.0f, 20.0f});
    in[12] = pick({0.0f, 0.5f, 1.0f});
    in[13] = pick({-1.0f, 0.0f, 0.045f, 0.5f, 1.0f, 2.0f});
    in[14] = pick({0.0f, 0.5f, 1.2f});
    in[15] = pick({0.0f, 0.1f});
    in[16] = in[17] = in[18] = pick({0.0f, 1.0f, 1e14f});
    for (std::size_t i = 22; i < 26; ++i)
        in[i] = pick({0.0f, 0.5f, 1.0f});
    const float where = make.uniform(0.0f, 6.0f);
    if (where < 1.0f) // the viewer across the surface
        for (std::size_t i = 0; i < 3; ++i)
            in[3 + i] = i == 2 ? -in[0] : i == 0 ? in[2] : 0.0f;
    else if (where < 2.0f) // light towards the viewer
        std::copy_n(in.begin() + 3, 3, in.begin() + 6);
    else if (where < 3.0f) // light opposite the viewer
        for (std::size_t i = 0; i < 3; ++i)
            in[6 + i] = -in[3 + i];
    else if (where < 4.0f) // light along the normal
        std::copy_n(in.begin(), 3, in.begin() + 6);
    const float length = std::sqrt(in[3] * in[3] + in[4] * in[4] + in[5] * in[5]);
    for (std::size_t i = 0; i < 3; ++i)
        in[3 + i] = length > 1e-3f ? in[3 + i] / length : in[i];
}

// Colours of every exponent, with the numbers at which the format ends mixed in.
void rgbe(InputMaker& make, In in) {
    static constexpr float kEdges[] = {0.0f,        -1.0f, 1e-32f,           1.1e-32f, 1.6e38f,
                                       1.69477e38f, 3e38f, 1.7014118346e38f, 65504.0f, 0.9999f};
    for (float& value : in)
        value = make.uniform() < 0.2f ? kEdges[static_cast<int>(make.uniform(0.0f, 9.99f))]
                                      : std::exp2(make.uniform(-100.0f, 126.0f));
    for (std::size_t i = 3; i < 7; ++i) // bytes to decode, their exponent in the normal range
        in[i] = std::floor(make.uniform(i == 6 ? 20.0f : 0.0f, 255.99f));
    in[7] = in[0] * make.uniform();
    in[8] = in[0] * make.uniform();
}

#define I(k) in[k]
#define O(k) out[k]
#define CASE(name, prepare, scale, ...)                                                            \
    SharedTermCase {                                                                               \
        name, #__VA_ARGS__, []([[maybe_unused]] const float* in, float* out) { __VA_ARGS__ },      \
            prepare, scale                                                                         \
    }
#define SURFACE_OF(model)                                                                          \
    makeSurface(model, surfaceOf(vec3(I(9), I(10), I(11)), I(12), I(13), I(25)),                   \
                vec3(I(0), I(1), I(2)), vec3(I(3), I(4), I(5)), vec2(I(14), I(15)))
#define SURFACE SURFACE_OF(defaultBrdfModel())
// Any model, chosen by inputs that no case of a surface needs otherwise.
#define CHOOSE_MODEL(m)                                                                            \
    BrdfModel m = defaultBrdfModel();                                                              \
    m.distribution = int(0.999f * float(kDistributionCount) * I(26));                              \
    m.visibility = int(0.999f * float(kVisibilityCount) * I(27));                                  \
    m.fresnel = int(0.999f * float(kFresnelCount) * I(28));                                        \
    m.diffuse = int(0.999f * float(kDiffuseCount) * I(29));                                        \
    m.multiScatter = int(1.999f * I(30));                                                          \
    m.f90 = I(31);                                                                                 \
    m.ior = 1.0f + I(22);                                                                          \
    m.conductorN = vec3(0.05f + 3.0f * I(23), 1.0f, 0.2f);                                         \
    m.conductorK = vec3(5.0f * I(24), 2.0f, 3.0f);
// 1 for what light can be: neither negative, nor infinite, nor NaN, which compares false. For the
// rest each language has a number of its own, so that they only agree when both are fine.
#define IS_LIGHT(x) ((x) >= 0.0f && (x) < 3e38f ? 1.0f : 2.0f)
#define OUT3(k, v)                                                                                 \
    {                                                                                              \
        vec3 value = v;                                                                            \
        O(k) = value.x;                                                                            \
        O(k + 1) = value.y;                                                                        \
        O(k + 2) = value.z;                                                                        \
    }

std::vector<SharedTermCase> makeCases() {
    return {
        CASE("distributions", aboveZero, 1e-3f, float sin2 = 1.0f - I(0) * I(0);
             O(0) = D_GGX(I(0), I(1)); O(1) = D_GGX_Sin2(I(0), sin2, I(1));
             O(2) = D_Beckmann_Sin2(I(0), sin2, I(1)); O(3) = D_BlinnPhong_Sin2(sin2, I(1));
             O(4) = logOneMinus(I(2)); O(5) = logOneMinus(0.1f * I(2));
             O(6) = distribution(defaultBrdfModel(), I(0), sin2, I(1));),
            CASE("visibility", aboveZero, 1e-3f, O(0) = V_SmithGGXCorrelated(I(0), I(1), I(2));
                 O(1) = V_SmithGGXSeparable(I(0), I(1), I(2)); O(2) = G1_SmithGGX(I(0), I(2));
                 O(3) = V_SmithBeckmannCorrelated(I(0), I(1), I(2));
                 O(4) = V_SmithBeckmannSeparable(I(0), I(1), I(2));
                 O(5) = G1_SmithBeckmann(I(0), I(2)); O(6) = scaledLambdaBeckmann(I(0), I(2));
                 O(7) = V_SchlickGGX(I(0), I(1), I(2)); O(8) = schlickKDirect(I(3));
                 O(9) = V_Kelemen(I(3)); O(10) = V_Implicit();
                 O(11) = visibility(defaultBrdfModel(), I(0), I(1), I(3), I(2));),
            CASE("fresnel", unit, 1e-2f, OUT3(0, F_Schlick(vec3(I(0), I(1), I(2)), I(3), I(4)));
                 O(3) = schlickWeight(I(4)); O(4) = f0FromIor(1.0f + I(5));
                 O(5) = F_Dielectric(I(4), 1.0f + I(5));
                 OUT3(6, F_Conductor(I(4), vec3(0.1f + I(6), 1.0f + I(7), 3.0f * I(8) + 0.05f),
                                     5.0f * vec3(I(9), I(10), I(11))));),
            CASE("diffuse", unit, 1e-2f, O(0) = Fd_Lambert();
                 O(1) = Fd_Burley(I(0), I(1), I(2), I(3)); O(2) = E_Burley(I(0), I(3));
                 O(3) = Fd_OrenNayar(I(0), I(1), 2.0f * I(2) - 1.0f, I(3));
                 O(4) = E_OrenNayar(I(0), I(3)); vec2 c = orenNayarCoefficients(I(3)); O(5) = c.x;
                 O(6) = c.y; O(7) = E_FON(I(0), I(3));
                 OUT3(8, multiScatterAlbedoEon(vec3(I(4), I(5), I(6)), I(3)));
                 OUT3(11, Fd_Eon(vec3(I(4), I(5), I(6)), I(0), I(1), 2.0f * I(2) - 1.0f, I(3)));
                 OUT3(14, E_Eon(vec3(I(4), I(5), I(6)), I(0), I(3)));),
            CASE("dispatch", unit, 1e-2f, CHOOSE_MODEL(m);
                 float alpha = alphaFromPerceptualRoughness(I(0)); float NoH = 0.5f + 0.5f * I(1);
                 O(0) = distribution(m, NoH, 1.0f - NoH * NoH, alpha);
                 O(1) = visibility(m, 0.01f + 0.99f * I(2), 0.01f + 0.99f * I(3), I(4), alpha);
                 vec3 color = vec3(I(5), I(6), I(7)); vec3 f0 = normalReflectance(m, color, I(8));
                 OUT3(2, f0); OUT3(5, fresnel(m, f0, I(8), I(4)));
                 OUT3(8, diffuse(m, color, I(0), I(9), I(2), I(3), I(4)));
                 OUT3(11, diffuseReflectance(m, color, I(0), I(9), I(2)));
                 OUT3(14, energyCompensation(m, f0, vec2(I(10), I(11))));
                 OUT3(17, singleScatterAlbedo(m, f0, I(8), vec2(0.1f + I(10), I(11))));
                 OUT3(20, specularAlbedo(m, f0, I(8), vec2(0.1f + I(10), I(11))));),
            CASE("index", unit, 1e-2f, CHOOSE_MODEL(m);
                 BrdfModel own = modelOfIndex(m, 1.0f + I(0));
                 BrdfModel standard = modelOfIndex(m, kDielectricIor); O(0) = own.dielectricF0;
                 O(1) = own.ior; O(2) = standard.dielectricF0; O(3) = standard.ior;),
            CASE("parameters", unit, 1e-2f, O(0) = alphaFromPerceptualRoughness(I(0));
                 OUT3(4, diffuseColorFromBaseColor(vec3(I(1), I(2), I(3)), I(4)));
                 OUT3(7, energyCompensationTurquin(vec3(I(1), I(2), I(3)), vec2(I(5), I(6))));),
            CASE("surface", surface, 1e-2f, CHOOSE_MODEL(m); SurfaceTerms s = SURFACE_OF(m);
                 O(0) = s.NoV; O(1) = s.alpha; O(2) = s.perceptualRoughness;
                 OUT3(3, s.diffuseColor); OUT3(6, s.f0); OUT3(9, s.energyCompensation);
                 OUT3(12, s.specularAlbedo); OUT3(15, s.diffuseAlbedo); O(18) = s.metallic;
                 OUT3(19, s.transmission); O(22) = s.diffuseRoughness;
                 s = fadeSpecularLayer(s, I(24)); OUT3(23, s.transmission + s.diffuseAlbedo);),
            CASE("lobes", surface, 1e-2f, SurfaceTerms s = SURFACE;
                 OUT3(0, specularLobe(s, I(16), 1.0f - I(16) * I(16), I(17), I(18)));
                 OUT3(3, diffuseLobe(s, I(17), I(18)));),
            CASE("shade direct", surface, 1e-2f, SurfaceTerms s = SURFACE;
                 ShadedLight light =
                     shadeDirect(s, vec3(I(6), I(7), I(8)), vec3(I(16), I(17), I(18)));
                 OUT3(0, light.diffuse); OUT3(3, light.specular);),
            CASE("shade direct, any model", surface, 1e-2f, CHOOSE_MODEL(m);
                 SurfaceTerms s = SURFACE_OF(m);
                 ShadedLight light =
                     shadeDirect(s, vec3(I(6), I(7), I(8)), vec3(I(16), I(17), I(18)));
                 OUT3(0, light.diffuse); OUT3(3, light.specular);),
            CASE("extremes stay finite", extremes, 1.0f, CHOOSE_MODEL(m);
                 m.ior = 1.0f + 2.0f * I(22); m.conductorN = vec3(0.01f + I(23));
                 SurfaceTerms s = SURFACE_OF(m); vec3 E = vec3(I(16), I(17), I(18));
                 vec3 l = vec3(I(6), I(7), I(8)); ShadedLight a = shadeDirect(s, l, E);
                 ShadedLight b = shadeDirect(s, s.n, E); ShadedLight c = shadeEnvironment(s, E, E);
                 vec3 sum =
                     a.diffuse + a.specular + b.diffuse + b.specular + c.diffuse + c.specular;
                 float pdf = 0.0f; vec3 sampled = sampleBrdf(s, vec3(0.5f, 0.25f, I(25)), pdf);
                 O(0) = IS_LIGHT(sum.x); O(1) = IS_LIGHT(sum.y); O(2) = IS_LIGHT(sum.z);
                 O(3) = IS_LIGHT(pdf); O(4) = IS_LIGHT(dot(sampled, sampled));
                 O(5) = IS_LIGHT(brdfPdf(s, l));),
            CASE("shade environment", surface, 1e-2f, SurfaceTerms s = SURFACE;
                 ShadedLight light =
                     shadeEnvironment(s, vec3(I(16), I(17), I(18)), vec3(I(19), I(20), I(21)));
                 OUT3(0, light.diffuse); OUT3(3, light.specular);
                 OUT3(6, shadeIrradiance(s, vec3(I(16), I(17), I(18))));
                 OUT3(9, shadePrefiltered(s, vec3(I(19), I(20), I(21))));
                 OUT3(12, lobeDirection(s, I(16))); O(15) = specularOcclusion(I(22), I(23), I(24));
                 O(16) = prefilteredLevel(I(25), 22, 256.0f);
                 O(17) = prefilteredRoughness(int(21.0f * abs(I(24))), 22, 256.0f);
                 O(18) = levelDensity(100.0f * abs(I(24)));
                 O(19) = levelStep(22, 256.0f * abs(I(24)));),
            CASE("through", surface, 1e-2f, SurfaceTerms s = SURFACE;
                 s.clearColor = vec3(I(9), I(10), I(11));
                 OUT3(0, throughDirection(s.n, s.v, 1.0f + 2.0f * abs(I(22))));
                 O(3) = throughRoughness(abs(I(23)), 1.0f + 2.0f * abs(I(22)));
                 OUT3(4, shadeThrough(s, vec3(I(16), I(17), I(18))));),
            CASE("cones", surface, 1e-2f, SurfaceTerms s = SURFACE;
                 O(0) = sharedCap(I(16), I(17), I(18)); O(2) = angleOf(I(16));
                 O(1) = coneOcclusion(vec4(I(16), I(17), I(18), I(23)), s.n, s.v, I(24));),
            CASE("lat-long", directions, 1e-2f,
                 vec2 uv = latLongFromDirection(vec3(I(0), I(1), I(2)));
                 O(0) = uv.x; O(1) = uv.y; OUT3(2, directionFromLatLong(uv));
                 OUT3(5, rotateY(vec3(I(0), I(1), I(2)), 3.0f * I(3)));
                 vec2 table = dfgTableUv(abs(I(0)), abs(I(1))); O(8) = table.x; O(9) = table.y;),
            CASE("cube atlas", directions, 1.0f, vec3 at = cubeFacePosition(vec3(I(0), I(1), I(2)));
                 OUT3(0, at); vec2 texel = cubeAtlasTexel(at, int(21.0f * abs(I(3))), 256.0f);
                 O(3) = texel.x; O(4) = texel.y;
                 vec2 size = cubeAtlasSize(64.0f, int(22.0f * abs(I(4)))); O(5) = size.x;
                 O(6) = size.y; O(7) = cubeLevelSide(int(21.0f * abs(I(3))), 64.0f);
                 O(8) = float(cubeLevelHalvings(int(21.0f * abs(I(3))), 256.0f * abs(I(4))));
                 O(9) = cubeAtlasTop(256.0f, int(3.9f * abs(I(4))));
                 O(10) = cubeAtlasWideTop(256.0f * abs(I(4)));
                 O(11) = cubeHalvedSide(int(3.9f * abs(I(4))), 256.0f);),
            CASE("spherical harmonics", directions, 1e-1f, float y9[9]; float y25[25];
                 shBasis9(vec3(I(0), I(1), I(2)), y9); shBasis25(vec3(I(0), I(1), I(2)), y25);
                 for (int i = 0; i < 25; ++i) O(i) = y25[i];
                 for (int i = 0; i < 9; ++i) O(i) = O(i) + y9[i];),
            CASE("eight bands", directions, 1e-1f, float y[64];
                 shBasis64(vec3(I(0), I(1), I(2)), y); for (int i = 0; i < 25; ++i) O(i) = y[i];
                 for (int i = 25; i < 28; ++i) O(i) = y[i] + y[i + 36];),
            CASE("eight bands, the upper", directions, 1e-1f, float y[64];
                 shBasis64(vec3(I(0), I(1), I(2)), y);
                 for (int i = 0; i < 28; ++i) O(i) = y[28 + i];),
            CASE("eight bands, the last", directions, 1e-1f, float y[64];
                 shBasis64(vec3(I(0), I(1), I(2)), y);
                 for (int i = 0; i < 8; ++i) O(i) = y[56 + i];),
            CASE("near point and sphere", directions, 1e-1f, float window[8];
                 for (int l = 0; l < 8; ++l) window[l] = 1.0f - 0.1f * float(l); float y[64];
                 nearPointSh(vec3(I(0), I(1), I(2)), 8, window, y); O(0) = y[20]; O(1) = y[30];
                 O(2) = y[48]; O(3) = y[63]; nearPointSh(vec3(I(0), I(1), I(2)), 6, window, y);
                 O(4) = y[0]; O(5) = y[7]; O(6) = y[35];
                 nearSphereSh(2.0f * vec3(I(3), I(4), I(5)), 1.0f + 1.2f * I(6), 5, window, y);
                 for (int i = 0; i < 9; ++i) O(7 + i) = y[i]; O(16) = y[24]; float bands[8];
                 capBands(I(7), bands); for (int l = 1; l < 8; ++l) O(16 + l) = bands[l];
                 O(24) = capScale(0.9f * I(8), 5, window);),
            CASE(
                "near rectangle", directions, 1e-1f, float y[64]; float other[64];
                for (int i = 0; i < 64; ++i) y[i] = 0.0f;
                O(0) = triangleSolidAngle(vec3(I(0), I(1), I(2)), vec3(I(3), I(4), I(5)),
                                          vec3(I(6), I(7), I(8)));
                addMeridianSh(vec2(I(0), I(1)), I(2), 1.0f + I(9), 1.0f, 8, y); O(1) = y[3];
                O(2) = y[7]; O(3) = y[14]; O(4) = y[24]; O(5) = y[31]; O(6) = y[45]; O(7) = y[57];
                O(8) = y[63]; vec3 center = vec3(I(3), I(4), 0.3f + abs(I(5)));
                vec2 sides = vec2(0.6f, 0.4f); O(9) = rectangleSh(center, sides, 5, y, other);
                O(10) = y[1]; O(11) = y[13]; O(12) = y[22]; O(13) = other[5]; O(14) = other[17];
                O(15) = y[25]; float window[8]; float factor[8];
                for (int l = 0; l < 8; ++l) window[l] = 1.0f - 0.1f * float(l);
                rectangleFactors(abs(O(9)), 6, window, factor); O(16) = factor[0];
                O(17) = factor[5]; scaleBands(6, factor, y); O(18) = y[3]; O(19) = y[21];
                float a[8]; float c[8]; float s[8]; for (int i = 0; i < 8; ++i) {
                    a[i] = I(0);
                    c[i] = I(1);
                    s[i] = I(2);
                } addMeridianBand(3, a, c, s, y);
                O(20) = y[9]; O(21) = y[15];),
            CASE("cosine factor", unit, 1.0f,
                 for (int l = 0; l < 8; ++l) O(l) = shCosineFactor(l);),
            CASE("irradiance", directions, 1.0f, vec3 sh[9];
                 for (int i = 0; i < 9; ++i) sh[i] = vec3(I(3 + i), I(12 + i), I(21 + i));
                 OUT3(0, irradianceFromSh9(sh, vec3(I(0), I(1), I(2))));),
            CASE("normal map", unit, 1e-2f,
                 OUT3(0, decodeNormalTs(vec3(I(0), I(1), I(2)), 2.0f * I(3),
                                        I(4) < 0.5f ? -1.0f : 1.0f));),
            CASE("tangent space", directions, 1e-2f,
                 OUT3(0, normalTsToWorld(vec3(I(0), I(1), abs(I(2))), vec3(I(3), I(4), I(5)),
                                         vec4(I(6), I(7), I(8), I(9) < 0.0f ? -1.0f : 1.0f)));),
            CASE("tone map", hdr, 1e-2f, vec3 c = vec3(I(0), I(1), I(2));
                 OUT3(0, applyExposure(c, log2(I(3)))); OUT3(3, toneMapClamp(c));
                 O(6) = reinhard(I(4)); O(7) = reinhardExtended(I(4), I(5));
                 OUT3(8, toneMapReinhard(c)); O(11) = luminance(c);
                 OUT3(12, toneMapReinhardPhotographic(c, I(6), 0.0f));
                 OUT3(15, toneMapReinhardPhotographic(c, I(6), I(7)));
                 OUT3(18, toneMapExponential(c, I(8))); OUT3(21, toneMapPbrNeutral(c));),
            CASE("tone map per channel", hdr, 1e-2f, vec3 c = vec3(I(0), I(1), I(2));
                 OUT3(0, toneMapReinhardChannels(c));
                 OUT3(3, toneMapReinhardPhotographicChannels(c, I(6), 0.0f));
                 OUT3(6, toneMapReinhardPhotographicChannels(c, I(6), I(7)));),
            CASE("tone map of films", hdr, 1e-2f, vec3 c = vec3(I(0), I(1), I(2));
                 OUT3(0, toneMapAces(c)); OUT3(3, toneMapAgX(c));
                 O(6) = agxCurve(clamp(0.1f * I(3), 0.0f, 1.0f));
                 O(7) = agxScale(0.3f, 0.5f, 2.0f, 2.5f + min(I(4), 1.0f));),
            CASE("steps of tone maps", hdr, 1e-2f, vec3 c = vec3(I(0), I(1), I(2));
                 O(0) = pbrNeutralReflection(0.1f * I(3));
                 O(1) = pbrNeutralPeak(kNeutralStart + I(4)); OUT3(2, acesInput(c));
                 OUT3(5, acesCurve(c)); OUT3(8, acesOutput(c)); OUT3(11, agxInset(c));
                 OUT3(14, agxStops(c)); OUT3(17, agxOutset(c));),
            CASE(
                "tone map dispatch", hdr, 1e-2f, vec3 c = vec3(I(0), -I(1), 1e20f * I(2));
                ToneCurve t; t.scale = I(3); t.white = I(4); t.k = I(5);
                t.perChannel = I(6) < 0.5f ? 0 : 1; for (int i = 0; i < kToneMapOpenColorIo; ++i) {
                    t.curve = i;
                    vec3 shown = toneMap(c, t);
                    O(4 + i) = shown.x + 2.0f * shown.y + 4.0f * shown.z;
                } OUT3(0, finiteRadiance(c));
                O(3) = finiteRadiance(-I(6));),
            CASE("identity colour", unit, 1e-2f, OUT3(0, identityColor(floor(200.0f * I(0))));),
            CASE(
                "display", unit, 1e-2f,
                OUT3(0, displayEncode(vec3(I(0), I(1), I(2)), kDisplaySrgb, 2.2f));
                OUT3(3, displayEncode(vec3(I(0), I(1), I(2)), kDisplayGamma, 1.0f + 2.0f * I(3)));),
            CASE("adaptation", hdr, 1e-2f, O(0) = logLuminance(vec3(I(0), I(1), I(2)));
                 O(1) = automaticExposure(I(3)); O(2) = adaptationWeight(I(4));
                 O(3) = adaptLuminance(I(5), 0.1f + 0.5f * I(5), 0.004f + 0.01f * I(7));
                 O(4) = reinhardAutoKey(I(8), 0.004f, 256.0f);),
            CASE("sRGB", signedNumbers, 1e-2f, O(0) = srgbEncode(I(0)); O(1) = srgbDecode(I(1));
                 OUT3(2, srgbEncode(vec3(I(2), I(3), I(4))));
                 OUT3(5, srgbDecode(vec3(I(2), I(3), I(4))));),
            CASE("RGBE", rgbe, 1e-30f, vec4 e = rgbeEncode(vec3(I(0), I(1), I(2))); O(0) = e.x;
                 O(1) = e.y; O(2) = e.z; O(3) = e.w; vec4 near = rgbeEncode(vec3(I(7), I(0), I(8)));
                 O(4) = near.x; O(5) = near.y; O(6) = near.z; O(7) = near.w;
                 OUT3(8, rgbeDecode(vec4(I(3), I(4), I(5), I(6)))); O(11) = rgbeClamp(I(9));
                 OUT3(12, rgbeDecode(vec4(I(3), I(4), I(5), 0.0f)));),
            CASE("sampling", unit, 1e-1f, vec2 u = vec2(I(0), I(1)); vec2 disc = concentricDisc(u);
                 O(0) = disc.x; O(1) = disc.y; OUT3(2, cosineHemisphere(u));
                 O(5) = cosineHemispherePdf(I(2)); OUT3(6, uniformSphere(u));),
            CASE("basis", directions, 1e-1f, vec3 t; vec3 b;
                 orthonormalBasis(vec3(I(0), I(1), I(2)), t, b); OUT3(0, t); OUT3(3, b);),
            CASE("visible normals", surface, 1e-1f,
                 OUT3(0, sampleVndfGGX(vec2(I(16), I(17)), vec3(I(6), I(7), abs(I(8)) + 1e-3f),
                                       0.01f + I(18)));
                 O(3) = vndfReflectionPdf(0.01f + I(19), I(20), 0.01f + 0.9f * I(18));),
            CASE("half vectors", unit, 1e-1f, vec2 u = vec2(I(0), I(1));
                 float alpha = 0.01f + 0.99f * I(2); OUT3(0, sampleHalfVectorGGX(u, alpha));
                 OUT3(3, sampleHalfVectorBeckmann(u, alpha));
                 OUT3(6, sampleHalfVectorBlinnPhong(u, alpha));
                 OUT3(9, directionFromSin2(I(3), 6.0f * I(4))); CHOOSE_MODEL(m);
                 O(12) = specularReflectionPdf(m, 0.1f + 0.9f * I(5), I(6), 1.0f - I(6) * I(6),
                                               0.1f + 0.9f * I(7), alpha);
                 OUT3(13, sampleHalfVector(m, u, vec3(0.6f, 0.0f, 0.8f), alpha));),
            CASE("EON sampling", unit, 1e-1f, vec2 u = vec2(0.98f * I(0), I(1));
                 vec3 wo = directionFromSin2(0.9f * I(2), 6.0f * I(3));
                 vec3 wi = directionFromSin2(0.9f * I(4), 6.0f * I(5)); float r = I(6);
                 vec4 k = cltcCoefficients(I(2), r); O(0) = k.x; O(1) = k.y; O(2) = k.z; O(3) = k.w;
                 O(4) = eonUniformShare(I(2), r); vec2 axis = cltcAxis(wo); O(5) = axis.x;
                 O(6) = axis.y; OUT3(7, sampleCltc(u, wo, r)); O(10) = cltcPdf(wo, wi, r);
                 O(11) = eonPdf(wo, wi, r);
                 if (abs(u.x - eonUniformShare(wo.z, r)) > 1e-3f) OUT3(12, sampleEon(u, wo, r));),
            CASE(
                "surface sampling", surface, 1e-1f, CHOOSE_MODEL(m); SurfaceTerms s = SURFACE_OF(m);
                vec3 l = vec3(I(6), I(7), I(8)); O(0) = brdfPdf(s, l);
                O(1) = specularProbability(s); vec3 t; vec3 b; orthonormalBasis(s.n, t, b);
                OUT3(2, viewerInFrame(s, t, b)); float pdf = 0.0f;
                if (abs(I(18) - specularProbability(s)) > 1e-3f) {
                    vec3 sampled = sampleBrdf(s, vec3(0.98f * I(16), I(17), I(18)), pdf);
                    OUT3(5, sampled);
                }),
            CASE("punctual lights", unit, 1e-2f, O(0) = rangeWindow(I(0), I(1));
                 O(1) = spotFalloff(2.0f * I(2) - 1.0f, 1.0f + 5.0f * I(3), -2.0f * I(4));
                 O(2) = pointFalloff(I(5), I(6)); O(3) = lobeAngle(I(7));),
            CASE("sphere form factor", unit, 1e-2f,
                 O(0) = sphereFormFactor(2.0f * I(0) - 1.0f, I(1));
                 O(1) = sphereFormFactor(0.3f * I(2) - 0.15f, 0.02f * I(3));),
            CASE("polygon form factor", directions, 1e-1f, vec3 a = vec3(I(0), I(1), I(2));
                 vec3 b = vec3(I(3), I(4), I(5)); O(0) = edgeFormFactor(a, b);
                 OUT3(1, horizonPoint(a, b)); float sum = 0.0f; vec3 down = vec3(0.0f);
                 vec3 up = vec3(0.0f); addClippedEdge(a, b, sum, down, up); O(4) = sum;
                 OUT3(5, down); OUT3(8, up); vec3 center = vec3(I(6), I(7), I(8));
                 vec3 x = 0.7f * vec3(I(9), I(10), I(11)); vec3 y = 0.7f * cross(x, center);
                 O(11) = quadFormFactor(center - x - y, center + x - y, center + x + y,
                                        center - x + y);),
            CASE("lobe of area lights", areaLight, 1e-1f,
                 vec4 fit = vec4(I(16), I(17), I(18), I(19));
                 vec3 d = vec3(I(3), I(4), I(5)); OUT3(0, toLobe(fit, d));
                 O(3) = lobeOfSphere(fit, d, 0.01f + 0.9f * I(14));
                 vec3 x = vec3(I(23), I(24), I(25)); vec3 y = 0.5f * cross(x, d);
                 O(4) = lobeOfQuad(fit, d - x - y, d + x - y, d + x + y, d - x + y); vec3 t; vec3 u;
                 lobeFrame(vec3(I(0), I(1), I(2)), d, t, u); OUT3(5, t); OUT3(8, u);),
            CASE("shade area lights", areaLight, 1e-1f, SurfaceTerms s = SURFACE;
                 vec4 fit = vec4(I(16), I(17), I(18), I(19));
                 ShadedLight area = shadeArea(s, I(9), I(10), vec3(I(11), I(12), I(13)));
                 OUT3(0, area.diffuse); OUT3(3, area.specular);
                 ShadedLight sphere = shadeSphere(s, fit, vec3(I(20), I(21), I(22)), abs(I(23)),
                                                  vec3(I(9), I(10), I(11)));
                 OUT3(6, sphere.diffuse); OUT3(9, sphere.specular);
                 vec3 x = vec3(I(24), I(25), I(26)); vec3 y = cross(vec3(I(27), I(28), I(29)), x);
                 ShadedLight rectangle = shadeRectangle(s, fit, vec3(I(20), I(21), I(22)), x, y,
                                                        vec3(I(9), I(10), I(11)));
                 OUT3(12, rectangle.diffuse); OUT3(15, rectangle.specular);),
    };
}

} // namespace

const std::vector<SharedTermCase>& sharedTermCases() {
    static const std::vector<SharedTermCase> cases = makeCases();
    return cases;
}

} // namespace patina::render
