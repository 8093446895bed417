// patina-editor: the window.

#include "app/editor/FileFlow.h"
#include "app/editor/MainWindow.h"
#include "app/editor/Recovery.h"
#include "app/editor/Session.h"
#include "app/editor/Startup.h"
#include "app/editor/style/Style.h"
#include "app/editor/viewport/ViewportWidget.h"

#include <QApplication>
#include <QCommandLineParser>
#include <QIcon>
#include <QSettings>
#include <cstdio>
#include <cstdlib>

namespace {

// Files that are still being read when the user leaves get this long to come to an end.
constexpr int kPatienceMs = 1500;
constexpr int kNoDisplay = 69; // EX_UNAVAILABLE, as the command line's "no OpenGL"

void describe(QCommandLineParser& parser) {
    parser.setApplicationDescription(QCoreApplication::translate(
        "main", "Author physically based materials and trust what you see."));
    parser.addHelpOption();
    parser.addVersionOption();
    parser.addOptions(
        {{QStringLiteral("environment"),
          QCoreApplication::translate("main",
                                      "Light the scene with this panorama or builtin:NAME."),
          QStringLiteral("HDR")},
         {QStringLiteral("reset-layout"),
          QCoreApplication::translate("main", "Put all docks back where they were at first.")}});
    QCommandLineOption quitAfterFirstFrame(
        QStringLiteral("quit-after-first-frame"),
        QCoreApplication::translate("main",
                                    "Quit once the scene is on screen (to time the start)."));
    quitAfterFirstFrame.setFlags(QCommandLineOption::HiddenFromHelp);
    parser.addOption(quitAfterFirstFrame);
    parser.addPositionalArgument(
        QStringLiteral("FILE"),
        QCoreApplication::translate("main",
                                    "Projects, models, environments, images; or builtin:NAME."),
        QStringLiteral("[FILE …]"));
}

// Qt ends the process with a core dump when it finds no display; we say what to do.
bool displayIsMissing() {
    return qEnvironmentVariableIsEmpty("DISPLAY") &&
           qEnvironmentVariableIsEmpty("WAYLAND_DISPLAY") &&
           qEnvironmentVariableIsEmpty("QT_QPA_PLATFORM");
}

} // namespace

int main(int argc, char* argv[]) {
    using namespace patina::editor;
    prepareApplication();
    QCommandLineParser parser;
    describe(parser);
    if (displayIsMissing()) {
        const QCoreApplication application(argc, argv);
        parser.process(application); // --help and --version need no display
        std::fputs("patina-editor: there is no display (DISPLAY and WAYLAND_DISPLAY are empty). "
                   "Start it on a desktop, or use 'patina render' and 'patina bake'.\n",
                   stderr);
        return kNoDisplay;
    }
    QApplication application(argc, argv);
    QApplication::setWindowIcon(QIcon(QStringLiteral(":/icons/patina.svg")));
    applyStyle(application);
    parser.process(application);

    Session session;
    session.worker.warmUp();
    int status = 0;
    {
        MainWindow window(session);
        Recovery recovery(session, window, recoveryFolder());
        if (parser.isSet(QStringLiteral("reset-layout")))
            QSettings().remove(QStringLiteral("window"));
        window.restoreLayout();
        if (parser.isSet(QStringLiteral("quit-after-first-frame")))
            QObject::connect(
                &window.viewport(), &ViewportWidget::frameRendered, &application,
                [&] {
                    if (!session.controller.document().meshes.empty())
                        QApplication::quit();
                },
                Qt::QueuedConnection); // not in the middle of painting
        // Read and made in the background while the window and OpenGL come up.
        window.files().openFromCommandLine(parser.positionalArguments(),
                                           parser.value(QStringLiteral("environment")));
        window.show();
        if (!parser.isSet(QStringLiteral("quit-after-first-frame")))
            recovery.offer();
        status = QApplication::exec();
        if (!window.isVisible()) // closed by the user, who was asked about what is unsaved
            recovery.leave();
    }
    session.controller.tasks().cancelAll();
    if (!session.controller.tasks().waitForDone(kPatienceMs))
        std::_Exit(status); // a hostile file may keep its decoder busy for a minute
    return status;
}
