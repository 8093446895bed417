// One job in words and a bar, with what can be done about it: pause, priority, stop, cancel.
#pragma once

#include "app/editor/job/JobManager.h"

#include <QPointer>
#include <QWidget>

class QComboBox;
class QLabel;
class QMessageBox;
class QProgressBar;
class QPushButton;

namespace patina::editor {

// Whether a cancel would lose more than a minute of work that a stop would keep.
[[nodiscard]] bool cancelLosesMuch(const JobRecord& record);

class JobRow : public QWidget {
    Q_OBJECT
  public:
    // `names`: prefix of the buttons' object names ("bake": bakePause, bakeStop, bakeCancel).
    JobRow(JobManager& jobs, const JobRecord& record, const QString& names,
           QWidget* parent = nullptr);

    void show(const JobRecord& record);

  private:
    void cancel(); // asks first where much would be lost

    JobManager& m_jobs;
    JobRecord m_record; // that was shown last
    QPointer<QMessageBox> m_question;
    QProgressBar* m_bar;
    QLabel* m_text;
    QComboBox* m_priority;
    QPushButton* m_pause;
    QPushButton* m_stop;
    QPushButton* m_cancel;
};

} // namespace patina::editor
