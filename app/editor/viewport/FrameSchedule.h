// Who is next in a viewport, between events: work that somebody waits for (slices of the next
// picture, uploads, thumbnails …) and animations, which have the picture painted again. They take
// turns, one piece of work in each, and none starves another: after a frame, however long it took,
// work that is due has as much time before an animation has the next one painted, and an animation
// whose clock stands has none painted at all. Input is handled between any two turns.
//
// Without Qt's timers: what drives it is told when the next turn is due (setAlarm()), and takes it.
#pragma once

#include <functional>
#include <optional>
#include <vector>

namespace patina::editor {

class FrameSchedule {
  public:
    // Milliseconds on any steady clock; empty: the system's.
    using Clock = std::function<double()>;

    // Work as a timer of a single shot: want() has it done once. Of one owner, and gone with it;
    // without effect once the schedule is gone.
    class Task {
      public:
        Task(FrameSchedule& schedule, std::function<void()> piece);
        ~Task();
        Task(const Task&) = delete;
        Task& operator=(const Task&) = delete;

        void want(double afterMs = 0.0); // in its turn, not before that; again: counted anew
        void drop();
        [[nodiscard]] bool isWanted() const { return m_due.has_value(); }

      private:
        friend class FrameSchedule;
        FrameSchedule* m_schedule; // null: it is gone
        std::function<void()> m_piece;
        std::optional<double> m_due;
    };

    // What moves by itself. `step`: so many milliseconds after it was started, and again until it
    // is stopped or has had a frame painted: true, as something else is to be shown now. Whoever
    // paints that starts it again.
    class Animation {
      public:
        Animation(FrameSchedule& schedule, double paceMs, std::function<bool()> step);
        ~Animation();
        Animation(const Animation&) = delete;
        Animation& operator=(const Animation&) = delete;

        void start(); // without effect while it runs
        void stop();
        [[nodiscard]] bool isRunning() const { return m_due.has_value(); }

      private:
        friend class FrameSchedule;
        FrameSchedule* m_schedule; // null: it is gone
        const double m_paceMs;
        std::function<bool()> m_step;
        std::optional<double> m_due;
    };

    FrameSchedule() = default;
    ~FrameSchedule();
    FrameSchedule(const FrameSchedule&) = delete;
    FrameSchedule& operator=(const FrameSchedule&) = delete;

    void setClock(Clock clock);
    [[nodiscard]] double now() const;

    // Called whenever the time until the next turn has become another.
    void setAlarm(std::function<void()> alarm);
    // Milliseconds until turn() has something to do, 0: now; nothing: it has not.
    [[nodiscard]] std::optional<double> untilTurn() const;
    // A piece of work that is due, or what animations want; one of them.
    void turn();

    // A frame was painted, by whosever wish, and took so long; what it takes to show it may be
    // said later, together with that.
    void framePainted(double milliseconds);

  private:
    [[nodiscard]] bool isDue(const std::optional<double>& due) const;
    [[nodiscard]] Task* nextTask() const;
    void run(Task& task);
    [[nodiscard]] bool stepAnimations();
    void wake();

    Clock m_clock;
    std::function<void()> m_alarm;
    std::vector<Task*> m_tasks;
    std::vector<Animation*> m_animations;
    std::size_t m_turn = 0;    // whose it is, of m_tasks
    double m_owedMs = 0.0;     // to work, before an animation is painted
    int m_pieces = 0;          // of work since the last frame
    bool m_inputFirst = false; // a frame was painted since the last turn …
    bool m_letInput = false;   // … which was input's for that reason
};

} // namespace patina::editor
