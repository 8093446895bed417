// patina-editor: the window.

#include "app/editor/FileFlow.h"
#include "app/editor/MainWindow.h"
#include "app/editor/Session.h"
#include "app/editor/Startup.h"
#include "app/editor/style/Style.h"
#include "app/editor/viewport/ViewportWidget.h"

#include <QApplication>
#include <QCommandLineParser>
#include <QIcon>
#include <QSettings>
#include <QTimer>
#include <cstdlib>

namespace {

// Files that are still being read when the user leaves get this long to come to an end.
constexpr int kPatienceMs = 1500;

} // namespace

int main(int argc, char* argv[]) {
    using namespace patina::editor;
    prepareApplication();
    QApplication application(argc, argv);
    QApplication::setWindowIcon(QIcon(QStringLiteral(":/icons/patina.svg")));
    applyStyle(application);

    QCommandLineParser parser;
    parser.setApplicationDescription(QApplication::translate(
        "main", "Author physically based materials and trust what you see."));
    parser.addHelpOption();
    parser.addVersionOption();
    const QCommandLineOption environment(
        QStringLiteral("environment"),
        QApplication::translate("main", "Light the scene with this panorama or builtin:NAME."),
        QStringLiteral("HDR"));
    const QCommandLineOption resetLayout(
        QStringLiteral("reset-layout"),
        QApplication::translate("main", "Put all docks back where they were at first."));
    QCommandLineOption quitAfterFirstFrame(
        QStringLiteral("quit-after-first-frame"),
        QApplication::translate("main", "Quit once the scene is on screen (to time the start)."));
    quitAfterFirstFrame.setFlags(QCommandLineOption::HiddenFromHelp);
    parser.addOptions({environment, resetLayout, quitAfterFirstFrame});
    parser.addPositionalArgument(
        QStringLiteral("FILE"),
        QApplication::translate("main", "Projects, models, environments, images; or builtin:NAME."),
        QStringLiteral("[FILE …]"));
    parser.process(application);

    Session session;
    session.worker.warmUp();
    int status = 0;
    {
        MainWindow window(session);
        if (parser.isSet(resetLayout))
            QSettings().remove(QStringLiteral("window"));
        window.restoreLayout();
        window.show();
        if (parser.isSet(quitAfterFirstFrame))
            QObject::connect(
                &window.viewport(), &ViewportWidget::frameRendered, &application,
                [&] {
                    if (!session.controller.document().meshes.empty())
                        QApplication::quit();
                },
                Qt::QueuedConnection); // not in the middle of painting
        // The window comes first, its content as soon as it is ready.
        QTimer::singleShot(0, &window, [&] {
            window.files().openFromCommandLine(parser.positionalArguments(),
                                               parser.value(environment));
        });
        status = QApplication::exec();
    }
    session.controller.tasks().cancelAll();
    if (!session.controller.tasks().waitForDone(kPatienceMs))
        std::_Exit(status); // a hostile file may keep its decoder busy for a minute
    return status;
}
