// The Jobs dock: every running and finished job with progress, time left, stop and cancel.
#pragma once

#include <QTimer>
#include <QWidget>
#include <map>

class QLabel;
class QProgressBar;
class QPushButton;
class QVBoxLayout;

namespace patina::editor {

class JobManager;
struct JobRecord;

class JobsPanel : public QWidget {
    Q_OBJECT
  public:
    explicit JobsPanel(JobManager& jobs, QWidget* parent = nullptr);

  private:
    struct Row {
        QWidget* widget;
        QLabel* title;
        QProgressBar* bar;
        QLabel* text;
        QPushButton* stop;
        QPushButton* cancel;
    };
    void rebuild();
    void poll();
    Row makeRow(const JobRecord& record);
    static void show(const Row& row, const JobRecord& record);

    JobManager& m_jobs;
    QTimer m_timer;
    QVBoxLayout* m_rows;
    QLabel* m_empty;
    QPushButton* m_clear;
    std::map<quint64, Row> m_shown;
};

} // namespace patina::editor
