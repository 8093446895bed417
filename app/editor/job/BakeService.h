// Bakes of the controller's document: queued as jobs that take turns, shown live where no finished
// bake shows more, kept in a cache, attached when they are done. Whoever wants one starts it here
// and hears of it by signals: button -> start() -> JobManager -> TaskRunner -> attach() ->
// DocumentController.
#pragma once

#include "app/editor/job/FinishedHits.h"
#include "app/editor/job/InterruptedBakes.h"
#include "app/editor/job/JobManager.h"
#include "core/bake/document/ArtifactStore.h"
#include "core/bake/document/BakeCache.h"
#include "core/bake/domain/BakeRequest.h"

#include <QObject>
#include <QString>
#include <QTimer>
#include <atomic>
#include <map>
#include <memory>

namespace patina {
struct Change;
}

namespace patina::editor {

class DocumentController;
class LivePreview;

[[nodiscard]] QString bakeTitle(BakeKind kind); // "Radiance transfer (PRT, per vertex)"
// Errors (Usage): the bake does not fit into memory now, or not into the file that the project
// keeps it in; the message says what would.
Result<void> checkBake(const BakeRequest& request, const BakeInputs& inputs);

class BakeService : public QObject {
    Q_OBJECT
  public:
    BakeService(DocumentController& controller, JobManager& jobs, QObject* parent = nullptr);
    ~BakeService() override; // cancels its jobs; they can be resumed

    // Waits for its turn and then bakes what the document is by that time. A bake that does not fit
    // into memory is refused with advice.
    void start(const BakeRequest& request, JobPriority priority = JobPriority::Normal);
    [[nodiscard]] bool running() const { return !m_bakes.empty(); } // one runs or waits
    [[nodiscard]] std::vector<quint64> jobIds() const;              // of those, oldest first

    // What a running bake has found so far, or else one that is paused; null when there is none.
    [[nodiscard]] const std::shared_ptr<LivePreview>& preview() const { return m_preview; }
    // Of the bake that ended last.
    [[nodiscard]] FinishedHits& hits() { return *m_hits; }

    // Bakes of the present scene that were interrupted, by a crash or a quit, and that no other
    // program computes now; start() resumes one of the same settings.
    [[nodiscard]] const std::vector<InterruptedBake>& interrupted();
    void discard(const InterruptedBake& bake);

    // How long a bake will take, by what bakes of its kind took on this machine: BakeRates.
    [[nodiscard]] double expectedSeconds(const BakeRequest& request,
                                         const BakeInputs& inputs) const;

    // Hashes of what a bake started now would be made from; kept until the document changes.
    [[nodiscard]] Hash currentInputs();
    [[nodiscard]] Hash currentAlbedo();
    [[nodiscard]] Hash currentLight(); // hashLightMapLight()

    // Bakes of other states of the document, which undo may lead back to.
    [[nodiscard]] ArtifactStore& kept() { return m_store; }

  Q_SIGNALS:
    // One was started or has ended, or what bakes depend on has changed.
    void stateChanged();
    void previewChanged(); // preview() is another one

  private:
    struct Bake {
        BakeRequest request;
        std::shared_ptr<LivePreview> preview;
        // Whether its checkpoint outlives a cancel; read by the job's thread.
        std::shared_ptr<std::atomic<bool>> resumable;
        bool begun = false;
        double rays = 0.0; // of the estimate, when it began
    };
    [[nodiscard]] JobManager::Prepare preparation(const Bake& bake) const;
    void interrupt(); // cancels all, to be resumed
    void documentChanged(const Change& change);
    void jobsChanged();
    void passView();
    // Decides which running bakes belong into the picture.
    void showPreviews();
    [[nodiscard]] bool showsMore(const LivePreview& preview);
    void keepBakes();
    // Where undo has led back to other geometry: the bakes that were made of that, if there are
    // any.
    void restoreBakes();
    void setPreview(std::shared_ptr<LivePreview> preview);

    DocumentController& m_controller;
    JobManager& m_jobs;
    std::filesystem::path m_folder;
    BakeCache m_cache;     // on disk, by inputs and settings
    ArtifactStore m_store; // in memory: what this document has had
    std::shared_ptr<FinishedHits> m_hits = std::make_shared<FinishedHits>(); // jobs hold it, too
    std::map<quint64, Bake> m_bakes;                                         // by job
    std::shared_ptr<LivePreview> m_preview;
    QTimer m_viewTimer; // while bakes run: where the user looks
    QTimer m_settled;   // edits of materials come in bursts
    QTimer m_restore;
    bool m_inputsValid = false, m_albedoValid = false, m_lightValid = false,
         m_interruptedValid = false;
    std::vector<InterruptedBake> m_interrupted;
    Hash m_inputs, m_albedo, m_light;
};

} // namespace patina::editor
