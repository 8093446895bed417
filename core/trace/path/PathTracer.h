// A picture as light makes it: paths from the camera from surface to surface, without bias. What a
// surface reflects is what the viewport's shaders say (shaders/shared); all that is added here is
// where the light comes from. Formulas and sources: docs/maths/path-tracing.md.
#pragma once

#include "core/base/Result.h"
#include "core/job/JobContext.h"
#include "core/math/Camera.h"
#include "core/trace/path/Film.h"
#include "core/trace/path/TraceScene.h"
#include "core/trace/path/TraceTiles.h"

#include <atomic>
#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <optional>

namespace patina {

// How light is looked for at each surface.
enum class LightSearch {
    Both,     // rays to lights and rays of the reflection, each weighted by how well it does there
    Lights,   // to lights alone, and what is bright without being one
    Surfaces, // by the reflection alone; lights without extent are found by no ray, and stay
};

struct PathSettings {
    std::optional<int> maxBounces; // on surfaces after the one that is seen; nothing: no limit
    std::uint32_t seed = 0;
    LightSearch search = LightSearch::Both;
};

struct TraceView {
    Camera camera;
    int width = 0, height = 0;
    // What is seen in a direction of the world where there is no surface; empty: the environment.
    std::function<glm::vec3(const glm::vec3& direction)> background;
    bool transparent = false; // there: black, and without coverage
};

// Rays that were cast, to surfaces and to lights.
struct TraceRays {
    std::atomic<std::uint64_t> count{0};
};

// Adds samples `first` … `first` + `count` - 1 to each pixel of a film of the view's size. The same
// numbers for any number of threads, and for samples that are added in several calls in order: a
// pixel that has some of them already gets those that it lacks. A job that stops leaves rows of
// pixels out. Error: Cancelled. The job's work is counted in rays.
Result<void> tracePaths(const TraceScene& scene, const TraceView& view,
                        const PathSettings& settings, Film& film, std::uint32_t first,
                        std::uint32_t count, const JobContext& job, TraceRays* rays = nullptr,
                        const TraceTiles& tiles = {});

// Irradiance of a surface in the world with that unit normal: `count` samples of it go into
// `pixel`. The settings' seed tells points apart.
void traceIrradiance(const TraceScene& scene, const glm::dvec3& position, const glm::vec3& normal,
                     const PathSettings& settings, std::uint32_t count, Film::Pixel& pixel);

} // namespace patina
