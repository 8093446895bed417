// Pictures that are traced in place of drawn: their options, as `patina render` and `patina sheet`
// have them.
#pragma once

#include "app/cli/Options.h"
#include "core/base/Result.h"
#include "core/trace/whitted/WhittedSettings.h"

#include <cstddef>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>

namespace patina::cli {

inline constexpr int kMostPaths = 1 << 20; // per pixel
inline constexpr int kUsualPaths = 256;
inline constexpr int kUsualRays = 64; // per pixel, of stochastic Whitted settings

[[nodiscard]] bool isTraced(const TracingOptions& options);
[[nodiscard]] bool isWhitted(const TracingOptions& options);
// Usage errors: what rays do not have, or only they have.
Result<void> checkTracing(const TracingOptions& options);

[[nodiscard]] WhittedSettings whittedSettings(const TracingOptions& options);
[[nodiscard]] const char* whittedModelName(LocalModel model); // of --whitted-model
[[nodiscard]] nlohmann::ordered_json describeWhitted(const WhittedSettings& settings);

// Of a pixel, at most, and what they are called: "paths".
[[nodiscard]] std::uint32_t samplesOf(const TracingOptions& options);
[[nodiscard]] const char* unitOf(const TracingOptions& options);

// Usage error where the memory that is free is less than `bytesPerPixel` of such a picture.
Result<void> checkTracingMemory(int width, int height, std::size_t bytesPerPixel);

} // namespace patina::cli
