// How fast a job goes and how long it will take, from what it reported lately: right also for a job
// that went on from a checkpoint, rested, or spent a while preparing.
#pragma once

#include "core/job/JobContext.h"

#include <deque>

namespace patina {

class ProgressRate {
  public:
    static constexpr double kWindow = 8.0; // seconds that the figures rest on

    // To be called a few times a second while the job runs.
    void add(const JobProgress& now);

    [[nodiscard]] double workPerSecond() const; // in units of JobProgress::workUnit; 0: unknown
    [[nodiscard]] double secondsLeft() const;   // negative: unknown

  private:
    struct Sample {
        double seconds, fraction, work;
    };
    std::deque<Sample> m_samples; // oldest first; the oldest stands at or before the window's start
};

} // namespace patina
