#include "core/bake/Bake.h"

#include "core/bake/transfer/Passes.h"

namespace patina {

BakeRequest normalized(BakeRequest request) {
    // What is out of range is refused when the bake starts.
    if (const Result<int> samples = roundSamples(request.ao.samples))
        request.ao.samples = *samples;
    if (const Result<int> samples = roundSamples(request.prt.samples, request.prt.method))
        request.prt.samples = *samples;
    return request;
}

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
