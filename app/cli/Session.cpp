#include "app/cli/Session.h"

#include "app/cli/Watcher.h"

#include <csignal>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sys/resource.h>

namespace patina::cli {
namespace {

std::size_t peakMemory() {
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    return static_cast<std::size_t>(usage.ru_maxrss) * 1024; // Linux counts KiB
}

std::string signalName(int signal) {
    return signal == SIGINT ? "SIGINT" : "SIGTERM";
}

} // namespace

Session::Session(const CommonOptions& options)
    : m_options(options)
    , m_report(options.command, options.json, options.quiet)
    , m_watcher(std::make_unique<Watcher>(m_options)) {
    if (options.threads > 0)
        m_threads.emplace(options.threads);
}

Session::~Session() = default;

WorkerClient& Session::worker() {
    if (!m_worker) {
        m_worker = std::make_unique<WorkerClient>();
        if (m_options.allowOutside)
            m_worker->allowOutsideOfAll();
        // It starts while models are read.
        if (m_expectsImages)
            m_worker->warmUp(WorkerKind::Image);
    }
    return *m_worker;
}

JobContext Session::job() const {
    return m_watcher->control().context();
}

void Session::beginPhase() {
    m_watcher->beginPhase();
    m_watcher->showProgress();
}

void Session::endProgress() {
    m_watcher->hideProgress();
}

void Session::allowPartialResult() {
    if (m_options.keepPartial)
        m_watcher->allowPartialResult();
}

bool Session::interrupted() const {
    return m_watcher->signal() != 0;
}

void Session::expectCheckpoint(const std::filesystem::path& checkpoint, bool endsInOrder) {
    m_watcher->expectCheckpoint(checkpoint, endsInOrder);
}

int Session::finish(const Result<void>& result) {
    m_watcher->end();
    nlohmann::ordered_json& json = m_report.json();
    const JobProgress progress = m_watcher->control().progress();
    json["seconds"] =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - m_start).count();
    if (!progress.workUnit.empty())
        json[progress.workUnit] = progress.workDone;
    json["threads"] = threadCount();
    json["peakMemoryBytes"] = peakMemory();

    const int signal = m_watcher->signal();
    if (signal == 0)
        return result.ok() ? m_report.succeed()
                           : m_report.fail(result.error(), exitStatus(result.error().kind));
    // Work that was complete when the signal came is done; a partial result is one that says so.
    if (result.ok() && !m_watcher->stoppedEarly())
        return m_report.succeed();
    std::string left = result.ok() ? "what had converged was written" : "nothing was written";
    if (m_checkpoint.empty() && m_options.requeues)
        left += "; run it again";
    else if (!m_checkpoint.empty())
        left = (result.ok() ? left + "; " : std::string()) + "--resume goes on from where it was";
    return m_report.fail({ErrorKind::Cancelled,
                          fmt::format("interrupted by {}; {}", signalName(signal), left),
                          m_checkpoint,
                          {}},
                         m_checkpoint.empty() && !m_options.requeues ? 128 + signal
                                                                     : kStoppedForNow);
}

} // namespace patina::cli
