// Keeps the bounces of an attached transfer bake true while albedo is edited: holds the hits of the
// bake's rays (of a bake opened from a file they are traced anew, in the background) and follows
// light over them again after every edit, without tracing a ray: that of the light shown at once,
// and behind it all coefficients, which take its place in the document.
//
// The light shown stands for the document's bounces only while those are wrong: they are of other
// albedo, or of another number of bounces than the view asks for. While it does it follows the
// light, the newest first.
#pragma once

#include "app/editor/job/BounceWork.h"
#include "app/editor/job/LatestJob.h"

#include <QObject>
#include <QTimer>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace patina::editor {

class DocumentController;
class FinishedHits;

class BounceUpdater : public QObject {
    Q_OBJECT
  public:
    // `ended`: of the bakes that are attached; taken from there.
    BounceUpdater(DocumentController& controller, FinishedHits& ended, QObject* parent = nullptr);

    // Hits are there, and no edit waits for its bounces.
    [[nodiscard]] bool upToDate() const;
    // Something is under way after which a picture under transfer may be another one.
    [[nodiscard]] bool isOnItsWay() const;
    [[nodiscard]] const HitSource* hits() const; // null: none

    // Bands of the light that setLight() wants; 0: none.
    [[nodiscard]] int lightOrder() const;
    // What transfer is lit by in the frames to come: radiance coefficients.
    void setLight(std::span<const glm::vec3> light);
    // What is to be shown instead of what the document's bake holds of bounces; null: nothing.
    [[nodiscard]] const BouncedLightPtr& shown() const { return m_shown; }

  Q_SIGNALS:
    void updated();      // the document's bake has bounces for the present albedo
    void shownChanged(); // shown() is another

  private:
    // What light is followed for.
    struct Request {
        BakeArtifactPtr artifact;
        std::vector<BakeSurface> surfaces;
        std::vector<glm::vec3> light;
        int bounces = 0;
        friend bool operator==(const Request&, const Request&) = default;
    };
    void update();
    void trace(const BakeArtifactPtr& artifact, BakeInputs inputs);
    void follow(const BakeArtifactPtr& artifact, const BakeInputs& inputs);
    void showLight(Request request, const BakeInputs& inputs);
    void show(BouncedLightPtr light);
    void solve(); // all coefficients
    void forget();

    DocumentController& m_controller;
    FinishedHits& m_ended;
    QTimer m_pause; // of the hand, before all coefficients are solved

    BakeInputs m_inputs;                           // what the hits are of, or what is being traced
    std::map<std::string, std::string> m_settings; // of the bake whose hits they are
    BakeArtifactPtr m_hopeless;                    // has no hits: of other geometry, or too many
    BounceSolverPtr m_solver;                      // of the surfaces solved for last; null: no hits
    // What bounces were last solved for, and are being solved for.
    BakeArtifactPtr m_solved;
    std::vector<BakeSurface> m_solvedSurfaces, m_solvingSurfaces;
    // The light of the last frame, and what is asked for in it.
    std::vector<glm::vec3> m_light;
    Request m_request;
    BouncedLightPtr m_shown;
    std::vector<BakeSurface> m_shownSurfaces;
    int m_bounces = 0;                          // that the view asks for
    LatestJob m_tracing, m_lighting, m_solving; // last: they end first
};

} // namespace patina::editor
