#include "core/bake/transfer/BakeTracer.h"

namespace patina {

Result<std::optional<PassState>> tracePoints(BakeTracer* tracer, const TraceRequest& request) {
    if (tracer != nullptr)
        return tracer->trace(request);
    return passesOrNothing(runPasses(request.scene, request.points, request.ranges,
                                     request.settings, request.callbacks, request.job));
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
