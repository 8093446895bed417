// Keeps the bounces of an attached transfer bake true while albedo is edited: holds the hits of the
// bake's rays (of a bake opened from a file they are traced anew, in the background) and follows
// light over them again after every edit, without tracing a ray.
#pragma once

#include "app/editor/job/LatestJob.h"
#include "core/bake/Bake.h"
#include "core/bake/BounceSolver.h"

#include <QObject>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace patina::editor {

class DocumentController;
class JobManager;

class BounceUpdater : public QObject {
    Q_OBJECT
  public:
    BounceUpdater(DocumentController& controller, JobManager& jobs, QObject* parent = nullptr);

    // Hits are there, and no edit waits for its bounces.
    [[nodiscard]] bool upToDate() const;
    [[nodiscard]] const HitSource* hits() const; // null: none

  Q_SIGNALS:
    void updated(); // the document's bake has bounces for the present albedo

  private:
    void update();
    void trace(const BakeArtifactPtr& artifact, BakeInputs inputs);
    void solve(const BakeArtifactPtr& artifact, BakeInputs inputs);
    void forget();

    DocumentController& m_controller;
    JobManager& m_jobs;
    LatestJob m_tracing, m_solving;

    BakeInputs m_inputs;                           // what the hits are of, or what is being traced
    std::map<std::string, std::string> m_settings; // of the bake whose hits they are
    BakeArtifactPtr m_hopeless;                    // has no hits: of other geometry, or too many
    std::shared_ptr<BounceSolver> m_solver; // null: no hits; used by m_solving's thread alone
    // What bounces were last solved for.
    BakeArtifactPtr m_solved;
    std::vector<BakeSurface> m_solvedSurfaces;
};

} // namespace patina::editor
