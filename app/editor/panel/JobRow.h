// One job in words and a bar, with what can be done about it: pause, priority, stop, cancel.
#pragma once

#include <QWidget>

class QComboBox;
class QLabel;
class QProgressBar;
class QPushButton;

namespace patina::editor {

class JobManager;
struct JobRecord;

class JobRow : public QWidget {
    Q_OBJECT
  public:
    // `names`: prefix of the buttons' object names ("bake": bakePause, bakeStop, bakeCancel).
    JobRow(JobManager& jobs, const JobRecord& record, const QString& names,
           QWidget* parent = nullptr);

    void show(const JobRecord& record);

  private:
    JobManager& m_jobs;
    quint64 m_id;
    bool m_paused = false;
    QProgressBar* m_bar;
    QLabel* m_text;
    QComboBox* m_priority;
    QPushButton* m_pause;
    QPushButton* m_stop;
    QPushButton* m_cancel;
};

} // namespace patina::editor
