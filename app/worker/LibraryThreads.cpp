#include "app/worker/LibraryThreads.h"

#include <cstdint>
#include <dlfcn.h>
#include <filesystem>
#include <fstream>
#include <string>
#include <system_error>
#include <thread>
#include <unistd.h>

namespace patina::worker {

namespace {

// log4cplus::shutdownThreadPool(), where the library is loaded: nothing here is linked with it.
void endLog4cplusThreads() {
    using Function = void (*)();
    if (void* symbol = ::dlsym(RTLD_DEFAULT, "_ZN9log4cplus18shutdownThreadPoolEv"))
        reinterpret_cast<Function>(symbol)();
}

// How many other threads this process has, how often they have been given a processor, and whether
// all of them sleep.
struct Others {
    int count = 0;
    std::uint64_t turns = 0;
    bool asleep = true;
};

Others lookAtOthers() {
    Others others;
    const std::string self = std::to_string(::gettid());
    std::error_code ignored;
    for (const auto& task : std::filesystem::directory_iterator("/proc/self/task", ignored)) {
        if (task.path().filename() == self)
            continue;
        ++others.count;
        std::ifstream status(task.path() / "status");
        for (std::string line; std::getline(status, line);) {
            if (line.starts_with("State:"))
                others.asleep = others.asleep && line.find("S (", 6) != std::string::npos;
            else if (line.find("ctxt_switches:") != std::string::npos)
                others.turns += std::stoull(line.substr(line.find(':') + 1));
        }
    }
    return others;
}

} // namespace

bool settleLibraryThreads(std::chrono::milliseconds patience) {
    constexpr auto kPause = std::chrono::milliseconds(5);
    const auto deadline = std::chrono::steady_clock::now() + patience;
    endLog4cplusThreads();
    Others before = lookAtOthers();
    while (before.count > 0) {
        std::this_thread::sleep_for(kPause);
        const Others now = lookAtOthers();
        if (before.asleep && now.asleep && before.turns == now.turns)
            return true;
        if (std::chrono::steady_clock::now() > deadline)
            return false;
        before = now;
    }
    return true;
}

} // namespace patina::worker
