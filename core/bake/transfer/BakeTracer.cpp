#include "core/bake/transfer/BakeTracer.h"

#include <utility>

namespace patina {

namespace {

// The first has 32 rays, each further one doubles them.
int passCount(const PassSettings& settings) {
    int passes = 1;
    if (settings.method != SampleMethod::Stratified)
        for (int rays = 32; rays < settings.samples; rays *= 2)
            ++passes;
    return passes;
}

} // namespace

Result<std::optional<PassState>> tracePasses(BakeTracer* tracer, const PassWork& work) {
    if (tracer != nullptr)
        return tracer->trace(work);
    return passesOrNothing(work.run({}, work.callbacks, {}));
}

Result<std::optional<PassState>> tracePoints(BakeTracer* tracer, const TraceRequest& request) {
    const auto run = [&](const PassShard& shard, const PassCallbacks& callbacks, PassState state) {
        PassSettings settings = request.settings;
        settings.shard = shard;
        return runPasses(request.scene, request.points, request.ranges, settings, callbacks,
                         request.job, std::move(state));
    };
    const PassSettings& settings = request.settings;
    return tracePasses(tracer,
                       {request.points.size(), request.ranges, settings.stride(), settings.samples,
                        passCount(settings), request.callbacks, request.job, run});
}

Result<std::optional<PassState>> passesOrNothing(Result<PassState> state) {
    if (!state)
        return state.error();
    return std::optional(std::move(state).value());
}

void noteRays(BakeArtifact& artifact, const PassState& state, const PassSettings& settings,
              const JobContext& job) {
    artifact.samplesDone = state.samplesDone;
    artifact.stopped =
        job.stopping() && !settings.unshadowed && state.samplesDone < settings.samples;
}

} // namespace patina
