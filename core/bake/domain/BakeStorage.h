// How precisely a bake's numbers are kept in a file, and what that costs.
#pragma once

#include "core/bake/domain/BakeArtifact.h"

#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace patina {

enum class BakeStorage {
    Float,    // 32 bits: exact
    Half,     // 16-bit floats
    Quantised // transfer: whole multiples of a step of its own for every band
};

struct BakeFileOptions {
    BakeStorage storage = BakeStorage::Float;
    int bits = 8; // Quantised: of a coefficient with its sign, 4…12
    friend bool operator==(const BakeFileOptions&, const BakeFileOptions&) = default;
};

inline constexpr int kMinStorageBits = 4, kMaxStorageBits = 12; // halves count exactly to 2048

[[nodiscard]] const char* storageName(BakeStorage storage); // "float", "half", "quantised"
[[nodiscard]] std::optional<BakeStorage> storageNamed(const std::string& name);

// Differences between what is stored and what was computed, over the coefficients of transfer
// (direct and bounced together) or over the values of ambient occlusion.
struct StorageError {
    double sumOfSquares = 0.0, reference = 0.0; // of the differences, of the values
    double largest = 0.0;
    std::size_t count = 0;

    void add(float exact, float stored);
    [[nodiscard]] double rms() const;
    [[nodiscard]] double relative() const; // rms over the values' own, 0 when all are 0
};

// What `options` makes of the artifact when it is written and read again.
[[nodiscard]] StorageError storageError(const BakeArtifact& artifact,
                                        const BakeFileOptions& options);
[[nodiscard]] StorageError storageError(std::span<const float> values,
                                        std::span<const float> bounced, int order,
                                        const BakeFileOptions& options);
[[nodiscard]] std::string storageErrorText(const StorageError& error); // "RMS error 1.2e-4 (…)"

// The float that a half keeps of it: nearest, even on a tie; beyond ±65504 the largest.
[[nodiscard]] float roundedToHalf(float value);

// One step for every band, so that the band's largest value is the largest whole number of `bits`;
// 0 for a band of zeros. `values`: `colors` (1 or 3) numbers for each of order² coefficients,
// element after element.
[[nodiscard]] std::vector<float> bandSteps(std::span<const float> values, int order, int colors,
                                           int bits);
// value / step to the nearest whole number, and back.
void quantise(std::span<float> values, int order, int colors, std::span<const float> steps);
void dequantise(std::span<float> values, int order, int colors, std::span<const float> steps);

} // namespace patina
