// The export dialog: shows exactly what planExport() returns, and runs it as a job.
#pragma once

#include <QDialog>

namespace patina::editor {

class DocumentController;
class JobManager;

class ExportDialog : public QDialog {
    Q_OBJECT
  public:
    ExportDialog(DocumentController& controller, JobManager& jobs, QWidget* parent = nullptr);
};

} // namespace patina::editor
