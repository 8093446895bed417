#include "core/bake/BakeTracer.h"

namespace patina {

Result<std::optional<PassState>> tracePoints(BakeTracer* tracer, const TraceRequest& request) {
    if (tracer != nullptr)
        return tracer->trace(request);
    Result<PassState> state = runPasses(request.scene, request.points, request.ranges,
                                        request.settings, request.callbacks, request.job);
    if (!state)
        return state.error();
    return std::optional(std::move(state).value());
}

} // namespace patina
