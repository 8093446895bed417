// Bakes are functions: they copy what they need, hold no document, write no files and touch no
// threads but the pool's. Results do not depend on the number of threads.
#pragma once

#include "core/bake/domain/BakeHash.h"
#include "core/bake/domain/BakeRequest.h"
#include "core/bake/domain/TileSink.h"
#include "core/base/Result.h"
#include "core/job/JobContext.h"
#include "core/trace/BakeInputs.h"

namespace patina {

class BakeTracer;

// Passes of 32, 64, … rays over all elements. stop() keeps what there is, every element with
// samplesDone rays or more; cancel() returns ErrorKind::Cancelled within 0.5 s.
// Errors: InputBroken for a scene without triangles; Internal when Embree refuses memory.
// `tracer`: how points are traced when not here and now (core/bake/transfer/BakeTracer.h).
Result<BakeArtifact> bakeAoTexel(const BakeInputs& inputs, const AoSettings& settings,
                                 TileSink& sink, const JobContext& job,
                                 BakeTracer* tracer = nullptr);
Result<BakeArtifact> bakeAoVertex(const BakeInputs& inputs, const AoSettings& settings,
                                  TileSink& sink, const JobContext& job,
                                  BakeTracer* tracer = nullptr);
Result<BakeArtifact> bakePrtVertex(const BakeInputs& inputs, const PrtSettings& settings,
                                   TileSink& sink, const JobContext& job,
                                   BakeTracer* tracer = nullptr);
// The transfer of every texel of every material's UV layout; also an error (InputBroken) for meshes
// without texture coordinates.
Result<BakeArtifact> bakePrtTexel(const BakeInputs& inputs, const PrtSettings& settings,
                                  TileSink& sink, const JobContext& job,
                                  BakeTracer* tracer = nullptr);

// Settings as a bake keeps them: rays rounded to what is traced.
[[nodiscard]] BakeRequest normalized(BakeRequest request);

// Errors: those of the kind's own function.
Result<BakeArtifact> bake(const BakeRequest& request, const BakeInputs& inputs, TileSink& sink,
                          const JobContext& job, BakeTracer* tracer = nullptr);

} // namespace patina
