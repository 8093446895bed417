#include "CommandRunner.h"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fcntl.h>
#include <fstream>
#include <gtest/gtest.h>
#include <poll.h>
#include <regex>
#include <sstream>
#include <sys/wait.h>
#include <unistd.h>

namespace patina::test {
namespace {

// Appends what is ready; false at the end of the stream.
bool drain(int fd, std::string& text) {
    char buffer[4096];
    const ssize_t count = ::read(fd, buffer, sizeof buffer);
    if (count > 0)
        text.append(buffer, static_cast<std::size_t>(count));
    return count > 0;
}

} // namespace

Outcome runPatina(const std::vector<std::string>& arguments, const RunOptions& options) {
    std::string program = options.program;
    if (program.empty()) {
        const char* folder = std::getenv("PATINA_BIN_DIR");
        if (folder == nullptr) {
            ADD_FAILURE() << "run through ctest, or set PATINA_BIN_DIR";
            return {};
        }
        program = std::string(folder) + "/patina";
    }
    std::vector<std::string> words = {program};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> argv;
    for (std::string& word : words)
        argv.push_back(word.data());
    argv.push_back(nullptr);

    int out[2], err[2];
    EXPECT_EQ(::pipe2(out, O_CLOEXEC), 0);
    EXPECT_EQ(::pipe2(err, O_CLOEXEC), 0);
    const auto start = std::chrono::steady_clock::now();
    const pid_t child = ::fork();
    if (child == 0) {
        ::dup2(out[1], STDOUT_FILENO);
        ::dup2(err[1], STDERR_FILENO);
        for (const auto& [name, value] : options.environment)
            value ? ::setenv(name.c_str(), value->c_str(), 1) : ::unsetenv(name.c_str());
        ::execv(program.c_str(), argv.data());
        ::_exit(127);
    }
    ::close(out[1]);
    ::close(err[1]);

    Outcome outcome;
    bool signalled = options.signal == 0 && !options.when;
    const std::regex signalWhen(options.signalWhen);
    pollfd streams[2] = {{out[0], POLLIN, 0}, {err[0], POLLIN, 0}};
    while (streams[0].fd >= 0 || streams[1].fd >= 0) {
        ::poll(streams, 2, -1);
        if (streams[0].revents != 0 && !drain(out[0], outcome.out))
            streams[0].fd = -1;
        if (streams[1].revents != 0 && !drain(err[0], outcome.err))
            streams[1].fd = -1;
        if (!signalled && std::regex_search(outcome.err, signalWhen)) {
            if (options.when)
                options.when();
            else
                ::kill(child, options.signal);
            signalled = true;
        }
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    outcome.seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    outcome.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    ::close(out[0]);
    ::close(err[0]);
    return outcome;
}

TemporaryFolder::TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "patina-test-XXXXXX").string();
    EXPECT_NE(::mkdtemp(name.data()), nullptr);
    m_path = name;
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(m_path, ignored);
}

std::vector<std::string> TemporaryFolder::files() const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(m_path))
        names.push_back(entry.path().filename().string());
    std::sort(names.begin(), names.end());
    return names;
}

std::string readBytes(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    EXPECT_TRUE(stream.good()) << file;
    std::ostringstream text;
    text << stream.rdbuf();
    return text.str();
}

void writeBytes(const std::filesystem::path& file, const std::string& data) {
    std::ofstream(file, std::ios::binary) << data;
}

} // namespace patina::test
