#include "KilledRun.h"

#include <csignal>
#include <cstdlib>
#include <sys/stat.h>
#include <sys/wait.h>
#include <thread>
#include <unistd.h>

namespace patina::test {

bool killAfterACheckpoint(const std::vector<std::string>& arguments,
                          const std::filesystem::path& checkpoint,
                          std::chrono::microseconds delay) {
    const std::string program = std::string(std::getenv("PATINA_BIN_DIR")) + "/patina";
    std::vector<std::string> words{program};
    words.insert(words.end(), arguments.begin(), arguments.end());
    std::vector<char*> argv;
    for (std::string& word : words)
        argv.push_back(word.data());
    argv.push_back(nullptr);
    struct stat before {};
    const bool was = ::stat(checkpoint.c_str(), &before) == 0;
    const pid_t child = ::fork();
    if (child == 0) {
        ::execv(program.c_str(), argv.data());
        ::_exit(127);
    }
    int status = 0;
    for (struct stat now{}; ::waitpid(child, &status, WNOHANG) == 0;) {
        if (::stat(checkpoint.c_str(), &now) == 0 &&
            (!was || now.st_ino != before.st_ino ||
             now.st_mtim.tv_nsec != before.st_mtim.tv_nsec)) {
            std::this_thread::sleep_for(delay);
            ::kill(child, SIGKILL);
            ::waitpid(child, &status, 0);
            return WIFSIGNALED(status);
        }
        std::this_thread::sleep_for(std::chrono::microseconds(500));
    }
    return false;
}

} // namespace patina::test
