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
    return 0.0f; // l = 3; bands above 4 are not used
}

#endif
