#include "app/editor/document/BackgroundTasks.h"

#include <QElapsedTimer>
#include <algorithm>
#include <exception>

namespace patina::editor {

BackgroundTasks::BackgroundTasks(int threads, QObject* parent)
    : QObject(parent) {
    m_pool.setMaxThreadCount(threads);
    m_queue.setMaxThreadCount(1);
}

BackgroundTasks::~BackgroundTasks() {
    for (auto& [id, task] : m_running)
        if (!task.mustBeDone)
            task.control.cancel();
    m_pool.waitForDone();
    m_queue.waitForDone();
}

void BackgroundTasks::start(const QString& key, const QString& activity, Work work) {
    for (auto& [id, task] : m_running) {
        if (!task.mustBeDone && task.key == key) {
            task.superseded = true;
            task.control.cancel();
        }
    }
    run(m_pool, key, activity, false, std::move(work));
}

void BackgroundTasks::enqueue(const QString& activity, Work work) {
    run(m_queue, {}, activity, true, std::move(work));
}

void BackgroundTasks::run(QThreadPool& pool, const QString& key, const QString& activity,
                          bool mustBeDone, Work work) {
    const quint64 id = m_nextId++;
    Task& task = m_running[id];
    task.key = key;
    task.activity = activity;
    task.mustBeDone = mustBeDone;
    // The destructor waits for the pools, so `this` is alive whenever the work runs; a call queued
    // for an object that is gone is dropped by Qt.
    pool.start([this, id, activity, job = task.control.context(), work = std::move(work)] {
        Apply apply;
        try {
            apply = work(job);
        } catch (const std::exception& exception) {
            apply = [this, activity, reason = QString::fromUtf8(exception.what())] {
                Q_EMIT failed(activity, reason);
            };
        }
        QMetaObject::invokeMethod(
            this, [this, id, apply] { finish(id, apply); }, Qt::QueuedConnection);
    });
    Q_EMIT busyChanged();
}

void BackgroundTasks::finish(quint64 id, const Apply& apply) {
    const auto found = m_running.find(id);
    const bool wanted = !found->second.superseded;
    m_running.erase(found);
    if (wanted && apply)
        apply();
    Q_EMIT busyChanged();
}

void BackgroundTasks::cancelAll(const QStringList& but) {
    for (auto& [id, task] : m_running) {
        if (task.mustBeDone || but.contains(task.key))
            continue;
        task.superseded = true;
        task.control.cancel();
    }
    Q_EMIT busyChanged();
}

bool BackgroundTasks::waitForDone(int milliseconds) {
    QElapsedTimer timer;
    timer.start();
    return m_pool.waitForDone(milliseconds) &&
           m_queue.waitForDone(std::max(0, milliseconds - static_cast<int>(timer.elapsed())));
}

bool BackgroundTasks::busy() const {
    return !activity().isEmpty();
}

QString BackgroundTasks::activity() const {
    for (auto task = m_running.rbegin(); task != m_running.rend(); ++task)
        if (!task->second.superseded)
            return task->second.activity;
    return {};
}

} // namespace patina::editor
