// The response of a camera: which exposure each code of a picture stands for, recovered from photos
// of one scene with known exposures.
// P. E. Debevec, J. Malik, "Recovering High Dynamic Range Radiance Maps from Photographs",
// SIGGRAPH 1997. docs/maths/bracket.md has the formulas.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace patina {

// Codes are those of 8 bits, 0 … 255, whatever the file has: 16 bits are codes with fractions.
inline constexpr std::size_t kCodes = 256;
inline constexpr float kTopCode = 255.0f;
inline constexpr std::size_t kMidCode = 128; // whose exposure is 1, so that greys stay grey

// g of the paper, less g(kMidCode): natural logarithm of the exposure that gives the code. It never
// falls.
using LogResponse = std::array<double, kCodes>;

// The hat weight of the paper, 0 … 1: how much a sample of this code counts. 0 for codes that are
// clipped.
[[nodiscard]] constexpr float hatWeight(float code) {
    constexpr float kHalf = kTopCode / 2.0f;
    const float fromEnd = code < kHalf ? code : kTopCode - code;
    return fromEnd > 0.0f ? fromEnd / kHalf : 0.0f;
}

// Between two codes: linear.
[[nodiscard]] double logResponseAt(const LogResponse& response, double code);

// The sRGB curve, and log of the code itself. Code 0 of either is the exposure of a quarter code:
// half of what rounds up to 1.
[[nodiscard]] LogResponse srgbResponse();

// Largest difference of two responses between codes 16 and 240, as a factor less 1: 0.02 is 2 %.
[[nodiscard]] double responseDifference(const LogResponse& a, const LogResponse& b);

// One place of the scene: its codes in the photos that show it.
struct ResponseSample {
    struct Seen {
        float code = 0.0f;
        float logExposure = 0.0f; // natural logarithm, of the photo
    };
    std::vector<Seen> seen; // at least two
};

struct RecoveredResponse {
    LogResponse curve{};
    double noiseCodes = 0.0; // standard deviation of a sample's code, at least kLeastNoise
};
// Rounding to whole codes alone: 1 / sqrt(12).
inline constexpr double kLeastNoise = 0.29;

// Weighted least squares with smoothness, solved anew with less say for samples that fit badly:
// what moved between the photos. `samples`: at least kLeastSamples.
inline constexpr std::size_t kLeastSamples = 32;
[[nodiscard]] RecoveredResponse recoverResponse(const std::vector<ResponseSample>& samples);

} // namespace patina
