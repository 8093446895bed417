#include "app/editor/StartGuard.h"

#include <QCoreApplication>
#include <QSettings>
#include <csignal>

namespace patina::editor {
namespace {

constexpr auto kKey = "start/process"; // its number, while it starts

bool isRunning(qint64 process) {
    return ::kill(static_cast<pid_t>(process), 0) == 0;
}

} // namespace

StartGuard::StartGuard() {
    QSettings settings;
    const qint64 last = settings.value(QLatin1String(kKey)).toLongLong();
    m_lastDied = last > 0 && !isRunning(last);
    settings.setValue(QLatin1String(kKey), QCoreApplication::applicationPid());
    settings.sync(); // before anything can go wrong
}

StartGuard::~StartGuard() {
    arrived();
}

void StartGuard::arrived() {
    QSettings settings;
    if (settings.value(QLatin1String(kKey)).toLongLong() == QCoreApplication::applicationPid())
        settings.remove(QLatin1String(kKey));
}

QString StartGuard::text() {
    return QCoreApplication::translate(
        "StartGuard",
        "Patina ended while it was starting last time. All docks are where they were "
        "at first, in case one of them was the reason; the menu View opens the others.");
}

} // namespace patina::editor
