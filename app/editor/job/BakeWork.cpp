#include "app/editor/job/BakeWork.h"

#include "app/editor/job/InterruptedBakes.h"
#include "core/bake/Bake.h"
#include "core/bake/document/BakeStaleness.h"
#include "core/bake/transfer/ResumableTracer.h"
#include "core/base/Log.h"

#include <QCoreApplication>

namespace patina::editor {
namespace {

constexpr double kCheckpointSeconds = 30.0;

QString trBake(const char* text) {
    return QCoreApplication::translate("patina::editor::BakeWork", text);
}

struct Baked {
    Result<BakeArtifact> artifact;
    bool keepsCheckpoint = false; // it is there, for a bake that is resumed
};

// Resumes the checkpoint, where there is one of the same bake, and keeps one meanwhile. Nothing is
// done to a checkpoint that another process writes.
Baked bakeResumably(const BakeWork& work, const std::filesystem::path& checkpoint,
                    const JobContext& job) {
    std::error_code error;
    std::filesystem::create_directories(checkpoint.parent_path(), error); // else writing says why
    ResumeSettings settings;
    settings.manifest = bakeManifest(work.request, *work.inputs);
    settings.checkpoint = checkpoint;
    settings.everySeconds = kCheckpointSeconds;
    settings.resume = true; // where there is one
    settings.keepOnCancel = true;
    settings.warn = work.warn;
    ResumableTracer tracer(std::move(settings));
    Result<BakeArtifact> result = bake(work.request, *work.inputs, *work.preview, job, &tracer);
    if (!result && result.error().kind == ErrorKind::InputBroken && tracer.resumedFrom() < 0 &&
        tracer.removeCheckpoint()) {
        logWarning("The checkpoint is of no use and removed: {}", result.error().text());
        result = bake(work.request, *work.inputs, *work.preview, job, &tracer);
    }
    // What was stopped can be resumed, and so can what a quit interrupts.
    const bool stopped = result && stoppedEarly(*result);
    if (job.cancelled() ? !*work.resumable : !stopped)
        tracer.removeCheckpoint();
    return {std::move(result), tracer.keptCheckpoint()};
}

} // namespace

QString bakeSummary(const BakeArtifact& artifact) {
    if (!restsOnRays(artifact))
        return trBake("in closed form, without rays");
    const QString element = isPerTexel(artifact.kind) ? trBake("texel") : trBake("vertex");
    if (const std::optional<StoppedBake> stopped = stoppedEarly(artifact))
        return trBake("%1 of %2 rays per %3").arg(stopped->done).arg(stopped->asked).arg(element);
    return trBake("%1 rays per %2").arg(artifact.samplesDone).arg(element);
}

BakeEnd runBake(const BakeWork& work, const JobContext& job) {
    const auto ended = [&](BakeArtifact artifact, const QString& summary) {
        return BakeEnd{std::nullopt, std::make_shared<const BakeArtifact>(std::move(artifact)),
                       work.preview->bounceHits(), summary};
    };
    const Hash key = BakeCache::key(work.request, *work.inputs);
    if (std::optional<BakeArtifact> kept = work.cache.find(key, *work.inputs)) {
        const QString summary = trBake("%1, kept from an earlier bake").arg(bakeSummary(*kept));
        return ended(std::move(*kept), summary);
    }
    work.preview->begin(*work.inputs, work.request.prt.order, work.request.ao.size);
    Baked baked = bakeResumably(work, checkpointFile(work.checkpoints, key), job);
    if (!baked.artifact) {
        const bool resumable = job.cancelled() && baked.keepsCheckpoint;
        return {baked.artifact.error(), nullptr, nullptr,
                resumable
                    ? trBake("Interrupted; it can go on in the Bake dock once its scene is open "
                             "again")
                    : QString()};
    }
    if (!stoppedEarly(*baked.artifact))
        if (const Result<void> stored = work.cache.store(key, *work.inputs, *baked.artifact);
            !stored)
            logWarning("The bake is not kept for the next time: {}", stored.error().text());
    const QString summary = bakeSummary(*baked.artifact);
    return ended(std::move(baked.artifact).value(), summary);
}

} // namespace patina::editor
