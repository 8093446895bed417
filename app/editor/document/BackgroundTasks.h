// Work that must not hold up the window (reading files, making built-in content): it runs in the
// background, and what it found is applied on the UI thread. Says what is being done.
#pragma once

#include "core/job/TaskRunner.h"

#include <QObject>
#include <QString>
#include <QStringList>
#include <functional>
#include <utility>

namespace patina::editor {

class BackgroundTasks : public QObject {
    Q_OBJECT
  public:
    // Runs on the UI thread when the work is done; empty: nothing to do.
    using Apply = std::function<void()>;
    using Work = std::function<Apply(const JobContext&)>;

    explicit BackgroundTasks(TaskRunner& runner, QObject* parent = nullptr);

    // The newest wins: a task of the same `key` that still runs is cancelled and applies nothing.
    // `activity` is what the status bar says meanwhile ("Opening teapot.obj").
    void start(const QString& key, const QString& activity, Work work);
    // For what must be done, such as saving: one after another in the order of the calls, beside
    // the other tasks. No newer one and no cancelAll() takes it back: it runs, and its result is
    // applied, `apply(Result<T>)` of what `work(const JobContext&)` returned or threw.
    template <class MustWork, class MustApply>
    void enqueue(const QString& activity, MustWork work, MustApply apply) {
        m_tasks.run({.tag = "must be done",
                     .policy = TaskPolicy::Exclusive,
                     .priority = TaskPriority::High, // whatever else waits for a disk
                     .name = activity.toStdString()},
                    std::move(work), std::move(apply));
    }
    // But those that must be done, and those whose keys begin with one of `but`.
    void cancelAll(const QStringList& but = {});

    [[nodiscard]] bool busy() const { return m_tasks.busy(); }
    [[nodiscard]] QString activity() const; // of the newest task, empty when idle

  Q_SIGNALS:
    void busyChanged();
    void failed(const QString& activity, const QString& reason); // an exception reached the border

  private:
    TaskGroup m_tasks;
};

} // namespace patina::editor
