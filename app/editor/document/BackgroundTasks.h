// Work that must not hold up the window (reading files, making built-in content): it runs on a
// thread, and what it found is applied on the UI thread.
#pragma once

#include "core/job/JobContext.h"

#include <QObject>
#include <QString>
#include <QStringList>
#include <QThreadPool>
#include <functional>
#include <map>

namespace patina::editor {

class BackgroundTasks : public QObject {
    Q_OBJECT
  public:
    // Runs on the UI thread when the work is done; empty: nothing to do.
    using Apply = std::function<void()>;
    using Work = std::function<Apply(const JobContext&)>;

    explicit BackgroundTasks(int threads, QObject* parent = nullptr);
    ~BackgroundTasks() override; // cancels everything and waits

    // The newest wins: a task of the same `key` that still runs is cancelled and applies nothing.
    // `activity` is what the status bar says meanwhile ("Opening teapot.obj").
    void start(const QString& key, const QString& activity, Work work);
    // For what must be done, such as saving: one after another in the order of the calls, beside
    // the other tasks. No newer one and no cancelAll() takes it back: it runs, and its result is
    // applied. `work` throws nothing.
    void enqueue(const QString& activity, Work work);
    // But those that must be done, and those of the keys in `but`.
    void cancelAll(const QStringList& but = {});
    // False when something still runs after `milliseconds`. Applies nothing.
    bool waitForDone(int milliseconds);

    [[nodiscard]] bool busy() const;
    [[nodiscard]] QString activity() const; // of the newest task, empty when idle

  Q_SIGNALS:
    void busyChanged();
    void failed(const QString& activity, const QString& reason); // an exception reached the border

  private:
    struct Task {
        QString key, activity;
        JobControl control;
        bool superseded = false;
        bool mustBeDone = false;
    };
    void run(QThreadPool& pool, const QString& key, const QString& activity, bool mustBeDone,
             Work work);
    void finish(quint64 id, const Apply& apply);

    QThreadPool m_pool;
    QThreadPool m_queue; // of one thread
    std::map<quint64, Task> m_running;
    quint64 m_nextId = 1;
};

} // namespace patina::editor
