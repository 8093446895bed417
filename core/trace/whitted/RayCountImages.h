// What pixels of a classically traced picture took, as images: heat maps.
#pragma once

#include "core/base/Result.h"
#include "core/image/Image.h"
#include "core/trace/whitted/WhittedTracer.h"

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

namespace patina {

enum class RayCountKind { Rays, Depth, BoxTests, TriangleTests, TriangleTestsWithout };

struct RayCountInfo {
    RayCountKind kind;
    std::string_view id;    // as in files and options: "boxTests"
    std::string_view label; // "Boxes tested"
};

[[nodiscard]] std::span<const RayCountInfo> rayCountInfos(); // in the order of files

// "all", or names separated by commas, in any order; "beauty" may be among them. Usage error naming
// those that there are.
Result<std::vector<const RayCountInfo*>> parseRayCounts(std::string_view text);
// Whether any of them needs a hierarchy that counts.
[[nodiscard]] bool needHierarchy(std::span<const RayCountInfo* const> chosen);

// F32, one channel Y; of all samples that each pixel is made of. `triangles`: of the scene, which
// every ray would test without a hierarchy.
[[nodiscard]] Image rayCountImage(RayCountKind kind, const RayCountMap& map, int width, int height,
                                  std::size_t triangles);

} // namespace patina
