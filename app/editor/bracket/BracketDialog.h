// Makes an HDR picture from photos: shows their exposures, shifts and the response that was found,
// where they are clipped or disagree, and writes the picture, on request also as the environment.
#pragma once

#include "core/bracket/Bracket.h"
#include "core/bracket/BracketPreview.h"
#include "core/job/TaskRunner.h"

#include <QDialog>
#include <QStringList>
#include <QTimer>
#include <memory>
#include <optional>

class QCheckBox;
class QDoubleSpinBox;
class QLabel;

namespace patina::editor {

class BracketPicture;
class BracketTable;
class DocumentController;
class JobManager;
class OutputFile;
class ResponsePlot;

class BracketDialog : public QDialog {
    Q_OBJECT
  public:
    BracketDialog(DocumentController& controller, JobManager& jobs, const QStringList& photos,
                  QWidget* parent = nullptr);

    // Null: not merged yet, or it failed; then message() says why.
    [[nodiscard]] const std::shared_ptr<const Bracket>& result() const { return m_bracket; }
    [[nodiscard]] bool isBusy() const { return m_tasks.busy(); }
    [[nodiscard]] QString message() const;

  private:
    QWidget* makePhotos();
    QWidget* makeResult();
    QWidget* makeOutput();
    void readExposures();
    void merge();
    void showResult();
    void showProgress();
    void refresh(); // of what will be written
    void save();
    [[nodiscard]] bool isPanorama() const;

    DocumentController& m_controller;
    JobManager& m_jobs;
    QStringList m_photos;
    std::shared_ptr<const Bracket> m_bracket;
    std::optional<JobControl> m_running;

    BracketTable* m_table = nullptr;
    QCheckBox* m_align = nullptr;
    ResponsePlot* m_response = nullptr;
    BracketPicture* m_picture = nullptr;
    QDoubleSpinBox* m_exposure = nullptr;
    QCheckBox* m_marks = nullptr;
    QLabel* m_legend = nullptr;
    QLabel* m_warnings = nullptr;
    OutputFile* m_output;
    QCheckBox* m_use = nullptr;
    QLabel* m_summary = nullptr;
    QTimer m_progress;
    TaskGroup m_tasks; // last: it ends first
};

} // namespace patina::editor
