#include "render/SequenceRenderer.h"

#include "core/document/Snapshot.h"
#include "core/light/Light.h"
#include "core/material/Material.h"
#include "render/FollowedRadiosity.h"
#include "render/SceneRenderer.h"
#include "render/ViewRenderer.h"

#include <cmath>
#include <fmt/format.h>
#include <utility>

namespace patina::render {
namespace {

Error cancelledSequence() {
    return {ErrorKind::Cancelled, "cancelled", {}, {}};
}

Result<void> drawPicture(ViewRenderer& renderer, const FrameSettings& settings, double sliceMs,
                         const JobContext& job) {
    const FrameSettings frame = withDepthOfField(settings);
    do {
        for (bool complete = std::isinf(sliceMs); !complete;) {
            if (job.cancelled())
                return cancelledSequence();
            job.giveWay();
            const Result<bool> prepared = renderer.prepare(frame, sliceMs, -1.0);
            if (!prepared)
                return prepared.error();
            complete = *prepared;
        }
        if (job.cancelled())
            return cancelledSequence();
        if (Result<void> drawn = renderer.render(frame, ViewRenderer::kNowhere); !drawn)
            return drawn;
    } while (!renderer.isSteady());
    return {};
}

} // namespace

Result<void> drawSequence(SceneRenderer& scene, ViewRenderer& renderer, const Document& document,
                          FrameSettings frame, const SequenceSettings& settings,
                          const std::function<Result<void>(Image picture)>& take,
                          const JobContext& job) {
    FollowedRadiosity radiosity(settings.solutions);
    for (int i = 0; i < settings.count; ++i) {
        job.setActivity(fmt::format("drawing picture {} of {}", i + 1, settings.count));
        job.setProgress(static_cast<double>(i) / settings.count);
        if (job.cancelled())
            return cancelledSequence();
        const Result<Document> shown =
            documentOf(document, sequenceCell(document, settings.turning, i, settings.count));
        if (!shown)
            return shown.error();
        scene.setDocument(*shown);
        if (Result<void> solved = radiosity.update(scene, *shown, frame.view, job.part(0.0, 0.0));
            !solved)
            return solved;
        frame.camera = shown->view.camera;
        if (Result<void> drawn = drawPicture(renderer, frame, settings.sliceMs, job); !drawn)
            return drawn;
        Image picture = settings.linear ? renderer.readLinear() : renderer.readDisplayed();
        if (Result<void> taken = take(std::move(picture)); !taken)
            return taken;
    }
    return {};
}

} // namespace patina::render
