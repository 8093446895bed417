#include "app/editor/OpenGlProbe.h"

#include "app/editor/Startup.h"
#include "render/gl/Context.h"

#include <QCoreApplication>
#include <QElapsedTimer>
#include <QGuiApplication>
#include <QOffscreenSurface>
#include <QOpenGLContext>
#include <QOpenGLFramebufferObject>
#include <QOpenGLFunctions>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <string>
#include <string_view>
#include <sys/wait.h>
#include <unistd.h>

extern char** environ; // of unistd.h, which declares it only for GNU programs

namespace patina::editor {
namespace {

constexpr std::string_view kOption = "--probe-opengl";
constexpr std::string_view kWorks = "works\n";
constexpr std::string_view kNoDisplay = "no display\n"; // which the editor's own start will name
constexpr int kLongestMs = 30'000;                      // a driver may have to compile itself first

// A context like the viewport's that draws something: its problem, or nothing.
std::optional<std::string> findProblem() {
    const QString platform = QGuiApplication::platformName();
    if (platform == QLatin1String("offscreen") || platform == QLatin1String("minimal"))
        return "Qt's platform \"" + platform.toStdString() + "\", which shows no OpenGL";
    QOffscreenSurface surface;
    surface.create();
    QOpenGLContext context;
    if (!context.create())
        return "no OpenGL driver that works";
    if (!context.makeCurrent(&surface))
        return "an OpenGL driver that does not start";
    const auto adopted = gl::Context::adoptCurrent();
    if (!adopted)
        return adopted.error().detail.empty() ? adopted.error().message : adopted.error().detail;
    QOpenGLFramebufferObject target(4, 4);
    target.bind();
    QOpenGLFunctions* gl = context.functions();
    gl->glClearColor(0.0f, 1.0f, 0.0f, 1.0f);
    gl->glClear(GL_COLOR_BUFFER_BIT);
    std::array<unsigned char, 4> pixel{};
    gl->glReadPixels(1, 1, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, pixel.data());
    target.release();
    if (pixel[1] != 255 || pixel[0] != 0)
        return (*adopted)->info().renderer + ", which draws wrong colours";
    return std::nullopt;
}

} // namespace

bool OpenGlProbe::isWanted(int argc, char** argv) {
    return argc == 2 && argv[1] == kOption;
}

int OpenGlProbe::run(int argc, char** argv) {
    qInstallMessageHandler([](QtMsgType type, const QMessageLogContext&, const QString&) {
        if (type != QtFatalMsg)
            return;
        std::fputs(kNoDisplay.data(), stdout);
        std::fflush(stdout);
        std::_Exit(kNoOpenGlStatus);
    });
    prepareApplication();
    const QGuiApplication application(argc, argv);
    const std::optional<std::string> problem = findProblem();
    std::fputs(problem ? problem->c_str() : kWorks.data(), stdout);
    std::fflush(stdout);
    // What is still to be freed is the system's; drivers may stumble over it.
    std::_Exit(problem ? kNoOpenGlStatus : 0);
}

OpenGlProbe::OpenGlProbe() {
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0)
        return;
    m_answer = FileDescriptor(ends[0]);
    const FileDescriptor write(ends[1]);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, write.get(), STDOUT_FILENO);
    posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
    std::string program = "/proc/self/exe", option(kOption);
    std::array<char*, 3> arguments{program.data(), option.data(), nullptr};
    if (::posix_spawn(&m_process, program.c_str(), &actions, nullptr, arguments.data(), environ) !=
        0)
        m_process = -1;
    posix_spawn_file_actions_destroy(&actions);
}

OpenGlProbe::~OpenGlProbe() {
    if (m_process <= 0)
        return;
    ::kill(m_process, SIGKILL);
    ::waitpid(m_process, nullptr, 0);
}

std::optional<QString> OpenGlProbe::problem() {
    if (m_process <= 0)
        return std::nullopt; // no process can be started: the window will show
    std::string answer;
    QElapsedTimer clock;
    clock.start();
    while (true) {
        pollfd wait{m_answer.get(), POLLIN, 0};
        const qint64 left = kLongestMs - clock.elapsed();
        if (left <= 0)
            return QCoreApplication::translate("OpenGlProbe",
                                               "an OpenGL driver that does not answer");
        const int ready = ::poll(&wait, 1, static_cast<int>(left));
        if (ready <= 0)
            continue;
        std::array<char, 512> text{};
        const ssize_t count = ::read(m_answer.get(), text.data(), text.size());
        if (count < 0 && errno == EINTR)
            continue;
        if (count <= 0)
            break;
        answer.append(text.data(), static_cast<std::size_t>(count));
    }
    int status = 0;
    ::waitpid(m_process, &status, 0);
    m_process = -1;
    if (answer == kWorks || answer == kNoDisplay)
        return std::nullopt;
    if (!answer.empty())
        return QString::fromStdString(answer);
    if (WIFSIGNALED(status))
        return QCoreApplication::translate("OpenGlProbe", "an OpenGL driver that crashes (%1)")
            .arg(QString::fromLatin1(::strsignal(WTERMSIG(status))));
    return QCoreApplication::translate("OpenGlProbe", "no OpenGL driver that works");
}

QString noOpenGlText(const QString& found) {
    return QCoreApplication::translate(
               "OpenGlProbe",
               "Patina needs OpenGL 4.5, and found: %1.\n"
               "Update the graphics driver. Or use Mesa's OpenGL in software: install it (Debian, "
               "Ubuntu: sudo apt install libgl1-mesa-dri) and start Patina by\n"
               "LIBGL_ALWAYS_SOFTWARE=1 patina-editor")
        .arg(found);
}

} // namespace patina::editor
