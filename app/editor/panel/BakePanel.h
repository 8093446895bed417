// The Bake dock: what to bake, how finely and at what cost; the queue; interrupted bakes that can
// go on; which bakes are attached and whether they still belong to the scene; the way it is lit.
#pragma once

#include "app/editor/job/BakeService.h"

#include <QTimer>
#include <QWidget>
#include <map>

class QLabel;
class QPushButton;
class QVBoxLayout;

namespace patina::editor {

class AttachedBakes;
class BakeSettingsForm;
class JobRow;

class BakePanel : public QWidget {
    Q_OBJECT
  public:
    BakePanel(DocumentController& controller, BakeService& bakes, JobManager& jobs,
              QWidget* parent = nullptr);

    // Starts a bake of radiance transfer per vertex with the form's settings, with bounces where
    // they are asked for; elsewhere a button asks for it.
    void bakeTransfer(bool bounces);

  private:
    QWidget* makeLighting();
    void refreshCost();
    void refreshState();
    void refreshQueue();
    void refreshInterrupted();
    void pollQueue();
    void refreshLighting();
    void takeSettings(); // of the bakes that came with another document
    void followBakes();  // that were attached since
    void resume(const BakeRequest& request);

    DocumentController& m_controller;
    BakeService& m_bakes;
    JobManager& m_jobs;
    QTimer m_poll; // progress, while a bake runs

    BakeSettingsForm* m_form;
    QLabel* m_cost;
    QPushButton* m_start;
    QVBoxLayout* m_queue;
    QVBoxLayout* m_interrupted;
    AttachedBakes* m_attached = nullptr;
    QPushButton* m_ibl = nullptr;
    QPushButton* m_prt = nullptr;
    QPushButton *m_lightMap = nullptr, *m_radiosity = nullptr;
    std::map<quint64, JobRow*> m_rows;
    std::map<BakeKind, BakeArtifactPtr> m_followed; // whose settings the form took over last
};

} // namespace patina::editor
