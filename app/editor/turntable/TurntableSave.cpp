#include "app/editor/turntable/TurntableSave.h"

#include "app/editor/Session.h"
#include "app/editor/document/FileOnDisk.h"
#include "app/editor/document/QtText.h"
#include "core/cells/SequenceWriter.h"
#include "core/document/ViewChoices.h"
#include "core/io/VideoWriter.h"
#include "render/SceneRenderer.h"
#include "render/SequenceRenderer.h"
#include "render/ViewRenderer.h"
#include "render/gl/Context.h"

#include <QCoreApplication>
#include <QFileInfo>
#include <QMetaObject>
#include <algorithm>
#include <fmt/format.h>
#include <utility>

namespace patina::editor {
namespace {

constexpr double kPrepared = 0.1, kDrawn = 0.95; // of the progress
// Between two looks whether the job is cancelled, and whether a frame of the window waits.
constexpr double kTurntableSliceMs = 100.0;

QString trTurntable(const char* text) {
    return QCoreApplication::translate("TurntableSave", text);
}

Result<void> checkTurntable(const TurntableOrder& order, const gl::ContextInfo& info) {
    if (std::max(order.width, order.height) > info.maxTextureSize)
        return Error{ErrorKind::Usage,
                     fmt::format("{} can draw at most {} pixels a side; choose a smaller size",
                                 info.renderer, info.maxTextureSize),
                     {},
                     {}};
    if (order.samples > info.maxSamples)
        return Error{ErrorKind::Usage,
                     fmt::format("{} takes at most {} samples per pixel; choose fewer samples",
                                 info.renderer, info.maxSamples),
                     {},
                     {}};
    return {};
}

Result<void> writeTurntable(const TurntableOrder& order, SceneCopy& scene, PreparedLights& lights,
                            SequenceWriter& writer, const JobContext& job) {
    job.setActivity("preparing light");
    if (Result<void> completed = completeEnvironments(scene.document, job); !completed)
        return completed;
    const LightingMode lighting = lightingOf(
        scene.view.shown.kind, scene.view.lighting.value_or(scene.document.view.lighting));
    if (Result<void> completed = completeTransfer(scene, lighting, job); !completed)
        return completed;
    Result<EnvironmentTexelsPtr> light = lightOf(scene, lights, job);
    if (!light)
        return light.error();
    job.setProgress(kPrepared);

    const Document& document = scene.document;
    const Result<std::unique_ptr<gl::Context>> context = gl::Context::createHeadless();
    if (!context)
        return context.error();
    if (Result<void> possible = checkTurntable(order, (*context)->info()); !possible)
        return possible;
    const Result<std::unique_ptr<render::SceneRenderer>> renderer =
        render::SceneRenderer::create(**context);
    if (!renderer)
        return renderer.error();
    if (Result<void> set = (*renderer)->setDisplay(scene.display); !set)
        return set;
    (*renderer)->setDocument(document);
    if (*light)
        (*renderer)->setEnvironment(std::move(*light));
    (*renderer)->setNearShadows(scene.shadows);

    render::FrameSettings frame;
    frame.width = order.width;
    frame.height = order.height;
    frame.samples = order.samples;
    frame.view = scene.view;
    frame.floats = writer.isLinear();
    frame.transparentBackground = document.view.background == BackgroundMode::Off;
    render::SequenceSettings settings;
    settings.turning = order.turning;
    settings.count = order.count;
    settings.linear = writer.isLinear();
    settings.sliceMs = kTurntableSliceMs;
    settings.solutions.emplace(radiosityCacheFolder());
    render::ViewRenderer picture(**renderer);
    const auto take = [&](Image drawn) -> Result<void> {
        const auto added = writer.add(std::move(drawn), job);
        return added ? Result<void>() : Result<void>(added.error());
    };
    if (Result<void> drawn = render::drawSequence(**renderer, picture, document, frame, settings,
                                                  take, job.part(kPrepared, kDrawn));
        !drawn)
        return drawn;
    job.setActivity("writing");
    return writer.finish(job);
}

// "turn-0001.png to turn-0072.png"
QString namesOf(const TurntableOrder& order, int count) {
    const std::filesystem::path file = toPath(order.file);
    const QString first = fromPath(sequenceFile(file, 0).filename());
    return count < 2 ? first
                     : trTurntable("%1 to %2")
                           .arg(first, fromPath(sequenceFile(file, count - 1).filename()));
}

QString partText(const TurntableOrder& order, int written) {
    return trTurntable("%1 of %2 pictures were written: %3")
        .arg(written)
        .arg(order.count)
        .arg(namesOf(order, written));
}

} // namespace

JobOutcome drawTurntable(const TurntableOrder& order, SceneCopy scene, WorkerClient& worker,
                         PreparedLights& lights, const JobContext& job) {
    SequenceOutput output;
    output.file = absolutePath(order.file);
    output.width = order.width;
    output.height = order.height;
    output.framesPerSecond = order.framesPerSecond;
    output.transparent = scene.document.view.background == BackgroundMode::Off;
    const Result<std::unique_ptr<SequenceWriter>> writer = SequenceWriter::create(worker, output);
    if (!writer)
        return {writer.error(), {}, {}};
    const Result<void> done = writeTurntable(order, scene, lights, **writer, job);
    const int written = (*writer)->written();
    if (!done) {
        Error error = done.error();
        if (written == 0)
            return {error, {}, {}};
        const QString kept = partText(order, written);
        if (error.kind == ErrorKind::Cancelled)
            return {error, trTurntable("Cancelled; %1").arg(kept), {}};
        error.message += "; " + kept.toStdString();
        return {error, {}, {}};
    }
    const QString folder = QFileInfo(order.file).absolutePath();
    return {std::nullopt,
            isVideoFile(output.file) ? trTurntable("Saved the video to %1").arg(order.file)
                                     : trTurntable("Saved %1 pictures to %2: %3")
                                           .arg(written)
                                           .arg(folder, namesOf(order, written)),
            {}};
}

quint64 saveTurntable(const TurntableOrder& order, Session& session) {
    const auto say = [target = &session.controller](const QString& text) {
        UserNotice notice;
        notice.text = text;
        Q_EMIT target->noticed(notice);
    };
    return session.jobs.start(
        trTurntable("Save turntable: %1").arg(shownFileName(order.file)), false,
        [order, scene = sceneCopy(session), worker = &session.worker, lights = &session.lights,
         target = &session.controller, say](const JobContext& job) -> JobOutcome {
            JobOutcome outcome = drawTurntable(order, scene, *worker, *lights, job);
            if (!outcome.error)
                outcome.apply = [say, text = outcome.summary] { say(text); };
            else if (!outcome.summary.isEmpty()) // a cancelled job applies nothing
                QMetaObject::invokeMethod(
                    target, [say, text = outcome.summary] { say(text); }, Qt::QueuedConnection);
            return outcome;
        });
}

} // namespace patina::editor
