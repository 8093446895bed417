// The Bake dock: what to bake, how finely, start, progress, stop, cancel; stale or fresh.
#pragma once

#include <QWidget>

namespace patina::editor {

class DocumentController;
class JobManager;

class BakePanel : public QWidget {
    Q_OBJECT
  public:
    BakePanel(DocumentController& controller, JobManager& jobs, QWidget* parent = nullptr);
};

} // namespace patina::editor
