#include "core/worker/WorkerProcess.h"

#include "core/base/ChildAttributes.h"
#include "core/worker/WorkerProtocol.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <spawn.h>
#include <string>
#include <string_view>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

namespace patina {

namespace {

// The worker gets what its loader and a sanitizer need, and nothing of what the user's environment
// holds beyond that: tokens, paths, addresses of buses and agents.
std::vector<char*> workerEnvironment() {
    constexpr std::array<std::string_view, 5> kKept = {
        "LD_LIBRARY_PATH=", "ASAN_OPTIONS=", "LSAN_OPTIONS=", "TSAN_OPTIONS=", "UBSAN_OPTIONS="};
    std::vector<char*> kept;
    for (char** entry = environ; entry != nullptr && *entry != nullptr; ++entry)
        if (std::any_of(kKept.begin(), kKept.end(), [&](std::string_view name) {
                return std::string_view(*entry).starts_with(name);
            }))
            kept.push_back(*entry);
    kept.push_back(nullptr);
    return kept;
}

} // namespace

Result<void> WorkerProcess::ensureRunning(const std::filesystem::path& program) {
    reapIfEnded();
    if (m_pid > 0)
        return {};

    std::array<int, 2> pair{};
    if (::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, pair.data()) != 0)
        return Error{ErrorKind::Internal, "no socket for the program that reads files", program,
                     std::strerror(errno)};
    FileDescriptor mine(pair[0]);
    const FileDescriptor theirs(pair[1]);

    // Nothing but the control socket and standard error is inherited; signal handling starts from
    // the defaults; the worker has a session of its own: no terminal is within its reach, and
    // Ctrl+C comes to Patina first, which may still want to write what has been computed.
    posix_spawn_file_actions_t files{};
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_adddup2(&files, theirs.get(), protocol::kControlFd);
    posix_spawn_file_actions_addclosefrom_np(&files, protocol::kControlFd + 1);
    const ChildAttributes attributes;
    std::string name = program.string();
    std::array<char*, 2> arguments{name.data(), nullptr};
    std::vector<char*> environment = workerEnvironment();
    // From now on files of strangers are near: our memory is not theirs to read. (It also means: no
    // core dump, and a debugger that comes later needs root.)
    ::prctl(PR_SET_DUMPABLE, 0, 0, 0, 0);
    pid_t pid = -1;
    const int failure = ::posix_spawn(&pid, name.c_str(), &files, attributes.get(),
                                      arguments.data(), environment.data());
    posix_spawn_file_actions_destroy(&files);
    if (failure != 0)
        return Error{ErrorKind::Internal,
                     "the program that reads files cannot be started; reinstall Patina", program,
                     std::strerror(failure)};
    m_pid = pid;
    m_control = std::move(mine);
    return {};
}

void WorkerProcess::kill() {
    if (m_pid <= 0)
        return;
    m_control.reset();
    ::kill(m_pid, SIGKILL); // not reaped yet, so the id is still the worker's
    while (::waitpid(m_pid, nullptr, 0) < 0 && errno == EINTR) {
    }
    m_pid = -1;
}

void WorkerProcess::reapIfEnded() {
    if (m_pid > 0 && ::waitpid(m_pid, nullptr, WNOHANG) != 0) {
        m_pid = -1;
        m_control.reset();
    }
}

} // namespace patina
