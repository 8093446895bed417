// The Bake dock: what to bake, how finely, start, progress, stop, cancel; which bakes are attached
// and whether they still belong to the geometry; IBL or PRT lighting.
#pragma once

#include "app/editor/job/BakeRunner.h"

#include <QTimer>
#include <QWidget>

class QButtonGroup;
class QComboBox;
class QDoubleSpinBox;
class QFormLayout;
class QLabel;
class QProgressBar;
class QPushButton;
class QVBoxLayout;

namespace patina::editor {

class BakePanel : public QWidget {
    Q_OBJECT
  public:
    BakePanel(DocumentController& controller, JobManager& jobs, QWidget* parent = nullptr);

    [[nodiscard]] BakeRunner& runner() { return m_runner; }

  private:
    QWidget* makeSettings();
    QWidget* makeProgress();
    void start();
    void refreshSettings();
    void refreshState();
    void refreshProgress();
    void refreshAttached();
    void refreshLighting();
    [[nodiscard]] BakeRequest request() const;
    [[nodiscard]] QString estimate() const; // "49,152 vertices × 256 rays = 12.6 million rays"

    DocumentController& m_controller;
    JobManager& m_jobs;
    BakeRunner m_runner;
    QTimer m_poll; // progress, 30 times a second while a bake runs

    QFormLayout* m_form = nullptr;
    QComboBox* m_kind = nullptr;
    QComboBox* m_samples = nullptr;
    QComboBox* m_order = nullptr;
    QComboBox* m_size = nullptr;
    QDoubleSpinBox* m_distance = nullptr;
    QLabel* m_estimate = nullptr;
    QWidget* m_progress = nullptr; // with stop and cancel; in the place of the start button
    QPushButton* m_start = nullptr;
    QPushButton* m_stop = nullptr;
    QPushButton* m_cancel = nullptr;
    QProgressBar* m_bar = nullptr;
    QLabel* m_progressText = nullptr;
    QVBoxLayout* m_attached = nullptr;
    QPushButton* m_ibl = nullptr;
    QPushButton* m_prt = nullptr;
};

} // namespace patina::editor
