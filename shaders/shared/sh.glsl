// Real spherical harmonics with the Condon-Shortley phase, index l(l+1)+m, zonal axis z: the signs
// of Green 2003 and Sloan 2008 (Y_1,1 = -0.4886 x). Polynomials in the components of a unit vector.
// core/math/SphericalHarmonics.h has the same basis for any order, projection and rotation.
#ifndef PT_SH_GLSL
#define PT_SH_GLSL

#include "constants.glsl"

// Bands 0…2. Sloan 2008, "Stupid Spherical Harmonics (SH) Tricks", appendix A2.
PT_FN void shBasis9(vec3 d, PT_OUT_ARRAY(float, y, 9)) {
    y[0] = 0.282094791773878f;
    y[1] = -0.488602511902920f * d.y;
    y[2] = 0.488602511902920f * d.z;
    y[3] = -0.488602511902920f * d.x;
    y[4] = 1.09254843059208f * d.x * d.y;
    y[5] = -1.09254843059208f * d.y * d.z;
    y[6] = 0.315391565252520f * (3.0f * d.z * d.z - 1.0f);
    y[7] = -1.09254843059208f * d.x * d.z;
    y[8] = 0.546274215296040f * (d.x * d.x - d.y * d.y);
}

// Bands 0…4. Sloan 2008, appendix A2.
PT_FN void shBasis25(vec3 d, PT_OUT_ARRAY(float, y, 25)) {
    float x2 = d.x * d.x;
    float y2 = d.y * d.y;
    float z2 = d.z * d.z;
    y[0] = 0.282094791773878f;
    y[1] = -0.488602511902920f * d.y;
    y[2] = 0.488602511902920f * d.z;
    y[3] = -0.488602511902920f * d.x;
    y[4] = 1.09254843059208f * d.x * d.y;
    y[5] = -1.09254843059208f * d.y * d.z;
    y[6] = 0.315391565252520f * (3.0f * z2 - 1.0f);
    y[7] = -1.09254843059208f * d.x * d.z;
    y[8] = 0.546274215296040f * (x2 - y2);
    y[9] = -0.590043589926644f * d.y * (3.0f * x2 - y2);
    y[10] = 2.89061144264055f * d.x * d.y * d.z;
    y[11] = -0.457045799464466f * d.y * (5.0f * z2 - 1.0f);
    y[12] = 0.373176332590115f * d.z * (5.0f * z2 - 3.0f);
    y[13] = -0.457045799464466f * d.x * (5.0f * z2 - 1.0f);
    y[14] = 1.44530572132028f * d.z * (x2 - y2);
    y[15] = -0.590043589926644f * d.x * (x2 - 3.0f * y2);
    y[16] = 2.50334294179670f * d.x * d.y * (x2 - y2);
    y[17] = -1.77013076977993f * d.y * d.z * (3.0f * x2 - y2);
    y[18] = 0.946174695757560f * d.x * d.y * (7.0f * z2 - 1.0f);
    y[19] = -0.669046543557289f * d.y * d.z * (7.0f * z2 - 3.0f);
    y[20] = 0.105785546915204f * (35.0f * z2 * z2 - 30.0f * z2 + 3.0f);
    y[21] = -0.669046543557289f * d.x * d.z * (7.0f * z2 - 3.0f);
    y[22] = 0.473087347878780f * (x2 - y2) * (7.0f * z2 - 1.0f);
    y[23] = -1.77013076977993f * d.x * d.z * (x2 - 3.0f * y2);
    y[24] = 0.625835735449176f * (x2 * (x2 - 3.0f * y2) - y2 * (3.0f * x2 - y2));
}

