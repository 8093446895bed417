#include "core/bake/domain/BakeStorage.h"

#include "core/base/Check.h"
#include "core/image/FloatTexture.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <glm/gtc/packing.hpp>

namespace patina {
namespace {

constexpr std::pair<BakeStorage, const char*> kNames[] = {{BakeStorage::Float, "float"},
                                                          {BakeStorage::Half, "half"},
                                                          {BakeStorage::Quantised, "quantised"}};
constexpr float kMaxHalf = 65504.0f;

// Calls use(value, band) for every number.
template <class Values, class Use>
void forEachBand(Values values, int order, int colors, const Use& use) {
    const auto stride = static_cast<std::size_t>(order) * static_cast<std::size_t>(order) *
                        static_cast<std::size_t>(colors);
    CHECK_EQ(values.size() % stride, 0u);
    for (std::size_t element = 0; element < values.size(); element += stride) {
        std::size_t i = element;
        for (std::size_t l = 0; l < static_cast<std::size_t>(order); ++l)
            for (std::size_t n = 0; n < (2 * l + 1) * static_cast<std::size_t>(colors); ++n)
                use(values[i++], l);
    }
}

void addErrors(StorageError& error, std::span<const float> exact, int order, int colors,
               const BakeFileOptions& options) {
    std::vector<float> stored(exact.begin(), exact.end());
    if (options.storage == BakeStorage::Half) {
        for (float& value : stored)
            value = roundedToHalf(value);
    } else if (options.storage == BakeStorage::Quantised) {
        const std::vector<float> steps = bandSteps(exact, order, colors, options.bits);
        quantise(stored, order, colors, steps);
        dequantise(stored, order, colors, steps);
    }
    for (std::size_t i = 0; i < stored.size(); ++i)
        error.add(exact[i], stored[i]);
}

} // namespace

const char* storageName(BakeStorage storage) {
    return kNames[static_cast<std::size_t>(storage)].second;
}

std::optional<BakeStorage> storageNamed(const std::string& name) {
    for (const auto& [storage, known] : kNames)
        if (name == known)
            return storage;
    return std::nullopt;
}

void StorageError::add(float exact, float stored) {
    const double difference = static_cast<double>(stored) - static_cast<double>(exact);
    sumOfSquares += difference * difference;
    reference += static_cast<double>(exact) * static_cast<double>(exact);
    largest = std::max(largest, std::abs(difference));
    ++count;
}

double StorageError::rms() const {
    return count == 0 ? 0.0 : std::sqrt(sumOfSquares / static_cast<double>(count));
}

double StorageError::relative() const {
    return reference == 0.0 ? 0.0 : std::sqrt(sumOfSquares / reference);
}

StorageError storageError(std::span<const float> values, std::span<const float> bounced, int order,
                          const BakeFileOptions& options) {
    StorageError error;
    addErrors(error, values, order, 1, options);
    addErrors(error, bounced, order, 3, options);
    return error;
}

StorageError storageError(const BakeArtifact& artifact, const BakeFileOptions& options) {
    StorageError error;
    const int order = std::max(artifact.order, 1);
    const auto add = [&](const auto& bake) {
        addErrors(error, bake.values, order, 1, options);
        addErrors(error, bake.bounced, order, 3, options);
    };
    for (const VertexBake& bake : artifact.vertices)
        add(bake);
    for (const TexelBake& bake : artifact.texels) {
        add(bake);
        if (bake.image)
            addErrors(error, bake.image->f32(), 1, 1, options);
    }
    return error;
}

std::string storageErrorText(const StorageError& error) {
    return fmt::format("RMS error {:.2g} ({:.2g} % of the values' RMS), largest {:.2g}",
                       error.rms(), 100.0 * error.relative(), error.largest);
}

float roundedToHalf(float value) {
    return glm::unpackHalf1x16(halfFromFloat(std::clamp(value, -kMaxHalf, kMaxHalf)));
}

std::vector<float> bandSteps(std::span<const float> values, int order, int colors, int bits) {
    CHECK(bits >= kMinStorageBits && bits <= kMaxStorageBits);
    std::vector<float> steps(static_cast<std::size_t>(order), 0.0f);
    forEachBand(values, order, colors, [&](float value, std::size_t band) {
        steps[band] = std::max(steps[band], std::abs(value));
    });
    const auto most = static_cast<float>((1 << (bits - 1)) - 1);
    for (float& step : steps)
        step /= most;
    return steps;
}

void quantise(std::span<float> values, int order, int colors, std::span<const float> steps) {
    forEachBand(values, order, colors, [&](float& value, std::size_t band) {
        value = steps[band] > 0.0f ? std::nearbyint(value / steps[band]) : 0.0f;
    });
}

void dequantise(std::span<float> values, int order, int colors, std::span<const float> steps) {
    forEachBand(values, order, colors,
                [&](float& value, std::size_t band) { value *= steps[band]; });
}

} // namespace patina
