// A bake as it is asked for: what, and with which settings. bake() runs any of them.
#pragma once

#include "core/bake/Bake.h"

namespace patina {

struct BakeRequest {
    BakeKind kind = BakeKind::PrtVertex;
    AoSettings ao;   // for the kinds of ambient occlusion
    PrtSettings prt; // for transfer
};

// Settings as a bake keeps them: rays rounded to what is traced.
[[nodiscard]] BakeRequest normalized(BakeRequest request);

// Errors: those of the kind's own function (core/bake/Bake.h).
Result<BakeArtifact> bake(const BakeRequest& request, const BakeInputs& inputs, TileSink& sink,
                          const JobContext& job, BakeTracer* tracer = nullptr);

} // namespace patina
