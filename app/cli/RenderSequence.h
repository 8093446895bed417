// `patina render --turntable` and `--light-turn`: pictures that follow each other, numbered, or a
// video.
#pragma once

#include "app/cli/Session.h"
#include "core/cells/Sequence.h"
#include "render/SceneRenderer.h"
#include "render/ViewRenderer.h"

#include <optional>

namespace patina::cli {

struct SequenceRequest {
    Turning turning = Turning::Camera;
    int count = 0;
};
// What the options ask for. Usage errors: both turns, too many pictures, a video of one picture,
// together with --inspect or --view all.
[[nodiscard]] Result<std::optional<SequenceRequest>> sequenceRequest(const RenderOptions& options);

// `document` is what the scene holds, looked at through `frame`. Pictures that were written before
// an error or a cancel stay; of a video nothing does.
Result<void> renderSequence(Session& session, const RenderOptions& options,
                            const SequenceRequest& request, const Document& document,
                            render::SceneRenderer& scene, render::ViewRenderer& renderer,
                            const render::FrameSettings& frame);

} // namespace patina::cli
