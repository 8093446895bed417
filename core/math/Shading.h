// The shading terms of shaders/shared compiled as C++: the GPU preview, the bakers and the tests
// run the same source. Everything lives in patina::shading, with GLM's vectors under their GLSL
// names.
#pragma once

#include <cmath>
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

// The C++ side of shaders/shared/macros.glsl.
#define PT_CPP 1
#define PT_FN [[maybe_unused]] inline
#define PT_CONST inline constexpr
#define PT_OUT(type) type&
#define PT_INOUT(type) type&
#define PT_ARRAY(type, name, n) const type* name
#define PT_OUT_ARRAY(type, name, n) type* name
#define PT_INOUT_ARRAY(type, name, n) type* name
#define PT_INIT(value)                                                                             \
    { value }
#define PT_EQUALITY(type) friend bool operator==(const type&, const type&) = default;

namespace patina::shading {

using glm::mat3;
using glm::vec2;
using glm::vec3;
using glm::vec4;

// One by one: a using directive would let the C library's double functions take part.
using glm::abs;
using glm::acos;
using glm::atan;
using glm::ceil;
using glm::clamp;
using glm::cos;
using glm::cross;
using glm::dot;
using glm::exp;
using glm::exp2;
using glm::floor;
using glm::fract;
using glm::frexp;
using glm::inversesqrt;
using glm::ldexp;
using glm::length;
using glm::log2;
using glm::max;
using glm::min;
using glm::mix;
using glm::normalize;
using glm::pow;
using glm::reflect;
using glm::sin;
using glm::sqrt;

// clang-format off: the order of inclusion is the order of dependence
#include "../../shaders/shared/brdf.glsl"
#include "../../shaders/shared/color.glsl"
#include "../../shaders/shared/constants.glsl"
#include "../../shaders/shared/ibl.glsl"
#include "../../shaders/shared/lights.glsl"
#include "../../shaders/shared/nearlight.glsl"
#include "../../shaders/shared/normalmap.glsl"
#include "../../shaders/shared/rgbe.glsl"
#include "../../shaders/shared/sampling.glsl"
#include "../../shaders/shared/sh.glsl"
#include "../../shaders/shared/tonemap.glsl"
// clang-format on

} // namespace patina::shading

#undef PT_CPP
#undef PT_FN
#undef PT_CONST
#undef PT_OUT
#undef PT_INOUT
#undef PT_ARRAY
#undef PT_OUT_ARRAY
#undef PT_INOUT_ARRAY
#undef PT_INIT
#undef PT_EQUALITY
