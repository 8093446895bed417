#include "app/editor/job/BakeRunner.h"

#include "app/editor/document/DocumentController.h"
#include "app/editor/job/JobManager.h"
#include "app/editor/job/LivePreview.h"
#include "core/material/Parameters.h"

namespace patina::editor {
namespace {

Result<BakeArtifact> runBake(const BakeRequest& request, const BakeInputs& inputs, TileSink& sink,
                             const JobContext& job) {
    switch (request.kind) {
    case BakeKind::AoTexel:
        return bakeAoTexel(inputs, request.ao, sink, job);
    case BakeKind::AoVertex:
        return bakeAoVertex(inputs, request.ao, sink, job);
    case BakeKind::PrtTexel:
        return bakePrtTexel(inputs, request.prt, sink, job);
    case BakeKind::PrtVertex:
        break;
    }
    return bakePrtVertex(inputs, request.prt, sink, job);
}

} // namespace

QString bakeTitle(BakeKind kind) {
    switch (kind) {
    case BakeKind::AoTexel:
        return BakeRunner::tr("Ambient occlusion (texture)");
    case BakeKind::AoVertex:
        return BakeRunner::tr("Ambient occlusion (per vertex)");
    case BakeKind::PrtTexel:
        return BakeRunner::tr("Radiance transfer (PRT, texture)");
    case BakeKind::PrtVertex:
        break;
    }
    return BakeRunner::tr("Radiance transfer (PRT, per vertex)");
}

bool isStale(const BakeArtifact& artifact, const Hash& currentInputs) {
    return artifact.inputs != currentInputs;
}

BakeRunner::BakeRunner(DocumentController& controller, JobManager& jobs, QObject* parent)
    : QObject(parent)
    , m_controller(controller)
    , m_jobs(jobs) {
    connect(&controller, &DocumentController::changed, this, [this](const Change& change) {
        if (!touches(change.affects, Affects::Geometry | Affects::Bakes | Affects::Structure))
            return;
        m_hashValid = false;
        Q_EMIT stateChanged();
    });
    connect(&jobs, &JobManager::jobsChanged, this, [this] {
        if (m_job == 0)
            return;
        const std::optional<JobRecord> job = m_jobs.job(m_job);
        if (job && job->state == JobState::Running)
            return;
        m_job = 0;
        m_jobs.setPreview(nullptr);
        Q_EMIT stateChanged();
    });
}

void BakeRunner::start(const BakeRequest& request) {
    if (running())
        return;
    const BakeInputs inputs = bakeInputs(m_controller.document());
    auto preview =
        std::make_shared<LivePreview>(inputs, request.kind, request.prt.order, request.ao.size);

    // Transfer is only visible in PRT lighting.
    if (request.kind == BakeKind::PrtVertex) {
        const ParameterInfo* lighting = findParameter("view.lighting");
        m_controller.setParameter(*lighting, Target{Scope::View, 0},
                                  static_cast<int>(LightingMode::Prt));
    }

    m_jobs.setPreview(preview);
    m_job = m_jobs.start(
        tr("Bake: %1").arg(bakeTitle(request.kind)), true,
        [this, request, inputs, preview](const JobContext& job) -> JobOutcome {
            Result<BakeArtifact> result = runBake(request, inputs, *preview, job);
            if (!result)
                return {result.error(), {}, {}};
            auto artifact = std::make_shared<const BakeArtifact>(std::move(result).value());
            const QString summary = tr("%1 rays per %2")
                                        .arg(artifact->samplesDone)
                                        .arg(isPerTexel(request.kind) ? tr("texel") : tr("vertex"));
            return {std::nullopt, summary, [this, artifact] { m_controller.attachBake(artifact); }};
        });
    Q_EMIT stateChanged();
}

void BakeRunner::stop() {
    m_jobs.stop(m_job);
}

void BakeRunner::cancel() {
    m_jobs.cancel(m_job);
}

Hash BakeRunner::currentInputs() {
    if (!m_hashValid) {
        m_hash = hashBakeInputs(bakeInputs(m_controller.document()));
        m_hashValid = true;
    }
    return m_hash;
}

} // namespace patina::editor
