#include "core/job/ProgressRate.h"

namespace patina {
namespace {

// Over less than this, the rate is mostly the grain of the reports.
constexpr double kMinSeconds = 0.25;

} // namespace

void ProgressRate::add(const JobProgress& now) {
    if (!m_samples.empty() && now.secondsSoFar <= m_samples.back().seconds)
        return; // it rests
    m_samples.push_back({now.secondsSoFar, now.fraction, now.workDone});
    while (m_samples.size() > 2 && m_samples[1].seconds <= now.secondsSoFar - kWindow)
        m_samples.pop_front();
}

double ProgressRate::workPerSecond() const {
    if (m_samples.size() < 2)
        return 0.0;
    const Sample &first = m_samples.front(), &last = m_samples.back();
    const double seconds = last.seconds - first.seconds;
    return seconds < kMinSeconds ? 0.0 : (last.work - first.work) / seconds;
}

double ProgressRate::secondsLeft() const {
    if (m_samples.size() < 2)
        return -1.0;
    const Sample &first = m_samples.front(), &last = m_samples.back();
    const double seconds = last.seconds - first.seconds, gained = last.fraction - first.fraction;
    if (seconds < kMinSeconds || gained <= 0.0)
        return -1.0;
    return (1.0 - last.fraction) * seconds / gained;
}

} // namespace patina
