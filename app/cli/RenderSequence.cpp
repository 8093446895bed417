#include "app/cli/RenderSequence.h"

#include "app/cli/CacheFolders.h"
#include "app/cli/RenderViews.h"
#include "app/cli/Report.h"
#include "core/cells/SequenceWriter.h"
#include "core/io/VideoWriter.h"
#include "render/SequenceRenderer.h"

#include <fmt/format.h>
#include <memory>
#include <string>
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
                            const render::FrameSettings& frame) {
    const bool video = isVideoFile(options.output);
    const Result<std::unique_ptr<SequenceWriter>> writer = SequenceWriter::create(
        session.worker(), {options.output, frame.width, frame.height, options.framesPerSecond,
                           frame.transparentBackground});
    if (!writer)
        return writer.error();
    session.beginPhase();
    const std::string size = fmt::format("{} × {}", frame.width, frame.height);
    const auto take = [&](Image picture) -> Result<void> {
        const auto written = (*writer)->add(std::move(picture), session.job());
        if (!written)
            return written.error();
        if (*written)
            session.report().output(**written, size + " pixels");
        return {};
    };
    render::SequenceSettings settings;
    settings.turning = request.turning;
    settings.count = request.count;
    settings.linear = (*writer)->isLinear();
    settings.solutions = radiosityCache();
    if (Result<void> drawn =
            render::drawSequence(scene, renderer, document, frame, settings, take, session.job());
        !drawn) {
        Error error = drawn.error();
        if (error.kind == ErrorKind::Cancelled && (*writer)->written() > 0)
            error.message = fmt::format("cancelled: {} of {} pictures are written",
                                        (*writer)->written(), request.count);
        return error;
    }
    if (video)
        session.job().setActivity("writing the video");
    if (Result<void> finished = (*writer)->finish(session.job()); !finished)
        return finished;
    if (video)
        session.report().output(options.output,
                                fmt::format("video of {} pictures, {}, {} per second",
                                            request.count, size, options.framesPerSecond));
    return {};
}

} // namespace patina::cli
