#include "core/job/JobContext.h"

#include "core/job/WorkGate.h"

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <optional>
#include <utility>

namespace patina {

namespace detail {
struct JobState {
    using Clock = std::chrono::steady_clock;

    std::shared_ptr<const WorkGate> gate;
    std::atomic<bool> cancelled = false;
    std::atomic<bool> stopping = false;
    std::atomic<bool> pausing = false;
    std::atomic<double> fraction = 0.0;
    std::atomic<double> work = 0.0;
    std::atomic<const char*> unit = nullptr;
    const Clock::time_point start = Clock::now();
    mutable std::mutex mutex; // guards what follows, and the writing of `stopping` and `pausing`
    std::condition_variable restOver;
    std::string activity;
    std::optional<Clock::time_point> restsSince;
    Clock::duration rested{0};

    [[nodiscard]] bool resting() const {
        return pausing.load(std::memory_order_relaxed) && !stopping.load(std::memory_order_relaxed);
    }
    void endRest() { // with the mutex held
        if (restsSince)
            rested += Clock::now() - *restsSince;
        restsSince.reset();
        restOver.notify_all();
    }
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

bool JobContext::paused() const {
    return m_state->resting();
}

void JobContext::waitWhilePaused() const {
    if (!m_state->resting())
        return;
    std::unique_lock lock(m_state->mutex);
    m_state->restOver.wait(lock, [this] { return !m_state->resting(); });
}

void JobContext::giveWay() const {
    if (m_state->gate)
        m_state->gate->pass([this] { return stopping(); });
}

void JobContext::setProgress(double fraction) const {
    m_state->fraction.store(m_from + (m_to - m_from) * std::clamp(fraction, 0.0, 1.0),
                            std::memory_order_relaxed);
}

JobContext JobContext::part(double from, double to) const {
    JobContext result = *this;
    result.m_from = m_from + (m_to - m_from) * std::clamp(from, 0.0, 1.0);
    result.m_to = m_from + (m_to - m_from) * std::clamp(to, 0.0, 1.0);
    return result;
}

void JobContext::setActivity(std::string_view activity) const {
    const std::lock_guard lock(m_state->mutex);
    m_state->activity = activity;
}

void JobContext::addWork(double amount, const char* unit) const {
    m_state->work.fetch_add(amount, std::memory_order_relaxed);
    m_state->unit.store(unit, std::memory_order_relaxed);
}

JobControl::JobControl(std::shared_ptr<const WorkGate> gate)
    : m_state(std::make_shared<detail::JobState>()) {
    m_state->gate = std::move(gate);
}

JobProgress JobControl::progress() const {
    JobProgress result;
    result.fraction = m_state->fraction.load(std::memory_order_relaxed);
    result.workDone = m_state->work.load(std::memory_order_relaxed);
    if (const char* unit = m_state->unit.load(std::memory_order_relaxed))
        result.workUnit = unit;
    const std::lock_guard lock(m_state->mutex);
    const auto until = m_state->restsSince.value_or(detail::JobState::Clock::now());
    result.secondsSoFar =
        std::chrono::duration<double>(until - m_state->start - m_state->rested).count();
    result.activity = m_state->activity;
    return result;
}

void JobControl::pause() {
    const std::lock_guard lock(m_state->mutex);
    m_state->pausing.store(true, std::memory_order_relaxed);
    if (m_state->resting() && !m_state->restsSince)
        m_state->restsSince = detail::JobState::Clock::now();
}

void JobControl::resume() {
    const std::lock_guard lock(m_state->mutex);
    m_state->pausing.store(false, std::memory_order_relaxed);
    m_state->endRest();
}

void JobControl::stop() {
    const std::lock_guard lock(m_state->mutex);
    m_state->stopping.store(true, std::memory_order_relaxed);
    m_state->endRest();
}

void JobControl::cancel() {
    m_state->cancelled.store(true, std::memory_order_relaxed);
    stop();
}

bool JobControl::paused() const {
    return m_state->resting();
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
