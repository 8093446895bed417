// From photos to the dialog that makes an HDR of them: by the menu, or by a drop.
#pragma once

#include "core/job/TaskRunner.h"

#include <QObject>
#include <QStringList>
#include <functional>

class QWidget;

namespace patina::editor {

class DocumentController;
class JobManager;

class BracketFlow : public QObject {
    Q_OBJECT
  public:
    BracketFlow(DocumentController& controller, JobManager& jobs, QWidget& window);

    void openWithDialog(); // asks for the photos
    void open(const QStringList& photos);
    // Opens the dialog when the files say different exposures, else calls `otherwise`. They are
    // read in the background.
    void offer(const QStringList& photos, const std::function<void()>& otherwise);

  private:
    DocumentController& m_controller;
    JobManager& m_jobs;
    QWidget& m_window;
    TaskGroup m_tasks; // last: it ends first
};

} // namespace patina::editor
