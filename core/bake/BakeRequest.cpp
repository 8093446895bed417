#include "core/bake/BakeRequest.h"

namespace patina {

Result<BakeArtifact> bake(const BakeRequest& request, const BakeInputs& inputs, TileSink& sink,
                          const JobContext& job, BakeTracer* tracer) {
    switch (request.kind) {
    case BakeKind::AoTexel:
        return bakeAoTexel(inputs, request.ao, sink, job, tracer);
    case BakeKind::AoVertex:
        return bakeAoVertex(inputs, request.ao, sink, job, tracer);
    case BakeKind::PrtTexel:
        return bakePrtTexel(inputs, request.prt, sink, job, tracer);
    case BakeKind::PrtVertex:
        break;
    }
    return bakePrtVertex(inputs, request.prt, sink, job, tracer);
}

} // namespace patina
