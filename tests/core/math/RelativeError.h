// What the tests of shading terms hold values against.
#pragma once

#include <array>
#include <cmath>
#include <gtest/gtest.h>

namespace patina::shading {

// Perceptual roughness of the tabulated values.
inline constexpr std::array<float, 5> kRoughness = {0.1f, 0.25f, 0.5f, 0.75f, 1.0f};

inline void expectRelative(double actual, double expected, double tolerance, const char* what) {
    EXPECT_LE(std::abs(actual - expected), tolerance * std::abs(expected) + 1e-12)
        << what << ": " << actual << " instead of " << expected;
}

} // namespace patina::shading
