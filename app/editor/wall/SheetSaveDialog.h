// Asks how the wall is to be saved as a sheet: file and format, size of its cells, captions.
#pragma once

#include <QDialog>

class QCheckBox;
class QLabel;
class QLineEdit;
class QSpinBox;

namespace patina::editor {

class DocumentController;
class JobManager;
class OutputFile;
class ViewportWidget;
class WallState;

class SheetSaveDialog : public QDialog {
    Q_OBJECT
  public:
    SheetSaveDialog(const WallState& wall, ViewportWidget& viewport, DocumentController& controller,
                    JobManager& jobs, QWidget* parent = nullptr);

    // Shows one, which deletes itself when it is closed.
    static void open(const WallState& wall, ViewportWidget& viewport,
                     DocumentController& controller, JobManager& jobs, QWidget* parent);
    using QDialog::open;

  private:
    QWidget* makeSettings();
    void refresh(); // shows what will be written, or why not
    void run();

    const WallState& m_wall;
    ViewportWidget& m_viewport;
    DocumentController& m_controller;
    JobManager& m_jobs;
    OutputFile* m_output;
    QSpinBox* m_width = nullptr;
    QCheckBox* m_captions = nullptr;
    QLineEdit* m_title = nullptr;
    QLabel* m_summary = nullptr;
};

} // namespace patina::editor
