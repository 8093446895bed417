#include "app/cli/Watcher.h"

#include "app/cli/EarlySignals.h"
#include "app/cli/Report.h"
#include "core/base/FileNaming.h"
#include "core/base/PrintableText.h"

#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <fcntl.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <poll.h>
#include <unistd.h>

namespace patina::cli {
namespace {

constexpr int kFrameMs = 100;
// Work that polls for a cancel ends within this time; what does not (a decoder, a driver) is left
// behind. Nothing has its final name before it is complete, so leaving is safe.
constexpr int kPatienceMs = 400;
constexpr std::chrono::seconds kNamingPatience{1};
constexpr char kEnd = 0; // through the pipe: the watcher's work is done

// The only thing a signal handler may touch: where to send the signal's number.
std::atomic<int> signalPipe = -1; // NOLINT: signal handlers have no other way to their object

void handleSignal(int signal) {
    const int savedErrno = errno;
    const char number = static_cast<char>(signal);
    if (::write(signalPipe.load(), &number, 1) < 0) {
        // The pipe is full of signals already.
    }
    errno = savedErrno;
}

std::string timeText(double seconds) {
    const auto whole = static_cast<long>(std::ceil(seconds));
    if (whole < 100)
        return fmt::format("{} s", whole);
    return fmt::format("{} min {:02} s", whole / 60, whole % 60);
}

// "12.3 Mrays/s"
std::string rateText(const JobProgress& progress) {
    if (progress.workUnit.empty() || progress.secondsSoFar <= 0)
        return {};
    double rate = progress.workDone / progress.secondsSoFar;
    const char* prefix = "";
    for (const char* larger : {"k", "M", "G"}) {
        if (rate < 1000)
            break;
        rate /= 1000;
        prefix = larger;
    }
    return fmt::format("{:.3g} {}{}/s", rate, prefix, progress.workUnit);
}

std::string statusText(const JobProgress& progress, double secondsLeft) {
    std::string text = fmt::format("{:3.0f} %", progress.fraction * 100);
    if (!progress.activity.empty())
        text += "  " + progress.activity;
    if (const std::string rate = rateText(progress); !rate.empty())
        text += "  " + rate;
    if (secondsLeft >= 0 && progress.fraction < 1)
        text += "  " + timeText(secondsLeft) + " left";
    return text;
}

} // namespace

Watcher::Watcher(const CommonOptions& options)
    : m_options(options)
    , m_terminal(::isatty(STDERR_FILENO) == 1) {
    if (::pipe2(m_pipe, O_CLOEXEC | O_NONBLOCK) != 0)
        return; // no descriptors are left: signals end the program, and no progress is shown
    signalPipe = m_pipe[1];
    struct sigaction action {};
    action.sa_handler = handleSignal;
    action.sa_flags = SA_RESTART;
    ::sigaction(SIGINT, &action, &m_previousInt);
    ::sigaction(SIGTERM, &action, &m_previousTerm);
    if (const int early = EarlySignals::take(); early != 0)
        handleSignal(early);
    m_thread = std::thread([this] { run(); });
}

Watcher::~Watcher() {
    end();
    if (m_pipe[0] < 0)
        return;
    ::sigaction(SIGINT, &m_previousInt, nullptr);
    ::sigaction(SIGTERM, &m_previousTerm, nullptr);
    signalPipe = -1;
    ::close(m_pipe[0]);
    ::close(m_pipe[1]);
}

void Watcher::beginPhase() {
    const std::lock_guard lock(m_mutex);
    const bool cancelled = m_control.cancelled();
    m_control = JobControl();
    m_lastStep = -1;
    if (cancelled)
        m_control.cancel();
}

JobControl Watcher::control() const {
    const std::lock_guard lock(m_mutex);
    return m_control;
}

void Watcher::expectCheckpoint(std::filesystem::path checkpoint, bool endsInOrder) {
    const std::lock_guard lock(m_mutex);
    m_checkpoint = std::move(checkpoint);
    m_endsInOrder = endsInOrder;
}

void Watcher::end() {
    if (!m_thread.joinable())
        return;
    while (::write(m_pipe[1], &kEnd, 1) < 0 && errno == EAGAIN)
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    m_thread.join();
    clearBar();
}

void Watcher::run() {
    pollfd ready{m_pipe[0], POLLIN, 0};
    while (true) {
        const int count = ::poll(&ready, 1, kFrameMs);
        char what = kEnd;
        if (count > 0 && ::read(m_pipe[0], &what, 1) == 1) {
            if (what == kEnd)
                return;
            if (!onSignal(what)) {
                // Give the work its time to end in order.
                ready.revents = 0;
                while (::poll(&ready, 1, kPatienceMs) > 0 && ::read(m_pipe[0], &what, 1) == 1)
                    if (what == kEnd)
                        return;
                leave();
            }
        }
        update();
    }
}

bool Watcher::onSignal(int signal) {
    const std::lock_guard lock(m_mutex);
    int none = 0;
    const bool first = m_signal.compare_exchange_strong(none, signal);
    if (first && m_partialAllowed) {
        m_stoppedEarly = true;
        m_control.stop();
        return true;
    }
    m_stoppedEarly = false;
    m_control.cancel();
    return first && m_endsInOrder;
}

// The work does not end: nothing of it has its final name, so that leaving is safe.
void Watcher::leave() {
    clearBar();
    const std::lock_guard lock(m_mutex);
    std::error_code ignored;
    const bool kept = !m_checkpoint.empty() && std::filesystem::exists(m_checkpoint, ignored);
    const int status = kept || m_options.requeues ? kStoppedForNow : 128 + m_signal;
    const std::string message =
        kept ? "interrupted; --resume goes on from " + m_checkpoint.filename().string()
        : m_options.requeues ? "interrupted; nothing was written; run it again"
                             : "interrupted; nothing was written";
    if (m_options.json)
        fmt::print("{}\n", printableJson(
                               nlohmann::ordered_json{{"command", m_options.command},
                                                      {"error",
                                                       {{"kind", "cancelled"},
                                                        {"message", message},
                                                        {"file", kept ? m_checkpoint.string() : ""},
                                                        {"exitStatus", status}}}}
                                   .dump(-1, ' ', false,
                                         nlohmann::ordered_json::error_handler_t::replace)));
    fmt::print(stderr, "patina: {}\n", printableLine(message));
    std::fflush(stdout);
    static_cast<void>(stopFileNaming(kNamingPatience));
    ::_exit(status);
}

void Watcher::update() {
    if (!m_showsProgress || m_options.quiet)
        return;
    const JobControl job = control();
    const JobProgress progress = job.progress();
    if (progress.fraction <= 0)
        return;
    const std::string status = printableLine(statusText(progress, job.secondsLeft()));
    if (m_terminal) {
        constexpr int kBarWidth = 24;
        const int full = static_cast<int>(progress.fraction * kBarWidth);
        fmt::print(stderr, "\r\x1b[K[{}{}] {}", std::string(static_cast<std::size_t>(full), '#'),
                   std::string(static_cast<std::size_t>(kBarWidth - full), '-'), status);
        std::fflush(stderr);
        m_barShown = true;
    } else if (const int step = static_cast<int>(progress.fraction * 20); step > m_lastStep) {
        fmt::print(stderr, "patina {}: {}\n", m_options.command, status);
        m_lastStep = step;
    }
}

void Watcher::clearBar() {
    if (m_barShown)
        fmt::print(stderr, "\r\x1b[K");
    m_barShown = false;
}

} // namespace patina::cli
