// The export dialog: shows exactly what planExport() returns, and runs it as a job.
#pragma once

#include "core/export/Export.h"

#include <QDialog>

class QCheckBox;
class QComboBox;
class QLabel;
class QScrollArea;
class QTableWidget;

namespace patina::editor {

class DocumentController;
class JobManager;
class OutputFile;

class ExportDialog : public QDialog {
    Q_OBJECT
  public:
    ExportDialog(DocumentController& controller, JobManager& jobs, QWidget* parent = nullptr);

    [[nodiscard]] const ExportPlan& plan() const { return m_plan; } // what is shown

  private:
    QWidget* makeSettings();
    void refresh(); // plans anew and shows the plan
    void run();
    [[nodiscard]] ExportSettings settings() const;

    DocumentController& m_controller;
    JobManager& m_jobs;
    ExportPlan m_plan;

    OutputFile* m_output;
    QComboBox* m_textures = nullptr;
    QComboBox* m_size = nullptr;
    QCheckBox* m_bakedAo = nullptr;
    QCheckBox* m_transfer = nullptr;
    QComboBox* m_bands = nullptr; // of the transfer
    QCheckBox* m_lightMap = nullptr;
    QCheckBox* m_lights = nullptr;
    QCheckBox* m_environment = nullptr;
    QCheckBox* m_variants = nullptr;
    QCheckBox* m_visible = nullptr;
    QTableWidget* m_files = nullptr;
    QLabel* m_warnings = nullptr;
    QScrollArea* m_warningsArea = nullptr;
};

} // namespace patina::editor
