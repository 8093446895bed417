#include "app/editor/job/BakeRunner.h"

#include "app/editor/document/DocumentController.h"
#include "app/editor/document/UserNotice.h"
#include "app/editor/job/LivePreview.h"
#include "core/bake/Bake.h"
#include "core/bake/BakeMemory.h"
#include "core/bake/document/BakeStaleness.h"
#include "core/bake/document/DocumentBakeInputs.h"
#include "core/bake/file/BakeFileSize.h"
#include "core/bake/transfer/ResumableTracer.h"
#include "core/base/Log.h"
#include "core/edit/Edit.h"
#include "core/edit/Parameters.h"

#include <QFile>
#include <QMetaObject>
#include <QStandardPaths>

namespace patina::editor {
namespace {

constexpr int kViewMs = 250;
constexpr int kSettleMs = 300;
constexpr double kCheckpointSeconds = 30.0;
constexpr float kWidestPicture = 2.0f; // the bake sees rather more than the viewport

// Bakes outlive the session; the system may empty this folder at any time.
std::filesystem::path bakeFolder() {
    const QString folder = QStandardPaths::writableLocation(QStandardPaths::CacheLocation);
    return std::filesystem::path(QFile::encodeName(folder).toStdString()) / "bakes";
}

QString summaryOf(const BakeArtifact& artifact) {
    const QString element =
        isPerTexel(artifact.kind) ? BakeRunner::tr("texel") : BakeRunner::tr("vertex");
    if (const std::optional<StoppedBake> stopped = stoppedEarly(artifact))
        return BakeRunner::tr("%1 of %2 rays per %3")
            .arg(stopped->done)
            .arg(stopped->asked)
            .arg(element);
    return BakeRunner::tr("%1 rays per %2").arg(artifact.samplesDone).arg(element);
}

// A bake that was stopped does not take the place of one of the same scene that holds more.
bool holdsMore(const BakeArtifact& attached, const BakeArtifact& stopped) {
    return attached.inputs == stopped.inputs && attached.samplesDone > stopped.samplesDone &&
           attached.order >= stopped.order && attached.transfer >= stopped.transfer;
}

void attach(DocumentController& controller, const BakeArtifactPtr& artifact) {
    const BakeArtifactPtr attached = findBake(controller.document(), artifact->kind);
    if (!attached || !stoppedEarly(*artifact) || !holdsMore(*attached, *artifact)) {
        controller.attachBake(artifact);
        return;
    }
    UserNotice notice;
    notice.text =
        BakeRunner::tr("The bake stopped at %1. The attached one has more (%2) and stays; "
                       "the Bake dock can resume the other.")
            .arg(summaryOf(*artifact), summaryOf(*attached));
    Q_EMIT controller.noticed(notice);
}

// Of a checkpoint that cannot be written; from the job's thread.
void warn(DocumentController& controller, const Error& error) {
    QMetaObject::invokeMethod(
        &controller,
        [&controller, error] {
            UserNotice notice = UserNotice::fromError(error);
            notice.kind = NoticeKind::Warning;
            notice.text = BakeRunner::tr("The bake goes on, but no checkpoint of it is kept: %1")
                              .arg(QString::fromStdString(error.message));
            Q_EMIT controller.noticed(notice);
        },
        Qt::QueuedConnection);
}

// Goes on from the checkpoint, where there is one of the same bake, and keeps one meanwhile.
Result<BakeArtifact> bakeResumably(const BakeRequest& request, const BakeInputs& inputs,
                                   TileSink& sink, const std::filesystem::path& checkpoint,
                                   const JobContext& job, const Checkpointer::Warn& warnOf) {
    std::error_code error;
    std::filesystem::create_directories(checkpoint.parent_path(), error); // else writing tells why
    ResumeSettings settings;
    settings.manifest = bakeManifest(request, inputs);
    settings.checkpoint = checkpoint;
    settings.everySeconds = kCheckpointSeconds;
    settings.resume = std::filesystem::exists(checkpoint, error);
    settings.keepOnCancel = true;
    settings.warn = warnOf;
    ResumableTracer tracer(settings);
    Result<BakeArtifact> result = bake(request, inputs, sink, job, &tracer);
    if (result || result.error().kind != ErrorKind::InputBroken || !settings.resume ||
        tracer.resumedFrom() >= 0)
        return result;
    logWarning("The checkpoint is of no use and removed: {}", result.error().text());
    std::filesystem::remove(checkpoint, error);
    settings.resume = false;
    ResumableTracer anew(settings);
    return bake(request, inputs, sink, job, &anew);
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

BakeRunner::BakeRunner(DocumentController& controller, JobManager& jobs, QObject* parent)
    : QObject(parent)
    , m_controller(controller)
    , m_jobs(jobs)
    , m_folder(bakeFolder())
    , m_cache(m_folder) {
    connect(&controller, &DocumentController::changed, this, &BakeRunner::documentChanged);
    connect(&jobs, &JobManager::jobsChanged, this, &BakeRunner::jobsChanged);
    connect(&jobs, &JobManager::shuttingDown, this, &BakeRunner::interrupt);
    m_viewTimer.setInterval(kViewMs);
    connect(&m_viewTimer, &QTimer::timeout, this, &BakeRunner::passView);
    m_settled.setInterval(kSettleMs);
    m_settled.setSingleShot(true);
    connect(&m_settled, &QTimer::timeout, this, [this] {
        showPreviews();
        Q_EMIT stateChanged();
    });
}

BakeRunner::~BakeRunner() {
    blockSignals(true); // who listens may be half gone
    interrupt();
}

void BakeRunner::interrupt() {
    for (const auto& [id, bake] : m_bakes)
        *bake.resumable = true;
    for (const quint64 id : jobIds())
        m_jobs.cancel(id);
}

void BakeRunner::start(const BakeRequest& request, JobPriority priority) {
    if (const Result<void> fits = checkBake(request, bakeInputs(m_controller.document())); !fits) {
        Q_EMIT m_controller.noticed(UserNotice::fromError(fits.error()));
        return;
    }
    // The id is known only after the job may have begun.
    const auto id = std::make_shared<quint64>(0);
    Bake bake;
    bake.request = request;
    *id = m_jobs.enqueue(tr("Bake: %1").arg(bakeTitle(request.kind)), priority,
                         [this, id, bake] { return prepare(id, bake); });
    const std::optional<JobRecord> job = m_jobs.job(*id);
    if (job && !job->ended())
        m_bakes.emplace(*id, bake);
    m_viewTimer.start();
    jobsChanged();
}

Result<JobManager::Work> BakeRunner::prepare(const std::shared_ptr<quint64>& id,
                                             const Bake& wanted) {
    const BakeRequest& request = wanted.request;
    auto inputs = std::make_shared<const BakeInputs>(bakeInputs(m_controller.document()));
    // Asked again: others may have taken it since the job was queued.
    if (const Result<void> fits = checkBake(request, *inputs); !fits)
        return fits.error();

    // Transfer is only visible in PRT lighting.
    if (holdsTransfer(request.kind))
        m_controller.showLighting(LightingMode::Prt);

    auto preview = std::make_shared<LivePreview>(request.kind);
    preview->setShown(showsMore(*preview));
    // By the time this runs, enqueue() has returned and the id is known.
    QMetaObject::invokeMethod(
        this,
        [this, id, preview] {
            if (const auto bake = m_bakes.find(*id); bake != m_bakes.end())
                bake->second.preview = preview;
            jobsChanged();
            passView();
        },
        Qt::QueuedConnection);

    // The work outlives this object, but not the controller.
    return JobManager::Work([controller = &m_controller, cache = m_cache, folder = m_folder, inputs,
                             preview, request,
                             resumable = wanted.resumable](const JobContext& job) -> JobOutcome {
        const auto done = [controller](BakeArtifact artifact, const QString& summary) {
            auto shared = std::make_shared<const BakeArtifact>(std::move(artifact));
            return JobOutcome{std::nullopt, summary,
                              [controller, shared] { attach(*controller, shared); }};
        };
        const Hash key = BakeCache::key(request, *inputs);
        if (std::optional<BakeArtifact> kept = cache.find(key, *inputs)) {
            const QString summary =
                BakeRunner::tr("%1, kept from an earlier bake").arg(summaryOf(*kept));
            return done(std::move(*kept), summary);
        }
        preview->begin(*inputs, request.prt.order, request.ao.size);
        Result<BakeArtifact> result =
            bakeResumably(request, *inputs, *preview, checkpointFile(folder, key), job,
                          [controller](const Error& error) { warn(*controller, error); });
        // What was stopped can be resumed, and so can what a quit interrupts.
        const bool stopped = result && stoppedEarly(*result);
        if (job.cancelled() ? !*resumable : !stopped) {
            std::error_code gone;
            std::filesystem::remove(checkpointFile(folder, key), gone);
        }
        if (!result) {
            const bool goesOn =
                job.cancelled() && std::filesystem::exists(checkpointFile(folder, key));
            return {result.error(),
                    goesOn ? BakeRunner::tr("Interrupted; it can go on in the Bake dock once its "
                                            "scene is open again")
                           : QString(),
                    {}};
        }
        if (!stopped)
            if (const Result<void> stored = cache.store(key, *inputs, *result); !stored)
                logWarning("The bake is not kept for the next time: {}", stored.error().text());
        const QString summary = summaryOf(*result);
        return done(std::move(result).value(), summary);
    });
}

const std::vector<InterruptedBake>& BakeRunner::interrupted() {
    if (!m_interruptedValid) {
        m_interrupted = interruptedBakes(m_folder, bakeInputs(m_controller.document()));
        m_interruptedValid = true;
    }
    return m_interrupted;
}

void BakeRunner::discard(const InterruptedBake& bake) {
    std::error_code gone;
    std::filesystem::remove(bake.file, gone);
    m_interruptedValid = false;
    Q_EMIT stateChanged();
}

void BakeRunner::documentChanged(const Change& change) {
    // Another document: what bakes of the last one would come to belongs to nothing here.
    if (change.isAnotherDocument() && m_controller.undoStack().count() == 0)
        interrupt();

    const bool bakes =
        touches(change.affects, Affects::Geometry | Affects::Bakes | Affects::Structure);
    // Alpha decides where rays pass, albedo what bounces: hashed when edits pause.
    const bool material = change.target && change.target->scope == Scope::Material;
    if (bakes || material)
        m_inputsValid = m_albedoValid = m_interruptedValid = false;
    if (bakes) {
        showPreviews();
        Q_EMIT stateChanged();
    } else if (material) {
        m_settled.start();
    }
}

// A finished bake of this scene shows more than one that runs: all its rays, fitted to the surface,
// and its bounces. One of another scene is wrong, but its bounces are not given up for a picture
// without any, nor its shadows before there are others everywhere.
bool BakeRunner::showsMore(const LivePreview& preview) {
    const BakeArtifactPtr attached = findBake(m_controller.document(), preview.kind());
    if (!attached)
        return true;
    return attached->inputs != currentInputs() && attached->bounces == 0 &&
           preview.samplesDone() > 0;
}

void BakeRunner::showPreviews() {
    for (const auto& [id, bake] : m_bakes)
        if (bake.preview)
            bake.preview->setShown(showsMore(*bake.preview));
}

void BakeRunner::jobsChanged() {
    std::erase_if(m_bakes, [this](const auto& bake) {
        const std::optional<JobRecord> job = m_jobs.job(bake.first);
        return !job || job->ended();
    });
    // The one that runs is shown, or else one that rests.
    std::shared_ptr<LivePreview> shown;
    for (const auto& [id, bake] : m_bakes) {
        const bool runs = m_jobs.job(id)->state == JobState::Running;
        if (bake.preview && (runs || !shown))
            shown = bake.preview;
        if (bake.preview && runs)
            break;
    }
    showPreviews();
    m_jobs.setPreview(shown);
    if (m_bakes.empty())
        m_viewTimer.stop();
    m_interruptedValid = false;
    Q_EMIT stateChanged();
}

void BakeRunner::passView() {
    const Camera& camera = m_controller.document().view.camera;
    const glm::mat4 projection =
        camera.projectionMatrix(kWidestPicture, m_controller.document().bounds());
    const BakeView view{camera.position(), projection * camera.viewMatrix()};
    for (const auto& [id, bake] : m_bakes)
        if (bake.preview)
            bake.preview->setView(view);
    if (m_inputsValid) // or it waits until edits pause
        showPreviews();
}

std::vector<quint64> BakeRunner::jobIds() const {
    std::vector<quint64> ids;
    for (const auto& [id, bake] : m_bakes)
        ids.push_back(id);
    return ids;
}

Hash BakeRunner::currentInputs() {
    if (!m_inputsValid) {
        m_inputs = hashBakeInputs(bakeInputs(m_controller.document()));
        m_inputsValid = true;
    }
    return m_inputs;
}

Hash BakeRunner::currentAlbedo() {
    if (!m_albedoValid) {
        m_albedo = hashBakeAlbedo(bakeInputs(m_controller.document()));
        m_albedoValid = true;
    }
    return m_albedo;
}

} // namespace patina::editor
