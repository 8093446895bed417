// The engine of every bake: passes of 32, 64, 128 … rays over all points, each pass doubling what
// the last one knew.
#pragma once

#include "core/bake/RayScene.h"
#include "core/base/Result.h"
#include "core/job/JobContext.h"

#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace patina {

// Where rays start and the middle of the hemisphere they fill.
struct BakePoint {
    glm::vec3 origin; // scene units, already lifted off the surface
    glm::vec3 normal; // unit
};

// Points that are computed and reported together.
struct PointRange {
    std::size_t first = 0, count = 0;
};

struct PassSettings {
    int samples = 256;        // a power of two
    int shOrder = 0;          // 0: ambient visibility; 1…5: transfer coefficients
    float maxDistance = 0.0f; // scene units; 0: unlimited
    std::uint32_t seed = 0;
    [[nodiscard]] int stride() const { return shOrder == 0 ? 1 : shOrder * shOrder; }
};

struct PassCallbacks {
    // Values of a range after the pass in flight, from the pool's threads.
    std::function<void(const PointRange&, std::span<const float>)> range;
    std::function<void(int samples)> passDone;
};

struct PassResult {
    std::vector<float> values; // stride() per point
    int samplesDone = 0;
};

// `ranges` cover the points. A stop returns the last complete pass, at least the first. Errors:
// Cancelled.
Result<PassResult> runPasses(const RayScene& scene, std::span<const BakePoint> points,
                             std::span<const PointRange> ranges, const PassSettings& settings,
                             const PassCallbacks& callbacks, const JobContext& job);

// Errors (Usage) unless 1 <= samples <= 65536; rounds up to a power of two.
Result<int> roundSamples(int samples);

} // namespace patina
