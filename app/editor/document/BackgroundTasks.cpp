#include "app/editor/document/BackgroundTasks.h"

#include <exception>

namespace patina::editor {

BackgroundTasks::BackgroundTasks(int threads, QObject* parent)
    : QObject(parent) {
    m_pool.setMaxThreadCount(threads);
}

BackgroundTasks::~BackgroundTasks() {
    for (auto& [id, task] : m_running)
        task.control.cancel();
    m_pool.waitForDone();
}

void BackgroundTasks::start(const QString& key, const QString& activity, Work work) {
    for (auto& [id, task] : m_running) {
        if (task.key == key) {
            task.superseded = true;
            task.control.cancel();
        }
    }
    const quint64 id = m_nextId++;
    Task& task = m_running[id];
    task.key = key;
    task.activity = activity;
    // The destructor waits for the pool, so `this` is alive whenever the work runs; a call queued
    // for an object that is gone is dropped by Qt.
    m_pool.start([this, id, activity, job = task.control.context(), work = std::move(work)] {
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

void BackgroundTasks::cancelAll() {
    for (auto& [id, task] : m_running) {
        task.superseded = true;
        task.control.cancel();
    }
    Q_EMIT busyChanged();
}

bool BackgroundTasks::waitForDone(int milliseconds) {
    return m_pool.waitForDone(milliseconds);
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
