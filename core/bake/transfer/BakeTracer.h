// How the points of a bake come to know what they see: by tracing them all, or, for those who split
// a bake, keep checkpoints or join parts, in a way of their own.
#pragma once

#include "core/bake/transfer/Passes.h"

#include <optional>

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

class BakeTracer {
  public:
    virtual ~BakeTracer() = default;
    // The state of all points; nothing when only a part of them was to be computed. The bake then
    // ends with an artifact that has no elements.
    virtual Result<std::optional<PassState>> trace(const TraceRequest& request) = 0;
};

// With `tracer`, or by runPasses() without.
Result<std::optional<PassState>> tracePoints(BakeTracer* tracer, const TraceRequest& request);

// The same of a state that is always of all points.
[[nodiscard]] Result<std::optional<PassState>> passesOrNothing(Result<PassState> state);

// Fills in what the values rest on; called when tracing has ended.
void noteRays(BakeArtifact& artifact, const PassState& state, const PassSettings& settings,
              const JobContext& job);

} // namespace patina
