// The bakes and exports that run, each on a thread of its own. UI thread only; progress is polled.
#pragma once

#include <QObject>

namespace patina::editor {

class DocumentController;

class JobManager : public QObject {
    Q_OBJECT
  public:
    explicit JobManager(DocumentController& controller, QObject* parent = nullptr);
    ~JobManager() override; // cancels everything and waits

    [[nodiscard]] int runningCount() const;
    void cancelAll();

  Q_SIGNALS:
    void jobsChanged(); // one was started or has ended
};

} // namespace patina::editor
