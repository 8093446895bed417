#include "app/cli/RenderSequence.h"

#include "app/cli/PictureSetup.h"
#include "app/cli/RenderViews.h"
#include "app/cli/Report.h"
#include "core/base/AtomicFile.h"
#include "core/document/Snapshot.h"
#include "core/image/Channels.h"
#include "core/io/VideoWriter.h"
#include "core/light/Light.h"
#include "core/material/Material.h"

#include <fmt/format.h>
#include <memory>
#include <utility>

namespace patina::cli {

Result<std::optional<SequenceRequest>> sequenceRequest(const RenderOptions& options) {
    const bool video = !options.output.empty() && isVideoFile(options.output);
    if (options.turntable == 0 && options.lightTurn == 0) {
        if (video)
            return usageError("a video shows pictures that follow each other: add --turntable N or "
                              "--light-turn N");
        return std::optional<SequenceRequest>();
    }
    if (options.turntable > 0 && options.lightTurn > 0)
        return usageError("--turntable and --light-turn exclude each other");
    if (!options.inspect.empty() || wantsAllViews(options))
        return usageError("--turntable and --light-turn draw one view in each picture: leave out "
                          "--inspect and --view all");
    if (options.output.empty())
        return usageError("--output is required: where the pictures go");
    if (video)
        if (const auto program = videoProgram(); !program)
            return program.error();
    return std::optional(options.turntable > 0
                             ? SequenceRequest{Turning::Camera, options.turntable}
                             : SequenceRequest{Turning::Environment, options.lightTurn});
}

Result<void> renderSequence(Session& session, const RenderOptions& options,
                            const SequenceRequest& request, const Document& document,
                            render::SceneRenderer& scene, render::ViewRenderer& renderer,
                            render::FrameSettings frame, ImageFileFormat format) {
    std::unique_ptr<VideoWriter> video;
    if (isVideoFile(options.output)) {
        Result<std::unique_ptr<VideoWriter>> created =
            VideoWriter::create(options.output, frame.width, frame.height, options.framesPerSecond);
        if (!created)
            return created.error();
        video = std::move(*created);
    }
    const bool linear = video == nullptr && isLinear(format);
    session.beginPhase();
    for (int i = 0; i < request.count; ++i) {
        session.job().setActivity(fmt::format("drawing picture {} of {}", i + 1, request.count));
        session.job().setProgress(static_cast<double>(i) / request.count);
        if (session.job().cancelled())
            return Error{ErrorKind::Cancelled,
                         video || i == 0 ? "cancelled"
                                         : fmt::format("cancelled: {} of {} pictures are written",
                                                       i, request.count),
                         {},
                         {}};
        const Result<Document> shown =
            documentOf(document, sequenceCell(document, request.turning, i, request.count));
        if (!shown)
            return shown.error();
        scene.setDocument(*shown);
        frame.camera = shown->view.camera;
        if (Result<void> drawn = renderer.render(frame, 0); !drawn)
            return drawn;
        Image picture = linear ? renderer.readLinear() : renderer.readDisplayed();
        if (video) {
            if (Result<void> added = video->add(withoutAlpha(picture)); !added)
                return added;
            continue;
        }
        std::vector<ImagePart> parts(1);
        parts[0].image = frame.transparentBackground ? std::move(picture) : withoutAlpha(picture);
        if (Result<void> written =
                writePictures(session, sequenceFile(options.output, i), std::move(parts), format);
            !written)
            return written;
    }
    if (!video)
        return {};
    session.job().setActivity("writing the video");
    if (Result<void> finished = video->finish(); !finished)
        return finished;
    session.report().output(
        options.output, fmt::format("video of {} pictures, {} × {}, {} per second", request.count,
                                    frame.width, frame.height, options.framesPerSecond));
    return {};
}

} // namespace patina::cli
