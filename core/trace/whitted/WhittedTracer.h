// Pictures by classical ray tracing: Whitted 1980, "An Improved Illumination Model for Shaded
// Display". Formulas and sources: docs/maths/whitted.md.
#pragma once

#include "core/base/Result.h"
#include "core/trace/path/PathTracer.h"
#include "core/trace/whitted/RayTree.h"
#include "core/trace/whitted/WhittedSettings.h"
#include "core/trace/whitted/WhittedShader.h"

#include <span>
#include <vector>

namespace patina {

// What each pixel took: of all samples that it is made of, those that it shares with its neighbours
// included.
class RayCountMap {
  public:
    RayCountMap(int width, int height)
        : m_pixels(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {}
    [[nodiscard]] std::span<RayCounts> pixels() { return m_pixels; } // row by row, 0 on top
    [[nodiscard]] std::span<const RayCounts> pixels() const { return m_pixels; }

  private:
    std::vector<RayCounts> m_pixels;
};

// Adds samples `first` … `first` + `count` - 1 to each pixel of a film of the view's size: of
// settings that are not stochastic there is one, number 0, which is the mean of an adaptively
// divided square. Otherwise as tracePaths() has it. `counts`: of the film's size, or null.
Result<void> traceWhitted(const TraceScene& scene, const TraceView& view,
                          const WhittedSettings& settings, Film& film, std::uint32_t first,
                          std::uint32_t count, const JobContext& job, TraceRays* rays = nullptr,
                          const TraceTiles& tiles = {}, RayCountMap* counts = nullptr,
                          const TeachingHierarchy* hierarchy = nullptr);

// The rays of one pixel that has `samples` samples (1 of settings that are not stochastic).
[[nodiscard]] RayTree traceRayTree(const TraceScene& scene, const TraceView& view,
                                   const WhittedSettings& settings, int x, int y,
                                   std::uint32_t samples);

} // namespace patina