// Bands 0…7, for pictures of what many bands hold. Factors of (x + iy)^m and polynomials in z:
// Sloan 2013, "Efficient Spherical Harmonic Evaluation", JCGT 2(2).
PT_FN void shBasis64(vec3 d, PT_OUT_ARRAY(float, y, 64)) {
    float low[25];
    shBasis25(d, low);
    for (int i = 0; i < 25; ++i)
        y[i] = low[i];
    float z2 = d.z * d.z;
    // cos(m phi) and sin(m phi), times sin^m(theta)
    float c1 = d.x;
    float s1 = d.y;
    float c2 = d.x * c1 - d.y * s1;
    float s2 = d.x * s1 + d.y * c1;
    float c3 = d.x * c2 - d.y * s2;
    float s3 = d.x * s2 + d.y * c2;
    float c4 = d.x * c3 - d.y * s3;
    float s4 = d.x * s3 + d.y * c3;
    float c5 = d.x * c4 - d.y * s4;
    float s5 = d.x * s4 + d.y * c4;
    float c6 = d.x * c5 - d.y * s5;
    float s6 = d.x * s5 + d.y * c5;
    float c7 = d.x * c6 - d.y * s6;
    float s7 = d.x * s6 + d.y * c6;
    float p;
    y[30] = 0.116950322453424f * d.z * ((63.0f * z2 - 70.0f) * z2 + 15.0f);
    p = -0.452946651195697f * ((21.0f * z2 - 14.0f) * z2 + 1.0f);
    y[29] = p * s1;
    y[31] = p * c1;
    p = 2.39676839248666f * d.z * (3.0f * z2 - 1.0f);
    y[28] = p * s2;
    y[32] = p * c2;
    p = -0.48923829943525f * (9.0f * z2 - 1.0f);
    y[27] = p * s3;
    y[33] = p * c3;
    p = 2.07566231488104f * d.z;
    y[26] = p * s4;
    y[34] = p * c4;
    p = -0.65638205684017f;
    y[25] = p * s5;
    y[35] = p * c5;
    y[42] = 0.0635692022676284f * (((231.0f * z2 - 315.0f) * z2 + 105.0f) * z2 - 5.0f);
    p = -0.582621362518731f * d.z * ((33.0f * z2 - 30.0f) * z2 + 5.0f);
    y[41] = p * s1;
    y[43] = p * c1;
    p = 0.460602629757462f * ((33.0f * z2 - 18.0f) * z2 + 1.0f);
    y[40] = p * s2;
    y[44] = p * c2;
    p = -0.921205259514923f * d.z * (11.0f * z2 - 3.0f);
    y[39] = p * s3;
    y[45] = p * c3;
    p = 0.504564900728724f * (11.0f * z2 - 1.0f);
    y[38] = p * s4;
    y[46] = p * c4;
    p = -2.36661916223175f * d.z;
    y[37] = p * s5;
    y[47] = p * c5;
    p = 0.683184105191914f;
    y[36] = p * s6;
    y[48] = p * c6;
    y[56] = 0.0682842769120049f * d.z * (((429.0f * z2 - 693.0f) * z2 + 315.0f) * z2 - 35.0f);
    p = -0.0903316075825173f * (((429.0f * z2 - 495.0f) * z2 + 135.0f) * z2 - 5.0f);
    y[55] = p * s1;
    y[57] = p * c1;
    p = 0.221266346222491f * d.z * ((143.0f * z2 - 110.0f) * z2 + 15.0f);
    y[54] = p * s2;
    y[58] = p * c2;
    p = -0.156458933862294f * ((143.0f * z2 - 66.0f) * z2 + 3.0f);
    y[53] = p * s3;
    y[59] = p * c3;
    p = 1.03783115744052f * d.z * (13.0f * z2 - 3.0f);
    y[52] = p * s4;
    y[60] = p * c4;
    p = -0.51891557872026f * (13.0f * z2 - 1.0f);
    y[51] = p * s5;
    y[61] = p * c5;
    p = 2.6459606618019f * d.z;
    y[50] = p * s6;
    y[62] = p * c6;
    p = -0.707162732524596f;
    y[49] = p * s7;
    y[63] = p * c7;
}

// A_l: convolution with the clamped cosine multiplies band l by this, which turns radiance into
// irradiance coefficients. Ramamoorthi & Hanrahan 2001, "On the relationship between radiance and
// irradiance", equation 24 (their values: pi, 2pi/3, pi/4, 0, -pi/24).
PT_FN float shCosineFactor(int l) {
    if (l == 0)
        return kPi;
    if (l == 1)
        return 2.0f * kPi / 3.0f;
    if (l == 2)
        return kPi / 4.0f;
    if (l == 4)
        return -kPi / 24.0f;
    if (l == 6)
        return kPi / 64.0f;
    return 0.0f; // odd bands; bands above 7 are not used
}

#endif
