#include "core/job/JobContext.h"

#include <algorithm>
#include <chrono>

namespace patina {

namespace detail {
struct JobState {
    std::atomic<bool> cancelled = false;
    std::atomic<bool> stopping = false;
    std::atomic<double> fraction = 0.0;
    std::atomic<double> work = 0.0;
    std::atomic<const char*> unit = nullptr;
    const std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
    mutable std::mutex mutex; // guards activity
    std::string activity;
};
} // namespace detail

JobContext::JobContext()
    : m_state(std::make_shared<detail::JobState>()) {}

bool JobContext::cancelled() const {
    return m_state->cancelled.load(std::memory_order_relaxed);
}

bool JobContext::stopping() const {
    return m_state->stopping.load(std::memory_order_relaxed);
}

void JobContext::setProgress(double fraction) const {
    m_state->fraction.store(std::clamp(fraction, 0.0, 1.0), std::memory_order_relaxed);
}

void JobContext::setActivity(std::string_view activity) const {
    const std::lock_guard lock(m_state->mutex);
    m_state->activity = activity;
}

void JobContext::addWork(double amount, const char* unit) const {
    m_state->work.fetch_add(amount, std::memory_order_relaxed);
    m_state->unit.store(unit, std::memory_order_relaxed);
}

JobControl::JobControl()
    : m_state(std::make_shared<detail::JobState>()) {}

JobProgress JobControl::progress() const {
    JobProgress result;
    result.fraction = m_state->fraction.load(std::memory_order_relaxed);
    result.workDone = m_state->work.load(std::memory_order_relaxed);
    if (const char* unit = m_state->unit.load(std::memory_order_relaxed))
        result.workUnit = unit;
    result.secondsSoFar =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - m_state->start).count();
    const std::lock_guard lock(m_state->mutex);
    result.activity = m_state->activity;
    return result;
}

void JobControl::stop() {
    m_state->stopping.store(true, std::memory_order_relaxed);
}

void JobControl::cancel() {
    m_state->cancelled.store(true, std::memory_order_relaxed);
    stop();
}

bool JobControl::stopping() const {
    return m_state->stopping.load(std::memory_order_relaxed);
}

bool JobControl::cancelled() const {
    return m_state->cancelled.load(std::memory_order_relaxed);
}

double JobControl::secondsLeft() const {
    const JobProgress now = progress();
    // Below one per cent the estimate is mostly start-up cost.
    if (now.fraction < 0.01)
        return -1.0;
    return now.secondsSoFar * (1.0 - now.fraction) / now.fraction;
}

} // namespace patina
