// In which order a bake visits its points: first what whoever waits for it can see. Changes when
// results come, never what they are.
#pragma once

#include "core/bake/transfer/Passes.h"
#include "core/trace/BakeGeometry.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace patina {

// The world's view in the space of the scene's points.
[[nodiscard]] std::optional<BakeView> toSceneUnits(const std::optional<BakeView>& view,
                                                   const BakeGeometry& geometry);

// Indices of `ranges`, each once: in the picture and turned to the eye, then in the picture, then
// the rest; among equals as they stand. A few points of a range speak for it.
[[nodiscard]] std::vector<std::uint32_t> workOrder(std::span<const BakePoint> points,
                                                   std::span<const PointRange> ranges,
                                                   const std::optional<BakeView>& view);

} // namespace patina
