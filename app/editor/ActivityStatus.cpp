#include "app/editor/ActivityStatus.h"

#include "app/editor/Session.h"
#include "app/editor/widget/BusyIndicator.h"

#include <algorithm>

namespace patina::editor {
namespace {
constexpr int kProgressMs = 500;
} // namespace

ActivityStatus::ActivityStatus(Session& session, BusyIndicator& indicator, QObject* parent)
    : QObject(parent)
    , m_session(session)
    , m_indicator(indicator) {
    m_progress.setInterval(kProgressMs);
    connect(&m_progress, &QTimer::timeout, this, &ActivityStatus::refresh);
    connect(&session.controller.tasks(), &BackgroundTasks::busyChanged, this,
            &ActivityStatus::refresh);
    connect(&session.nearShadows, &NearShadowUpdater::activityChanged, this,
            &ActivityStatus::refresh);
    connect(&session.radiosity, &RadiosityUpdater::activityChanged, this, &ActivityStatus::refresh);
    connect(&session.jobs, &JobManager::jobsChanged, this, &ActivityStatus::refresh);
    connect(&indicator, &BusyIndicator::clicked, this, [this] {
        if (m_showsJob)
            Q_EMIT jobsWanted();
    });
}

void ActivityStatus::refresh() {
    QString activity = m_session.controller.tasks().activity();
    if (activity.isEmpty())
        activity = m_session.nearShadows.activity();
    if (activity.isEmpty())
        activity = m_session.radiosity.activity();
    m_showsJob = false;
    if (activity.isEmpty()) {
        const std::vector<JobRecord> jobs = m_session.jobs.jobs();
        const auto running = std::ranges::find(jobs, JobState::Running, &JobRecord::state);
        m_showsJob = running != jobs.end();
        if (m_showsJob)
            activity =
                tr("%1 · %2 %")
                    .arg(running->title,
                         QString::number(static_cast<int>(running->progress.fraction * 100.0)));
    } else {
        activity += QStringLiteral("…");
    }
    m_indicator.setActivity(activity, m_showsJob ? tr("Show all jobs") : QString());
    if (!m_showsJob)
        m_progress.stop();
    else if (!m_progress.isActive())
        m_progress.start();
}

} // namespace patina::editor
