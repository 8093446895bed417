// Draws the pictures of a sequence (core/cells/Sequence.h), one after the other. All calls need the
// scene's context to be current, on one thread.
#pragma once

#include "core/base/Result.h"
#include "core/cells/Sequence.h"
#include "core/image/Image.h"
#include "core/job/JobContext.h"
#include "core/radiosity/file/SolutionCache.h"
#include "render/view/FrameSettings.h"

#include <functional>
#include <limits>
#include <optional>

namespace patina::render {

class SceneRenderer;
class ViewRenderer;

struct SequenceSettings {
    Turning turning = Turning::Camera;
    int count = 0;       // pictures, at least one
    bool linear = false; // readLinear(), else readDisplayed()
    // Slices of about so many milliseconds, between which the job is asked whether it is cancelled
    // and gives way; infinite: each picture in one piece, which takes half the memory.
    double sliceMs = std::numeric_limits<double>::infinity();
    std::optional<radiosity::SolutionCache> solutions; // as FollowedRadiosity has it
};

// `document` is what the scene holds, with its light; `frame` is how it is looked at, but for the
// camera, which is the document's. `take` is handed each picture. Leaves the scene at the last one.
// Errors: those of `take`, Internal from the driver, Cancelled.
Result<void> drawSequence(SceneRenderer& scene, ViewRenderer& renderer, const Document& document,
                          FrameSettings frame, const SequenceSettings& settings,
                          const std::function<Result<void>(Image picture)>& take,
                          const JobContext& job);

} // namespace patina::render
