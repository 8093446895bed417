// The engine of every bake: passes of 32, 64, 128 … rays over all points, each pass doubling what
// the last one knew; to a tolerance, the last passes go where they are needed only.
#pragma once

#include "core/bake/domain/BakePoints.h"
#include "core/bake/domain/BakeRequest.h"
#include "core/bake/domain/TileSink.h"
#include "core/base/Result.h"
#include "core/job/JobContext.h"
#include "core/trace/RayScene.h"

#include <algorithm>
#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

namespace patina {

// Which ranges to compute: those of index r with r % count == index. The parts of all indices
// together are, bit for bit, the whole.
struct PassShard {
    int index = 0, count = 1;
    [[nodiscard]] bool holds(std::size_t range) const {
        return range % static_cast<std::size_t>(count) == static_cast<std::size_t>(index);
    }
    friend bool operator==(const PassShard&, const PassShard&) = default;
};

struct PassSettings {
    int samples = 256;        // Stratified: a square; else a power of two
    int shOrder = 0;          // 0: ambient visibility; 1…8: transfer coefficients
    bool unshadowed = false;  // transfer of open surfaces: by openPasses(), without a ray
    float maxDistance = 0.0f; // scene units; 0: unlimited
    std::uint32_t seed = 0;
    SampleMethod method = SampleMethod::Qmc; // Stratified makes one pass of all samples
    float tolerance = 0.0f; // RMS error of the points at which to end; 0: never before all samples
    int cluster = 0;        // points that share directions: 1…1024; 0: as fits the scene's size
    PassShard shard;
    // Index of the first point among those of the whole bake, which decides its directions: where
    // some are traced at a time, they see what they would see with the others.
    std::uint32_t firstPoint = 0;
    [[nodiscard]] int stride() const { return shOrder == 0 ? 1 : shOrder * shOrder; }
};

// How far a bake has come; what a checkpoint holds. Between ranges it may be copied, kept and gone
// on from at any time: the outcome is bit for bit the same. Points of other shards stay zero.
struct PassState {
    std::vector<float> values;        // stride() per point: means over the rays so far; of a light
                                      // map its sums (core/bake/lightmap/LightMapTexel.h), and of
                                      // the rest `passes` alone
    std::vector<float> hiddenSky;     // transfer: 1 per point, the share of rays (density cos / pi)
                                      // that went up (+Y) and met something
    std::vector<float> error;         // 1 per point: estimated standard error of a value, RMS over
                                      // them; 0 while a first pass or Stratified cannot tell
    std::vector<std::uint8_t> passes; // 1 per point: passes its values rest on
    std::vector<std::uint8_t> wanted; // 1 per point: passes decided on; the pass in flight has
                                      // reached the points whose two numbers agree
    int samplesDone = 0;              // rays that the values of every point rest on, or more
    friend bool operator==(const PassState&, const PassState&) = default;
};

// The share of light that arrives of an environment that is uniform above the horizon (+Y) and
// black below; they light an open surface of normal n by (1 + n.y) / 2 of what uniform ones would.
[[nodiscard]] inline float skyShare(float hiddenSky, const glm::vec3& normal) {
    const float open = 0.5f * (1.0f + normal.y);
    return open > 1e-6f ? std::clamp(1.0f - hiddenSky / open, 0.0f, 1.0f) : 1.0f;
}

struct PassCallbacks {
    // Values of a range after the pass in flight, from the pool's threads.
    std::function<void(const PointRange&, std::span<const float>)> range;
    std::function<void(int samples)> passDone;
    // Asked before each pass, in the space of the points; may be empty
    // (core/bake/transfer/WorkOrder.h).
    std::function<std::optional<BakeView>()> view;
    // Called from one of the pool's threads about every `checkpointSeconds` at a moment when the
    // state may be kept; threads that finish a range meanwhile wait until it returns. Called once
    // more, by the caller's thread, when the job was cancelled.
    std::function<void(const PassState&)> checkpoint;
    double checkpointSeconds = 30.0;
};

// `ranges` cover the points. Starts from nothing or from what a state of the same points, ranges
// and settings has. A stop returns what there is, every point with at least one pass. Errors:
// Cancelled.
Result<PassState> runPasses(const RayScene& scene, std::span<const BakePoint> points,
                            std::span<const PointRange> ranges, const PassSettings& settings,
                            const PassCallbacks& callbacks, const JobContext& job,
                            PassState state = {});

// The transfer of surfaces that nothing shades (PassSettings::unshadowed), in closed form.
// Errors: Cancelled.
Result<PassState> openPasses(std::span<const BakePoint> points, std::span<const PointRange> ranges,
                             const PassSettings& settings, const PassCallbacks& callbacks,
                             const JobContext& job);

// Errors (Usage) unless 1 <= samples <= 65536; rounds up to a power of two, for Stratified to a
// square.
Result<int> roundSamples(int samples, SampleMethod method = SampleMethod::Qmc);

} // namespace patina
