// How the points of a bake come to know what they see: by tracing them all, or, for those who split
// a bake, keep checkpoints or join parts, in a way of their own.
#pragma once

#include "core/bake/transfer/Passes.h"

#include <cstddef>
#include <functional>
#include <optional>
#include <span>

namespace patina {

// The arguments of runPasses().
struct TraceRequest {
    const RayScene& scene;
    std::span<const BakePoint> points;
    std::span<const PointRange> ranges;
    const PassSettings& settings;
    const PassCallbacks& callbacks;
    const JobContext& job;
};

// Passes over points, whatever it is that they compute.
struct PassWork {
    std::size_t points = 0;
    std::span<const PointRange> ranges; // cover the points
    int stride = 1;                     // values per point
    int samples = 1;                    // of each point, of all passes together
    int passes = 1;                     // each but the first doubles the samples that there are
    const PassCallbacks& callbacks;
    const JobContext& job;
    // The shard's ranges, as runPasses() does it: from nothing or from where a state is, with these
    // callbacks.
    std::function<Result<PassState>(const PassShard&, const PassCallbacks&, PassState)> run;
};

class BakeTracer {
  public:
    virtual ~BakeTracer() = default;
    // The state of all points; nothing when only a part of them was to be computed. The bake then
    // ends with an artifact that has no elements.
    virtual Result<std::optional<PassState>> trace(const PassWork& work) = 0;
};

// With `tracer`, or all of it here and now without.
Result<std::optional<PassState>> tracePasses(BakeTracer* tracer, const PassWork& work);
// The same, by runPasses().
Result<std::optional<PassState>> tracePoints(BakeTracer* tracer, const TraceRequest& request);

// The same of a state that is always of all points.
[[nodiscard]] Result<std::optional<PassState>> passesOrNothing(Result<PassState> state);

// Fills in what the values rest on; called when tracing has ended.
void noteRays(BakeArtifact& artifact, const PassState& state, const PassSettings& settings,
              const JobContext& job);

} // namespace patina
