#include "app/editor/turntable/TurntableSave.h"

#include "app/editor/Session.h"
#include "app/editor/document/FileOnDisk.h"
#include "app/editor/document/QtText.h"
#include "core/bake/BakeMemory.h"
#include "core/bake/document/FollowBounces.h"
#include "core/base/Log.h"
#include "core/cells/SequenceWriter.h"
#include "core/document/ViewChoices.h"
#include "core/edit/Edit.h"
#include "core/edit/ViewReasons.h"
#include "core/io/VideoWriter.h"
#include "core/light/GeneratedEnvironment.h"
#include "core/mix/EnvironmentBlend.h"
#include "core/mix/LightMix.h"
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

Error cancelledTurntable() {
    return {ErrorKind::Cancelled, "cancelled", {}, {}};
}

// Drafts of pictures that an edit has just asked for.
bool isDraft(const ImagePtr& picture) {
    return !picture || picture->height() <= kDraftEnvironmentHeight;
}

// Environments and bounces as the viewport would show them at rest.
Result<void> completeScene(TurntableScene& scene, const JobContext& job) {
    Document& document = scene.document;
    for (Environment& environment : document.environments)
        if (isGenerated(environmentRecipe(environment)) && isDraft(environment.image))
            resolveEnvironment(environment, job);
    if (environmentBlend(document) && isDraft(document.mix.blended))
        resolveBlend(document, job);
    if (job.cancelled())
        return cancelledTurntable();
    const LightingMode lighting =
        lightingOf(scene.view.shown.kind, scene.view.lighting.value_or(document.view.lighting));
    const Result<std::vector<std::string>> followed = followBounces(lighting, document, job);
    if (!followed)
        return followed.error();
    for (const std::string& warning : *followed)
        logWarning("{}", warning);
    if (!readsBake(lighting) || !hasTransfer(document)) {
        scene.shadows = nullptr;
        return {};
    }
    const NearShadowRequest request = nearShadowRequest(document);
    Result<NearShadowsPtr> shadows =
        request.empty() ? NearShadowsPtr()
                        : traceNearShadows(request, scene.shadows, availableMemory(), job);
    if (!shadows && shadows.error().kind == ErrorKind::Cancelled)
        return shadows.error();
    if (!shadows) // the picture shows what the bake's bands know, as the viewport's does
        logWarning("Shadows of local lights stay soft: {}", shadows.error().text());
    scene.shadows = shadows ? std::move(*shadows) : nullptr;
    return {};
}

// In full; null where no environment lights the scene and no view looks at one.
Result<EnvironmentTexelsPtr> lightOfTurntable(const TurntableScene& scene, PreparedLights& lights,
                                              const JobContext& job) {
    const ImagePtr picture = shownEnvironment(scene.document).image;
    const bool lit = !environmentParts(scene.document).empty() || !scene.view.isPlain();
    if (!lit || !picture)
        return EnvironmentTexelsPtr();
    Result<IblLight> light = lights.first(picture, job);
    if (light && !light->full)
        light = refinedIbl(std::move(*light), job);
    if (!light)
        return light.error();
    lights.keep(*light);
    return light->texels;
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

Result<void> writeTurntable(const TurntableOrder& order, TurntableScene& scene,
                            PreparedLights& lights, SequenceWriter& writer, const JobContext& job) {
    job.setActivity("preparing light");
    if (Result<void> completed = completeScene(scene, job); !completed)
        return completed;
    Result<EnvironmentTexelsPtr> light = lightOfTurntable(scene, lights, job);
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

TurntableScene turntableScene(const Session& session) {
    TurntableScene scene;
    scene.document = session.controller.document();
    scene.view = session.views.settings();
    scene.view.split.reset();
    scene.view.flags = 1.0f; // marks do not blink
    if (!whyEmpty(scene.view.shown.kind, scene.document, scene.view.light).empty())
        scene.view.shown = {};
    if (scene.document.view.toneMap == ToneMap::OpenColorIo)
        scene.display = session.displays.transform();
    scene.shadows = session.nearShadows.shown();
    return scene;
}

JobOutcome drawTurntable(const TurntableOrder& order, TurntableScene scene, WorkerClient& worker,
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
        trTurntable("Save turntable: %1").arg(QFileInfo(order.file).fileName()), false,
        [order, scene = turntableScene(session), worker = &session.worker, lights = &session.lights,
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
