#include "core/image/Srgb.h"

#include <algorithm>
#include <cmath>
#include <memory>

namespace patina {

namespace {

double decode(double encoded) {
    const double magnitude = std::abs(encoded);
    const double linear =
        magnitude <= 0.04045 ? magnitude / 12.92 : std::pow((magnitude + 0.055) / 1.055, 2.4);
    return std::copysign(linear, encoded);
}

// Rounding an encoded value to 8 bits means comparing the linear value with 255 thresholds. The
// square root spreads them evenly enough that one table look-up finds the code but for a step or
// two.
constexpr int kGuesses = 1024;

struct Thresholds {
    std::array<float, 256> lower{}; // the smallest linear value that code k stands for
    std::array<std::uint8_t, kGuesses> guess{};

    Thresholds() {
        lower[0] = -1.0f;
        for (int k = 1; k < 256; ++k)
            lower[static_cast<std::size_t>(k)] = static_cast<float>(decode((k - 0.5) / 255.0));
        for (int i = 0; i < kGuesses; ++i) {
            const float root = static_cast<float>(i) / (kGuesses - 1);
            const auto above = std::upper_bound(lower.begin(), lower.end(), root * root);
            // One lower than the code at the bucket's start, as rounding may reach below it.
            guess[static_cast<std::size_t>(i)] =
                static_cast<std::uint8_t>(std::max<std::ptrdiff_t>(0, above - lower.begin() - 2));
        }
    }
};

} // namespace

float srgbToLinear(float encoded) {
    return static_cast<float>(decode(static_cast<double>(encoded)));
}

float linearToSrgb(float linear) {
    const float magnitude = std::abs(linear);
    const float encoded = magnitude <= 0.0031308f
                              ? magnitude * 12.92f
                              : 1.055f * std::pow(magnitude, 1.0f / 2.4f) - 0.055f;
    return std::copysign(encoded, linear);
}

const std::array<float, 256>& srgbTable8() {
    static const std::array<float, 256> table = [] {
        std::array<float, 256> values{};
        for (std::size_t k = 0; k < values.size(); ++k)
            values[k] = static_cast<float>(decode(static_cast<double>(k) / 255.0));
        return values;
    }();
    return table;
}

const std::array<float, 65536>& srgbTable16() {
    static const auto table = [] {
        auto values = std::make_unique<std::array<float, 65536>>();
        for (std::size_t k = 0; k < values->size(); ++k)
            (*values)[k] = static_cast<float>(decode(static_cast<double>(k) / 65535.0));
        return values;
    }();
    return *table;
}

std::uint8_t linearToSrgb8(float linear) {
    static const Thresholds thresholds;
    if (!(linear > 0.0f))
        return 0;
    if (linear >= 1.0f)
        return 255;
    std::size_t code =
        thresholds
            .guess[static_cast<std::size_t>(std::sqrt(linear) * static_cast<float>(kGuesses - 1))];
    while (code < 255 && linear >= thresholds.lower[code + 1])
        ++code;
    return static_cast<std::uint8_t>(code);
}

} // namespace patina
