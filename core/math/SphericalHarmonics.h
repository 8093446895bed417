// Real spherical harmonics of any order up to 8 bands: basis, projection of environments and cosine
// convolution. Condon-Shortley phase, index l(l+1)+m, zonal axis z: the basis of
// shaders/shared/sh.glsl. "Order" counts bands: order 3 has 9 coefficients.
#pragma once

#include "core/image/Image.h"
#include "core/job/JobContext.h"

#include <cstddef>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace patina {

inline constexpr int kMaxShOrder = 8;

[[nodiscard]] constexpr int shCount(int order) {
    return order * order;
}
[[nodiscard]] constexpr int shIndex(int l, int m) {
    return l * (l + 1) + m;
}
// Bands of so many coefficients; CHECKs that they are those of whole bands, 1 … kMaxShOrder.
[[nodiscard]] int shOrderOf(std::size_t coefficients);

// Y_0 … of a unit direction into out[0 … order²). Exact polynomials: no poles, no trigonometry.
void evaluateSh(int order, const glm::dvec3& direction, std::span<double> out);
void evaluateSh(int order, const glm::vec3& direction, std::span<float> out);
// sums[i] += Σ Y_i(d) over the directions, four at a time: what a baker does with the open ones.
void sumSh(int order, std::span<const glm::vec3> directions, std::span<float> sums);

// A_l, what convolution with the clamped cosine multiplies band l by. Ramamoorthi & Hanrahan 2001,
// "On the relationship between radiance and irradiance", equation 24; any l >= 0.
[[nodiscard]] double cosineConvolution(int l);

// Radiance coefficients to irradiance coefficients, in place: E_lm = A_l L_lm.
void convolveWithCosine(std::span<glm::vec3> coefficients);

// L_i = ∫ L(ω) Y_i(ω) dω of a lat-long image (F32, 3 channels or more, conventions of
// patina::Environment). Each texel is a patch of constant radiance, and its patch is integrated
// exactly: a sun of one texel keeps its energy wherever it stands. Rows are spread over the pool;
// the result does not depend on their number. After a cancel the result is meaningless.
[[nodiscard]] std::vector<glm::vec3> projectLatLong(const Image& environment, int order,
                                                    const JobContext& job = {});

} // namespace patina
