#include "core/job/WorkGate.h"

#include <algorithm>

namespace patina {
namespace {

constexpr std::chrono::milliseconds kLook{
    20}; // how often those who wait ask whether they have ended

} // namespace

void WorkGate::close() {
    const std::lock_guard lock(m_mutex); // or who is about to wait would miss what open() tells
    m_closedUntil = (Clock::now() + kLongestClosed).time_since_epoch().count();
}

void WorkGate::open() {
    {
        const std::lock_guard lock(m_mutex);
        m_closedUntil = 0;
    }
    m_opened.notify_all();
}

bool WorkGate::wait(Clock::time_point begin) const {
    std::unique_lock lock(m_mutex);
    const Clock::time_point until(Clock::duration(m_closedUntil.load(std::memory_order_relaxed)));
    const Clock::time_point now = Clock::now(), last = std::min(until, begin + kLongestWait);
    if (now >= last)
        return false;
    m_opened.wait_until(lock, std::min(last, now + kLook));
    return true;
}

} // namespace patina
