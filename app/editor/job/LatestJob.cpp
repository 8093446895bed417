#include "app/editor/job/LatestJob.h"

#include "core/base/Log.h"
#include "core/job/Parallel.h"

#include <exception>
#include <utility>

namespace patina::editor {

LatestJob::LatestJob(const char* what, QObject* parent, Priority priority)
    : QObject(parent)
    , m_what(what)
    , m_priority(priority) {
    m_pool.setMaxThreadCount(1);
}

LatestJob::~LatestJob() {
    m_control.cancel();
    m_pool.waitForDone();
}

void LatestJob::request(Work work) {
    if (m_running)
        m_next = std::move(work);
    else
        start(std::move(work));
}

void LatestJob::cancel() {
    m_control.cancel();
    m_next = nullptr;
    m_running = false;
    ++m_id;
}

void LatestJob::start(Work work) {
    m_control = JobControl();
    m_running = true;
    const quint64 id = ++m_id;
    // The destructor waits for the pool, so `this` is alive whenever the work runs; a call queued
    // for an object that is gone is dropped by Qt.
    m_pool.start([this, id, job = m_control.context(), work = std::move(work)] {
        if (m_priority == Priority::Low)
            lowerThreadPriority();
        Apply apply;
        try {
            apply = work(job);
        } catch (const std::exception& exception) {
            logError("{}: {}", m_what, exception.what());
        }
        QMetaObject::invokeMethod(
            this, [this, id, apply] { finish(id, apply); }, Qt::QueuedConnection);
    });
}

void LatestJob::finish(quint64 id, const Apply& apply) {
    if (id != m_id)
        return;
    m_running = false;
    if (apply)
        apply();
    // The result may itself have asked for more.
    if (!m_running && m_next)
        start(std::exchange(m_next, nullptr));
}

} // namespace patina::editor
