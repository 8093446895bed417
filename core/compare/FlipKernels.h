// The filters of FLIP as one-dimensional kernels: each two-dimensional one is a product, or a sum
// of two products, of these. Seen by this module only.
#pragma once

#include <array>
#include <vector>

namespace patina::compare {

// Weights of the centre and of the pixels 1, 2 … to its right; those to the left are equal, or
// their negatives where the kernel is odd.
using HalfKernel = std::vector<float>;

// Σ wᵢ (a[+i] + a[-i]), w₀ once.
template <class Row>
inline void filterEven(const HalfKernel& kernel, const Row& at, float* out, int count) {
    const float* centre = at(0);
    for (int x = 0; x < count; ++x)
        out[x] = kernel[0] * centre[x];
    for (int i = 1; i < static_cast<int>(kernel.size()); ++i) {
        const float weight = kernel[static_cast<std::size_t>(i)];
        const float *left = at(-i), *right = at(i);
        for (int x = 0; x < count; ++x)
            out[x] += weight * (left[x] + right[x]);
    }
}

// Σ wᵢ (a[+i] - a[-i]): exactly 0 where all samples are equal.
template <class Row>
inline void filterOdd(const HalfKernel& kernel, const Row& at, float* out, int count) {
    for (int x = 0; x < count; ++x)
        out[x] = 0.0f;
    for (int i = 1; i < static_cast<int>(kernel.size()); ++i) {
        const float weight = kernel[static_cast<std::size_t>(i)];
        const float *left = at(-i), *right = at(i);
        for (int x = 0; x < count; ++x)
            out[x] += weight * (right[x] - left[x]);
    }
}

// The same as filterEven() for a kernel that sums to 0, w₀ = -2 Σ wᵢ: exactly 0 where all samples
// are equal. The power of one half that follows would make 3e-4 of a rounding error of 1e-7.
template <class Row>
inline void filterZeroSum(const HalfKernel& kernel, const Row& at, float* out, int count) {
    const float* centre = at(0);
    for (int x = 0; x < count; ++x)
        out[x] = 0.0f;
    for (int i = 1; i < static_cast<int>(kernel.size()); ++i) {
        const float weight = kernel[static_cast<std::size_t>(i)];
        const float *left = at(-i), *right = at(i);
        for (int x = 0; x < count; ++x)
            out[x] += weight * ((right[x] - centre[x]) + (left[x] - centre[x]));
    }
}

struct FlipKernels {
    explicit FlipKernels(double pixelsPerDegree);

    // Contrast sensitivity of the eye to Y, Cx and Cz (2020, section 4.1.1). That of Cz is the sum
    // of two products: each kernel sums to 1, and so do the two weights.
    HalfKernel achromatic, redGreen;
    std::array<HalfKernel, 2> blueYellow;
    std::array<float, 2> blueYellowWeight{};

    // Edges and points (section 4.2): a Gaussian, and its first and second derivative, whose
    // positive weights sum to 1 and negative ones to -1.
    HalfKernel gaussian, derivative, secondDerivative;

    [[nodiscard]] int radius() const; // of the widest
};

} // namespace patina::compare
