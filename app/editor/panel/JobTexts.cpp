#include "app/editor/panel/JobTexts.h"

#include "app/editor/job/JobManager.h"

#include <QLocale>
#include <QStringList>
#include <cmath>

namespace patina::editor {

QString durationText(double seconds) {
    const int whole = static_cast<int>(std::ceil(std::max(seconds, 0.0)));
    if (whole < 60)
        return JobManager::tr("%1 s").arg(whole);
    const auto twoParts = [](const QString& text, int large, int small) {
        return text.arg(large).arg(small, 2, 10, QLatin1Char('0'));
    };
    if (whole < 3600)
        return twoParts(JobManager::tr("%1 min %2 s"), whole / 60, whole % 60);
    return twoParts(JobManager::tr("%1 h %2 min"), whole / 3600, whole / 60 % 60);
}

QString roughDurationText(double seconds) {
    const auto text = [](const QString& unit, double number, int decimals) {
        return unit.arg(QLocale().toString(number, 'f', decimals));
    };
    if (seconds < 10.0)
        return text(JobManager::tr("about %1 s"), std::max(1.0, std::round(seconds)), 0);
    if (seconds < 57.5)
        return text(JobManager::tr("about %1 s"), 5.0 * std::round(seconds / 5.0), 0);
    if (seconds < 57.5 * 60.0)
        return text(JobManager::tr("about %1 min"), std::round(seconds / 60.0), 0);
    const double hours = seconds / 3600.0;
    return text(JobManager::tr("about %1 h"), hours, hours < 9.95 ? 1 : 0);
}

QString progressText(const JobRecord& record) {
    QStringList parts;
    parts << JobManager::tr("%1 %").arg(static_cast<int>(record.progress.fraction * 100.0));
    if (record.secondsLeft >= 0.0)
        parts << JobManager::tr("%1 left").arg(durationText(record.secondsLeft));
    if (!record.progress.workUnit.empty() && record.workPerSecond > 0.0)
        parts << JobManager::tr("%1 M %2/s")
                     .arg(QLocale().toString(record.workPerSecond * 1e-6, 'f', 1),
                          QString::fromStdString(record.progress.workUnit));
    if (!record.progress.activity.empty())
        parts << QString::fromStdString(record.progress.activity);
    return parts.join(QStringLiteral(" · "));
}

QString stateText(const JobRecord& record) {
    if (!record.ended() && record.cancelling)
        return JobManager::tr("Cancelling…");
    if (!record.ended() && record.stopping)
        return JobManager::tr("Stopping; what has converged is kept…");
    switch (record.state) {
    case JobState::Queued:
        return record.begun ? JobManager::tr("%1 · waits for a job of higher priority")
                                  .arg(progressText(record))
                            : JobManager::tr("Waits for its turn");
    case JobState::Paused:
        return record.begun ? JobManager::tr("Paused at %1 %")
                                  .arg(static_cast<int>(record.progress.fraction * 100.0))
                            : JobManager::tr("Paused before it began");
    case JobState::Running:
        return progressText(record);
    case JobState::Done:
        return JobManager::tr("Done in %1. %2")
            .arg(durationText(record.progress.secondsSoFar), record.summary);
    case JobState::Stopped:
        return JobManager::tr("Stopped. Kept: %1").arg(record.summary);
    case JobState::Cancelled:
        return record.summary;
    case JobState::Failed:
        break;
    }
    return JobManager::tr("Failed: %1").arg(record.summary);
}

} // namespace patina::editor
