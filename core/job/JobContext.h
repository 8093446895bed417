// How long work talks to whoever started it. The owner keeps a JobControl and may poll progress,
// let the work rest, ask to stop (keep what has converged) or cancel (leave nothing); the work
// receives a JobContext.
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <string>
#include <string_view>

namespace patina {

class WorkGate;

struct JobProgress {
    double fraction = 0.0;   // 0…1 of the whole job
    std::string activity;    // "tracing pass 3 of 6"
    double workDone = 0.0;   // e.g. rays traced so far
    std::string workUnit;    // e.g. "rays"; empty when the job counts nothing
    double secondsSoFar = 0; // wall time since the control was made, rests left out
};

namespace detail {
struct JobState;
}

// Callable from any thread, cheap enough for inner loops: poll at least every 50 ms.
class JobContext {
  public:
    JobContext(); // a context of its own: nobody listens, nobody stops it
    explicit JobContext(std::shared_ptr<detail::JobState> state)
        : m_state(std::move(state)) {}

    [[nodiscard]] bool cancelled() const; // discard everything, return ErrorKind::Cancelled
    [[nodiscard]] bool stopping() const;  // finish with what there is; true when cancelled too
    // Asked to rest, and not to end. parallelFor() sees to it; other long loops call
    // waitWhilePaused(), which returns when the rest is over, or at once where there is none.
    [[nodiscard]] bool paused() const;
    void waitWhilePaused() const;
    // Steps aside for what somebody waits for, where the owner asked for it: between two pieces of
    // work that take well under a millisecond each, with no lock held. parallelFor() does it too.
    void giveWay() const;

    void setProgress(double fraction) const; // clamped to 0…1
    // The same work, whose progress is from `from` to `to` of this one's: a step among several.
    [[nodiscard]] JobContext part(double from, double to) const;
    void setActivity(std::string_view activity) const;
    void addWork(double amount, const char* unit) const;

  private:
    std::shared_ptr<detail::JobState> m_state;
    double m_from = 0.0, m_to = 1.0; // of the whole
};

class JobControl {
  public:
    // `gate`: where the work waits for frames; null: nowhere.
    explicit JobControl(std::shared_ptr<const WorkGate> gate = nullptr);
    [[nodiscard]] JobContext context() const { return JobContext(m_state); }
    [[nodiscard]] JobProgress progress() const;
    void pause(); // work rests within some 50 ms; stop() and cancel() end the rest
    void resume();
    void stop();
    void cancel();
    [[nodiscard]] bool paused() const;
    [[nodiscard]] bool stopping() const;
    [[nodiscard]] bool cancelled() const;
    // Seconds until done, estimated from the progress so far; negative while unknown.
    [[nodiscard]] double secondsLeft() const;

  private:
    std::shared_ptr<detail::JobState> m_state;
};

} // namespace patina
