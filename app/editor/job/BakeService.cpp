#include "app/editor/job/BakeService.h"

#include "app/editor/document/DocumentController.h"
#include "app/editor/document/UserNotice.h"
#include "app/editor/job/BakeRates.h"
#include "app/editor/job/BakeWork.h"
#include "app/editor/job/LightMapWork.h"
#include "app/editor/job/LivePreview.h"
#include "core/bake/Bake.h"
#include "core/bake/BakeMemory.h"
#include "core/bake/document/BakeStaleness.h"
#include "core/bake/document/DocumentBakeInputs.h"
#include "core/bake/file/BakeFileSize.h"
#include "core/bake/lightmap/LightMapBake.h"
#include "core/base/FileLock.h"
#include "core/base/ProcessMemory.h"
#include "core/document/AbsentBake.h"
#include "core/document/ViewChoices.h"
#include "core/edit/Edit.h"
#include "core/edit/Parameters.h"
#include "core/trace/document/DocumentTraceInputs.h"

#include <QFile>
#include <QMetaObject>
#include <QStandardPaths>
#include <utility>

namespace patina::editor {
namespace {

constexpr int kViewMs = 250;
constexpr int kSettleMs = 300;
constexpr float kWidestPicture = 2.0f; // the bake sees rather more than the viewport

// Bakes outlive the session; the system may empty this folder at any time.
std::filesystem::path bakeFolder() {
    const QString folder = QStandardPaths::writableLocation(QStandardPaths::CacheLocation);
    return std::filesystem::path(QFile::encodeName(folder).toStdString()) / "bakes";
}

// A bake that was stopped does not take the place of one of the same scene that holds more.
bool holdsMore(const BakeArtifact& attached, const BakeArtifact& stopped) {
    return attached.inputs == stopped.inputs && attached.samplesDone > stopped.samplesDone &&
           attached.order >= stopped.order && attached.transfer >= stopped.transfer;
}

// What a light map corrects is seen in its own light only.
void showLightMap(DocumentController& controller, const BakeArtifact& bake) {
    if (bake.kind == BakeKind::LightMap)
        controller.showLighting(LightingMode::LightMap);
}

// Its hits are known before anybody hears of it.
void attach(DocumentController& controller, FinishedHits& hits, const BakeEnd& end) {
    const BakeArtifactPtr attached = findBake(controller.document(), end.artifact->kind);
    if (!attached || !stoppedEarly(*end.artifact) || !holdsMore(*attached, *end.artifact)) {
        hits.keep(end.artifact, end.hits);
        controller.attachBake(end.artifact);
        showLightMap(controller, *end.artifact);
        return;
    }
    UserNotice notice;
    notice.text =
        BakeService::tr("The bake stopped at %1. The attached one has more (%2) and stays; "
                        "the Bake dock can resume the other.")
            .arg(bakeSummary(*end.artifact), bakeSummary(*attached));
    Q_EMIT controller.noticed(notice);
}

// Of a checkpoint that cannot be written; from the job's thread.
void warn(DocumentController& controller, const Error& error) {
    QMetaObject::invokeMethod(
        &controller,
        [&controller, error] {
            UserNotice notice = UserNotice::fromError(error);
            notice.kind = NoticeKind::Warning;
            notice.text = BakeService::tr("The bake goes on, but no checkpoint of it is kept: %1")
                              .arg(QString::fromStdString(error.message));
            Q_EMIT controller.noticed(notice);
        },
        Qt::QueuedConnection);
}

} // namespace

Result<void> checkBake(const BakeRequest& request, const BakeInputs& inputs) {
    if (Result<void> fits = checkBakeFile(request, inputs); !fits)
        return fits;
    return checkBakeMemory(request, inputs, availableMemory());
}

QString bakeTitle(BakeKind kind) {
    switch (kind) {
    case BakeKind::AoTexel:
        return BakeService::tr("Ambient occlusion (texture)");
    case BakeKind::AoVertex:
        return BakeService::tr("Ambient occlusion (per vertex)");
    case BakeKind::PrtTexel:
        return BakeService::tr("Radiance transfer (PRT, texture)");
    case BakeKind::LightMap:
        return BakeService::tr("Light map");
    case BakeKind::PrtVertex:
        break;
    }
    return BakeService::tr("Radiance transfer (PRT, per vertex)");
}

BakeService::BakeService(DocumentController& controller, JobManager& jobs, QObject* parent)
    : QObject(parent)
    , m_controller(controller)
    , m_jobs(jobs)
    , m_folder(bakeFolder())
    , m_cache(m_folder) {
    connect(&controller, &DocumentController::changed, this, &BakeService::documentChanged);
    connect(&jobs, &JobManager::jobsChanged, this, &BakeService::jobsChanged);
    connect(&jobs, &JobManager::shuttingDown, this, &BakeService::interrupt);
    m_viewTimer.setInterval(kViewMs);
    connect(&m_viewTimer, &QTimer::timeout, this, &BakeService::passView);
    m_settled.setInterval(kSettleMs);
    m_settled.setSingleShot(true);
    connect(&m_settled, &QTimer::timeout, this, [this] {
        restoreBakes();
        showPreviews();
        Q_EMIT stateChanged();
    });
    m_restore.setSingleShot(true);
    connect(&m_restore, &QTimer::timeout, this, &BakeService::restoreBakes);
}

BakeService::~BakeService() {
    blockSignals(true); // who listens may be half gone
    interrupt();
}

void BakeService::interrupt() {
    for (const auto& [id, bake] : m_bakes)
        *bake.resumable = true;
    for (const quint64 id : jobIds())
        m_jobs.cancel(id);
}

void BakeService::start(const BakeRequest& request, JobPriority priority) {
    if (const Result<void> fits = checkBake(request, bakeInputs(m_controller.document())); !fits) {
        Q_EMIT m_controller.noticed(UserNotice::fromError(fits.error()));
        return;
    }
    const Bake bake{request, std::make_shared<LivePreview>(request.kind),
                    std::make_shared<std::atomic<bool>>(false), false};
    const quint64 id =
        m_jobs.enqueue(tr("Bake: %1").arg(bakeTitle(request.kind)), priority, preparation(bake));
    m_bakes.emplace(id, bake);
    m_viewTimer.start();
    jobsChanged(); // it may have begun, or ended by now
}

// Of values, so that the job depends on nothing here but on the controller, which outlives it.
JobManager::Prepare BakeService::preparation(const Bake& bake) const {
    return [controller = &m_controller, hits = m_hits, cache = m_cache, folder = m_folder,
            bake]() -> Result<JobManager::Work> {
        if (bake.request.kind == BakeKind::LightMap) {
            if (const Result<void> fits =
                    checkBake(bake.request, bakeInputs(controller->document()));
                !fits)
                return fits.error();
            const LightMapWork work{controller->document(), bake.request.lightMap};
            return JobManager::Work([work, controller, hits](const JobContext& job) {
                const BakeEnd end = runLightMap(work, job);
                JobOutcome outcome{end.error, end.summary, {}};
                if (end.artifact)
                    outcome.apply = [controller, hits, end] { attach(*controller, *hits, end); };
                return outcome;
            });
        }
        auto inputs = std::make_shared<const BakeInputs>(bakeInputs(controller->document()));
        // Asked again: others may have taken the memory since the job was queued.
        if (const Result<void> fits = checkBake(bake.request, *inputs); !fits)
            return fits.error();
        const BakeWork work{bake.request,
                            std::move(inputs),
                            bake.preview,
                            cache,
                            folder,
                            bake.resumable,
                            [controller](const Error& error) { warn(*controller, error); }};
        return JobManager::Work([work, controller, hits](const JobContext& job) {
            const BakeEnd end = runBake(work, job);
            JobOutcome outcome{end.error, end.summary, {}};
            if (end.artifact)
                outcome.apply = [controller, hits, end] { attach(*controller, *hits, end); };
            return outcome;
        });
    };
}

const std::vector<InterruptedBake>& BakeService::interrupted() {
    if (!m_interruptedValid) {
        m_interrupted = interruptedBakes(m_folder, bakeInputs(m_controller.document()));
        m_interruptedValid = true;
    }
    return m_interrupted;
}

void BakeService::discard(const InterruptedBake& bake) {
    if (const Result<void> removed = removeCheckpoint(bake.file); !removed) {
        UserNotice notice = UserNotice::fromError(removed.error());
        notice.kind = NoticeKind::Warning;
        Q_EMIT m_controller.noticed(notice);
    }
    m_interruptedValid = false;
    Q_EMIT stateChanged();
}

void BakeService::documentChanged(const Change& change) {
    // Another document: what bakes of the last one would come to belongs to nothing here.
    if (change.isAnotherDocument()) {
        m_store.clear();
        if (m_controller.undoStack().count() == 0)
            interrupt();
    }

    const bool bakes =
        touches(change.affects, Affects::Geometry | Affects::Bakes | Affects::Structure);
    // Alpha decides where rays pass, albedo what bounces: hashed when edits pause.
    const bool material = change.target && change.target->scope == Scope::Material;
    if (bakes || material)
        m_inputsValid = m_albedoValid = m_interruptedValid = false;
    if (change.affects != Affects::Nothing)
        m_lightValid = false;
    const bool lightMap =
        !material && !bakes && findBake(m_controller.document(), BakeKind::LightMap) != nullptr;
    if (touches(change.affects, Affects::Bakes))
        keepBakes();
    if (bakes) {
        m_restore.start(0); // not within the step that is being done
        showPreviews();
        Q_EMIT stateChanged();
    } else if (material || lightMap) {
        m_settled.start();
    }
}

void BakeService::keepBakes() {
    for (const BakeArtifactPtr& bake : m_controller.document().bakes)
        if (!isAbsent(*bake))
            m_store.keep(bake);
}

void BakeService::restoreBakes() {
    const std::vector<BakeArtifactPtr> attached = m_controller.document().bakes;
    for (const BakeArtifactPtr& bake : attached)
        if (!isAbsent(*bake) && bake->inputs != currentInputs())
            if (BakeArtifactPtr found = m_store.find(bake->kind, currentInputs()))
                m_controller.renewBake(bake, std::move(found));
}

// A finished bake of this scene shows more than one that runs: all its rays, fitted to the surface,
// and its bounces. One of another scene is wrong, but its bounces are not given up for a picture
// without any, nor its shadows before there are others everywhere.
bool BakeService::showsMore(const LivePreview& preview) {
    const BakeArtifactPtr attached = findBake(m_controller.document(), preview.kind());
    if (!attached)
        return true;
    return attached->inputs != currentInputs() && attached->bounces == 0 &&
           preview.samplesDone() > 0;
}

void BakeService::showPreviews() {
    for (const auto& [id, bake] : m_bakes)
        if (bake.begun)
            bake.preview->setShown(showsMore(*bake.preview));
}

void BakeService::jobsChanged() {
    std::erase_if(m_bakes, [this](const auto& bake) {
        const std::optional<JobRecord> job = m_jobs.job(bake.first);
        if (job && job->state == JobState::Done)
            BakeRates::learn(bake.second.request, bake.second.rays, job->progress);
        return !job || job->ended();
    });
    bool begins = false, transfer = false;
    // The one that runs is shown, or else one that is paused.
    std::shared_ptr<LivePreview> shown;
    bool runs = false;
    for (auto& [id, bake] : m_bakes) {
        const JobRecord job = *m_jobs.job(id);
        if (!job.begun)
            continue;
        if (!std::exchange(bake.begun, true)) {
            begins = true;
            bake.rays = static_cast<double>(
                estimateBake(bake.request, bakeInputs(m_controller.document())).rays);
            transfer |= holdsTransfer(bake.request.kind);
        }
        const bool running = job.state == JobState::Running;
        if (!shown || (running && !runs))
            shown = bake.preview;
        runs |= running;
    }
    // Transfer is only visible in PRT lighting.
    if (transfer)
        m_controller.showLighting(LightingMode::Prt);
    showPreviews();
    setPreview(std::move(shown));
    if (begins)
        passView();
    if (m_bakes.empty())
        m_viewTimer.stop();
    m_interruptedValid = false;
    Q_EMIT stateChanged();
}

void BakeService::setPreview(std::shared_ptr<LivePreview> preview) {
    if (preview == m_preview)
        return;
    m_preview = std::move(preview);
    Q_EMIT previewChanged();
}

double BakeService::expectedSeconds(const BakeRequest& request, const BakeInputs& inputs) const {
    return BakeRates::seconds(request, static_cast<double>(estimateBake(request, inputs).rays));
}

void BakeService::passView() {
    const Camera& camera = m_controller.document().view.camera;
    const glm::mat4 projection =
        camera.projectionMatrix(kWidestPicture, m_controller.document().bounds());
    const BakeView view{camera.position(), projection * camera.viewMatrix()};
    for (const auto& [id, bake] : m_bakes)
        if (bake.begun)
            bake.preview->setView(view);
    if (m_inputsValid) // or it waits until edits pause
        showPreviews();
}

std::vector<quint64> BakeService::jobIds() const {
    std::vector<quint64> ids;
    for (const auto& [id, bake] : m_bakes)
        ids.push_back(id);
    return ids;
}

Hash BakeService::currentInputs() {
    if (!m_inputsValid) {
        m_inputs = hashBakeInputs(bakeInputs(m_controller.document()));
        m_inputsValid = true;
    }
    return m_inputs;
}

Hash BakeService::currentLight() {
    if (!m_lightValid) {
        m_light = hashLightMapLight(traceInputs(m_controller.document()));
        m_lightValid = true;
    }
    return m_light;
}

Hash BakeService::currentAlbedo() {
    if (!m_albedoValid) {
        m_albedo = hashBakeAlbedo(bakeInputs(m_controller.document()));
        m_albedoValid = true;
    }
    return m_albedo;
}

} // namespace patina::editor
