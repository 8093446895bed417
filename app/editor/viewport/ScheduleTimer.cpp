#include "app/editor/viewport/ScheduleTimer.h"

#include "app/editor/viewport/FrameSchedule.h"

#include <algorithm>
#include <cmath>

namespace patina::editor {

ScheduleTimer::ScheduleTimer(FrameSchedule& schedule, QObject* parent)
    : QTimer(parent)
    , m_schedule(schedule) {
    setSingleShot(true);
    setTimerType(Qt::PreciseTimer); // a coarse one may end a pause early
    connect(this, &QTimer::timeout, this, [this] { m_schedule.turn(); });
    // One that runs is not put off, or whoever wants something all the time would stop it.
    m_schedule.setAlarm([this] {
        const std::optional<double> wait = m_schedule.untilTurn();
        const int milliseconds = wait ? std::max(1, static_cast<int>(std::ceil(*wait))) : 0;
        if (wait && (!isActive() || remainingTime() > milliseconds))
            start(milliseconds);
    });
}

ScheduleTimer::~ScheduleTimer() {
    m_schedule.setAlarm({});
}

} // namespace patina::editor
