// Starts bakes of the controller's document as jobs, shows them live and attaches the result.
#pragma once

#include "core/bake/Bake.h"

#include <QObject>
#include <QString>

namespace patina::editor {

class DocumentController;
class JobManager;

struct BakeRequest {
    BakeKind kind = BakeKind::PrtVertex;
    AoSettings ao;   // for the two ambient occlusion kinds
    PrtSettings prt; // for PrtVertex
};

[[nodiscard]] QString bakeTitle(BakeKind kind); // "PRT (per vertex)"

// Whether an attached bake still belongs to the document's visible geometry.
[[nodiscard]] bool isStale(const BakeArtifact& artifact, const Hash& currentInputs);

// One bake runs at a time: the cores are better used by one than shared by two.
class BakeRunner : public QObject {
    Q_OBJECT
  public:
    BakeRunner(DocumentController& controller, JobManager& jobs, QObject* parent = nullptr);

    void start(const BakeRequest& request); // nothing happens while another one runs
    void stop();                            // keeps what has converged
    void cancel();                          // leaves nothing
    [[nodiscard]] bool running() const { return m_job != 0; }
    [[nodiscard]] quint64 jobId() const { return m_job; }

    // Hash of what a bake started now would be made from; kept until geometry changes.
    [[nodiscard]] Hash currentInputs();

  Q_SIGNALS:
    void stateChanged(); // started, ended, or the document's geometry changed

  private:
    DocumentController& m_controller;
    JobManager& m_jobs;
    quint64 m_job = 0;
    bool m_hashValid = false;
    Hash m_hash;
};

} // namespace patina::editor
