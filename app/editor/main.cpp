// patina-editor: the window.

#include "app/editor/FileFlow.h"
#include "app/editor/MainWindow.h"
#include "app/editor/OpenGlProbe.h"
#include "app/editor/Recovery.h"
#include "app/editor/Session.h"
#include "app/editor/StartGuard.h"
#include "app/editor/Startup.h"
#include "app/editor/StartupMessages.h"
#include "app/editor/TerminationWatch.h"
#include "app/editor/document/UserNotice.h"
#include "app/editor/style/Style.h"
#include "app/editor/viewport/ViewportWidget.h"
#include "core/base/PrintableText.h"

#include <QApplication>
#include <QCommandLineParser>
#include <QIcon>
#include <QMessageBox>
#include <QSettings>
#include <QTimer>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <optional>

namespace {

using patina::editor::kNoOpenGlStatus;

// Files that are still being read when the user leaves get this long to come to an end.
constexpr std::chrono::milliseconds kPatience(1500);
// What docks read as they are shown has been read by then, also on a slow machine.
constexpr std::chrono::seconds kStart(20);

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

// Of the last time, less what may have ended the last start.
void restoreLayout(patina::editor::MainWindow& window, patina::editor::StartGuard& guard,
                   patina::editor::Session& session, bool reset) {
    using namespace patina::editor;
    using LeaveOut = StartGuard::LeaveOut;
    if (reset || guard.leaveOut() == LeaveOut::Layout)
        QSettings().remove(QStringLiteral("window"));
    window.restoreLayout();
    QStringList closed;
    if (guard.leaveOut() == LeaveOut::OpenedDocks) {
        closed = window.closeOpenedDocks();
        if (closed.isEmpty()) { // it was another part of the layout, or none
            guard.leaveOutLayout();
            QSettings().remove(QStringLiteral("window"));
            window.restoreLayout();
        }
    }
    if (guard.leaveOut() == LeaveOut::Nothing)
        return;
    UserNotice notice;
    notice.kind = NoticeKind::Warning;
    notice.text = StartGuard::text(closed);
    notice.about = NoticeAbout::Program;
    Q_EMIT session.controller.noticed(notice);
}

// Without OpenGL there is no picture, and without a picture no editor.
int endWithoutOpenGl(const QString& text, bool dialog) {
    std::fprintf(stderr, "patina-editor: %s\n", patina::printableText(text.toStdString()).c_str());
    if (dialog)
        QMessageBox::critical(nullptr, QCoreApplication::translate("main", "Patina"), text);
    return kNoOpenGlStatus;
}

} // namespace

int main(int argc, char* argv[]) {
    using namespace patina::editor;
    TerminationWatch watch;
    std::signal(SIGXFSZ, SIG_IGN); // a write beyond the limit is an error that is told, not the end
    if (OpenGlProbe::isWanted(argc, argv))
        return OpenGlProbe::run(argc, argv);
    OpenGlProbe probe; // while what needs no OpenGL is made
    prepareApplication();
    QCommandLineParser parser;
    describe(parser);
    if (displayIsMissing()) {
        const QCoreApplication application(argc, argv);
        parser.process(application); // --help and --version need no display
        std::fputs("patina-editor: there is no display (DISPLAY and WAYLAND_DISPLAY are empty). "
                   "Start it on a desktop, or use 'patina render' and 'patina bake'.\n",
                   stderr);
        return kNoOpenGlStatus;
    }
    const std::optional<QString> noOpenGl = probe.problem();
    if (noOpenGl) { // nor may anything touch the driver that is only to show a message
        QCoreApplication::setAttribute(Qt::AA_ShareOpenGLContexts, false);
        qputenv("QT_XCB_GL_INTEGRATION", "none");
    }
    std::optional<StartupMessages> messages(std::in_place);
    QApplication application(argc, argv);
    messages.reset();
    QApplication::setWindowIcon(QIcon(QStringLiteral(":/icons/patina.svg")));
    applyStyle(application);
    parser.process(application);

    const bool quits = parser.isSet(QStringLiteral("quit-after-first-frame"));
    if (noOpenGl)
        return endWithoutOpenGl(noOpenGlText(*noOpenGl), !quits);
    watch.atSignal([mark = startMark()] { StartGuard::arrived(mark); }); // no fault of the start
    StartGuard guard(startMark());
    Session session;
    session.worker.warmUp(patina::WorkerKind::Image);
    session.worker.warmUp(patina::WorkerKind::Model);
    int status = 0;
    {
        MainWindow window(session);
        Recovery recovery(session, window, recoveryFolder(), watch);
        restoreLayout(window, guard, session, parser.isSet(QStringLiteral("reset-layout")));
        QTimer::singleShot(kStart, &window, [&guard] { guard.arrived(); });
        if (quits)
            QObject::connect(
                &window.viewport(), &ViewportWidget::frameRendered, &application,
                [&] {
                    if (!session.controller.document().meshes.empty())
                        QApplication::quit();
                },
                Qt::QueuedConnection); // not in the middle of painting
        // Later than that: the driver gave up, or refuses what it promised.
        QString lost;
        QObject::connect(
            &window.viewport(), &ViewportWidget::contextFailed, &application,
            [&](const QString& reason) {
                recovery.keeper().keepNow();
                lost = noOpenGlText(reason);
                if (session.controller.isModified())
                    lost += QStringLiteral("\n\n") +
                            QCoreApplication::translate(
                                "main", "Your unsaved work is kept: Patina offers it when it "
                                        "starts again.");
                QCoreApplication::exit(kNoOpenGlStatus);
            },
            Qt::QueuedConnection); // not in the middle of painting
        // Read and made in the background while the window and OpenGL come up.
        window.files().openFromCommandLine(parser.positionalArguments(),
                                           parser.value(QStringLiteral("environment")));
        window.show();
        if (!quits)
            recovery.offer();
        status = QApplication::exec();
        if (!lost.isEmpty())
            return endWithoutOpenGl(lost, !quits);
        if (!window.isVisible()) // closed by the user, who was asked about what is unsaved
            recovery.leave();
    }
    guard.arrived();
    if (!session.shutDown(kPatience))
        std::_Exit(status); // a hostile file may keep its decoder busy for a minute
    return status;
}
