// The terms of a picture under image-based light as pictures of their own, over no background: what
// blame holds against traced ones (core/trace/blame/BlameSteps.h). All calls need the scene's
// context to be current, on one thread.
#pragma once

#include "core/base/Result.h"
#include "core/job/JobContext.h"
#include "core/trace/blame/BlameSteps.h"
#include "render/WallRenderer.h"

namespace patina::render {

class SceneRenderer;

// `unoccluded`: the document without occlusion, in LightingMode::Ibl; its frames accumulate. Sets
// diffuse, specular and direct of `terms`. Errors: Internal from the driver, Cancelled.
Result<void> drawTerms(WallRenderer& cells, SceneRenderer& scene, CellView unoccluded,
                       DrawnTerms& terms, const JobContext& job);

// A picture as fine as it gets; linear RGBA. The same errors.
Result<Image> drawFinePicture(WallRenderer& cells, SceneRenderer& scene, const CellView& cell,
                              const JobContext& job);

} // namespace patina::render
