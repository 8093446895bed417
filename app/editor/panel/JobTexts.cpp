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
    return JobManager::tr("%1 min %2 s").arg(whole / 60).arg(whole % 60, 2, 10, QLatin1Char('0'));
}

QString progressText(const JobRecord& record) {
    QStringList parts;
    parts << JobManager::tr("%1 %").arg(static_cast<int>(record.progress.fraction * 100.0));
    if (record.secondsLeft >= 0.0)
        parts << JobManager::tr("%1 left").arg(durationText(record.secondsLeft));
    if (!record.progress.workUnit.empty() && record.progress.secondsSoFar > 0.2)
        parts << JobManager::tr("%1 M %2/s")
                     .arg(QLocale().toString(record.progress.workDone /
                                                 record.progress.secondsSoFar * 1e-6,
                                             'f', 1),
                          QString::fromStdString(record.progress.workUnit));
    return parts.join(QStringLiteral(" · "));
}

} // namespace patina::editor
