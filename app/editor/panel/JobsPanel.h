// The Jobs dock: every running and finished job with progress, time left, stop and cancel.
#pragma once

#include <QWidget>

namespace patina::editor {

class JobManager;

class JobsPanel : public QWidget {
    Q_OBJECT
  public:
    explicit JobsPanel(JobManager& jobs, QWidget* parent = nullptr);
};

} // namespace patina::editor
