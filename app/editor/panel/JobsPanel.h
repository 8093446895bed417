// The Jobs dock: every waiting, running and finished job with progress, time left, priority, pause,
// stop and cancel.
#pragma once

#include <QTimer>
#include <QWidget>
#include <map>

class QLabel;
class QPushButton;
class QVBoxLayout;

namespace patina::editor {

class JobManager;
class JobRow;

class JobsPanel : public QWidget {
    Q_OBJECT
  public:
    explicit JobsPanel(JobManager& jobs, QWidget* parent = nullptr);

  private:
    void rebuild();
    void poll();

    JobManager& m_jobs;
    QTimer m_timer;
    QVBoxLayout* m_rows;
    QLabel* m_empty;
    QPushButton* m_clear;
    std::map<quint64, JobRow*> m_shown;
};

} // namespace patina::editor
