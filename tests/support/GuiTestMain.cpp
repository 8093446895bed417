// main() of the tests with a window: a QApplication in the editor's style, settings and cache in a
// folder of their own, and every warning of Qt a failure. What was computed from an environment is
// found again by all tests in the folder PATINA_LIGHT_CACHE: it is named by what it was made from.

#include "app/editor/Startup.h"
#include "app/editor/style/Style.h"

#include <QApplication>
#include <QDir>
#include <QFile>
#include <QSettings>
#include <QStandardPaths>
#include <QTemporaryDir>
#include <cstdio>
#include <gmock/gmock.h>
#include <mutex>
#include <vector>

namespace {

std::mutex warningsMutex;
std::vector<QString> warnings;

void takeMessage(QtMsgType type, const QMessageLogContext&, const QString& message) {
    std::fprintf(stderr, "Qt: %s\n", qPrintable(message));
    if (type == QtWarningMsg || type == QtCriticalMsg) {
        const std::lock_guard lock(warningsMutex);
        warnings.push_back(message);
    }
}

// A second of a processor at low priority, which nearly every test would wait for.
bool shareLight() {
    const QString shared = qEnvironmentVariable("PATINA_LIGHT_CACHE");
    const QString own = QStandardPaths::writableLocation(QStandardPaths::CacheLocation);
    return shared.isEmpty() || (QDir().mkpath(shared) && QDir().mkpath(own) &&
                                QFile::link(shared, own + QStringLiteral("/ibl")));
}

} // namespace

int main(int argc, char* argv[]) {
    ::testing::InitGoogleMock(&argc, argv);
    qInstallMessageHandler(takeMessage);
    patina::editor::prepareApplication();
#ifdef PATINA_UNSHARED_CONTEXTS // a viewport that changes its window loses its context
    QCoreApplication::setAttribute(Qt::AA_ShareOpenGLContexts, false);
#endif
    QTemporaryDir settings;
    QSettings::setPath(QSettings::NativeFormat, QSettings::UserScope, settings.path());
    qputenv("XDG_CACHE_HOME", QFile::encodeName(settings.path()));
    qputenv("XDG_DATA_HOME", QFile::encodeName(settings.path()));
    QApplication application(argc, argv);
    if (!shareLight()) {
        std::fprintf(stderr, "FAILED: PATINA_LIGHT_CACHE cannot be used\n");
        return 1;
    }
    patina::editor::applyStyle(application);
    const int status = RUN_ALL_TESTS();
    for (const QString& warning : warnings)
        std::fprintf(stderr, "FAILED: Qt warned: %s\n", qPrintable(warning));
    return warnings.empty() ? status : 1;
}
