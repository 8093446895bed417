// Bakes the error of image-based light away: what paths bring to the texels of all materials,
// against what the viewport's image-based light has there (docs/maths/light-map.md).
#pragma once

#include "core/bake/domain/BakeArtifact.h"
#include "core/bake/domain/BakeRequest.h"
#include "core/base/Result.h"
#include "core/job/JobContext.h"
#include "core/light/EnvironmentLookup.h"
#include "core/trace/path/TraceInputs.h"

namespace patina {

class BakeTracer;

struct LightMapInputs {
    TraceInputs scene;
    Hash geometry; // hashBakeInputs() of the same meshes, which becomes BakeArtifact::inputs
    // The environment as image-based light has it; without maps: none lights the scene.
    EnvironmentLookup imageLight;
};

// Passes of 8, 16, 32 … samples over all texels; the same numbers for any number of threads.
// stop() keeps the samples that there are, cancel() returns ErrorKind::Cancelled.
// `tracer`: how texels are traced when not here and now; of a part the artifact has no texels.
// Errors: InputBroken for a scene without triangles or a mesh without texture coordinates; Usage
// for settings out of range; those of TraceScene::build() and of `tracer`.
Result<BakeArtifact> bakeLightMap(const LightMapInputs& inputs, const LightMapSettings& settings,
                                  const JobContext& job, BakeTracer* tracer = nullptr);

// BakeArtifact::light of a scene. Reads all texels.
[[nodiscard]] Hash hashLightMapLight(const TraceInputs& scene);

} // namespace patina
