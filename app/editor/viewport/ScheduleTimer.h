// Takes the turns of a schedule in Qt's event loop, as a timer that is as urgent as events are: one
// without a delay would run only when nothing else is queued, which is never where painting a frame
// takes as long as the pace of an animation.
#pragma once

#include <QTimer>

namespace patina::editor {

class FrameSchedule;

class ScheduleTimer : public QTimer {
    Q_OBJECT
  public:
    // It outlives this.
    explicit ScheduleTimer(FrameSchedule& schedule, QObject* parent = nullptr);
    ~ScheduleTimer() override;

  private:
    FrameSchedule& m_schedule;
};

} // namespace patina::editor
