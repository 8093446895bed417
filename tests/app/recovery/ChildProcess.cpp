#include "tests/app/recovery/ChildProcess.h"

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <fstream>
#include <stdexcept>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace patina::test {
namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::milliseconds kPoll{10};

} // namespace

ChildProcess::ChildProcess(const std::vector<std::string>& command,
                           const std::map<std::string, std::string>& environment,
                           const std::string& output) {
    // Everything that allocates happens before fork().
    std::vector<char*> arguments;
    for (const std::string& argument : command)
        arguments.push_back(const_cast<char*>(argument.c_str()));
    arguments.push_back(nullptr);
    m_process = ::fork();
    if (m_process < 0)
        throw std::runtime_error("fork failed");
    if (m_process > 0)
        return;
    for (const auto& [name, value] : environment)
        if (value.empty())
            ::unsetenv(name.c_str());
        else
            ::setenv(name.c_str(), value.c_str(), 1);
    const int file = ::open(output.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_APPEND, 0600);
    ::dup2(file, STDOUT_FILENO);
    ::dup2(file, STDERR_FILENO);
    ::execvp(arguments[0], arguments.data());
    ::_exit(127);
}

ChildProcess::~ChildProcess() {
    if (!running())
        return;
    signal(SIGKILL);
    static_cast<void>(wait(60.0));
}

bool ChildProcess::running() {
    if (!m_ended && ::waitpid(m_process, &m_status, WNOHANG) == m_process)
        m_ended = true;
    return !m_ended;
}

void ChildProcess::signal(int number) const {
    ::kill(m_process, number);
}

int ChildProcess::wait(double seconds) {
    const auto end = Clock::now() + std::chrono::duration<double>(seconds);
    while (running()) {
        if (Clock::now() > end)
            return -1;
        std::this_thread::sleep_for(kPoll);
    }
    return WIFSIGNALED(m_status) ? 128 + WTERMSIG(m_status) : WEXITSTATUS(m_status);
}

XServer::XServer(const std::string& folder)
    : m_displayFile(folder + "/display")
    , m_process(
          {"sh", "-c",
           "exec Xvfb -displayfd 3 -screen 0 1280x1024x24 -nolisten tcp 3>'" + m_displayFile + "'"},
          {}, folder + "/Xvfb.log") {
    const auto end = Clock::now() + std::chrono::minutes(1);
    std::string number;
    while (number.empty()) {
        std::ifstream stream(m_displayFile);
        std::string line;
        if (std::getline(stream, line) && !stream.eof())
            number = line;
        else if (Clock::now() > end || !m_process.running())
            throw std::runtime_error("Xvfb did not start");
        else
            std::this_thread::sleep_for(kPoll);
    }
    m_display = ":" + number;
}

void XServer::kill() {
    m_process.signal(SIGKILL);
    static_cast<void>(m_process.wait(60.0));
}

} // namespace patina::test
