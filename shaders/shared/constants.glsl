// Numbers that several terms share.
#ifndef PT_CONSTANTS_GLSL
#define PT_CONSTANTS_GLSL

#include "macros.glsl"

PT_CONST float kPi = 3.14159265358979f;
PT_CONST float kTwoPi = 6.28318530717959f;
PT_CONST float kInvPi = 0.318309886183791f;

// F0 of a dielectric with refractive index 1.5: ((1.5 - 1) / (1.5 + 1))² (glTF 2.0, appendix B).
PT_CONST float kDielectricIor = 1.5f;
PT_CONST float kDielectricF0 = 0.04f;

// The smallest perceptual roughness of an analytic light's highlight. At alpha = 0.045² the square
// that enters D is 4.1e-6: its reciprocal and D's peak (7.8e4) keep four digits in 32-bit floats,
// and a highlight stays wide enough to meet a pixel (Lagarde & de Rousiers 2014, section 3.2.1,
// use the same order of magnitude). Image-based light is not clamped: level 0 is a mirror.
PT_CONST float kMinPerceptualRoughness = 0.045f;

// The smallest N·V: interpolated and mapped normals turn away from the viewer at silhouettes,
// where V's denominator would vanish.
PT_CONST float kMinNoV = 1e-4f;

#endif
