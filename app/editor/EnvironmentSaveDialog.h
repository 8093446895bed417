// Asks how the environment is to be written to a file, and writes it as a job.
#pragma once

#include "core/scene/EnvironmentSave.h"

#include <QDialog>

class QCheckBox;
class QComboBox;
class QLabel;
class QSpinBox;

namespace patina::editor {

class DocumentController;
class JobManager;
class OutputFile;

class EnvironmentSaveDialog : public QDialog {
    Q_OBJECT
  public:
    EnvironmentSaveDialog(DocumentController& controller, JobManager& jobs,
                          QWidget* parent = nullptr);

  private:
    QWidget* makeSettings();
    void layoutChosen();
    void refresh(); // shows what will be written, or why not
    void run();
    [[nodiscard]] EnvironmentSaveSettings settings() const;

    DocumentController& m_controller;
    JobManager& m_jobs;
    OutputFile* m_output;
    QComboBox* m_layout = nullptr;
    QSpinBox* m_size = nullptr;
    QCheckBox* m_asShown = nullptr;
    QCheckBox* m_envmap = nullptr;
    QLabel* m_summary = nullptr;
};

} // namespace patina::editor
