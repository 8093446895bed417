#include "app/worker/LibraryThreads.h"

#include <dlfcn.h>
#include <filesystem>
#include <fstream>
#include <string>
#include <system_error>
#include <thread>
#include <unistd.h>

namespace patina::worker {

namespace {

// The state in "/proc/self/task/*/stat" follows the name in parentheses, which may hold anything.
bool sleeps(const std::filesystem::path& task) {
    std::string text;
    if (!std::getline(std::ifstream(task / "stat"), text))
        return true; // it has ended
    const std::size_t name = text.rfind(')');
    return name != std::string::npos && name + 2 < text.size() && text[name + 2] == 'S';
}

bool othersSleep() {
    const std::string self = std::to_string(::gettid());
    std::error_code ended;
    for (std::filesystem::directory_iterator task("/proc/self/task", ended), end;
         !ended && task != end; task.increment(ended))
        if (task->path().filename() != self && !sleeps(task->path()))
            return false;
    return true;
}

// log4cplus::shutdownThreadPool(), where the library is loaded: nothing here is linked with it.
void endLog4cplusThreads() {
    using Function = void (*)();
    if (void* symbol = ::dlsym(RTLD_DEFAULT, "_ZN9log4cplus18shutdownThreadPoolEv"))
        reinterpret_cast<Function>(symbol)();
}

} // namespace

bool settleLibraryThreads(std::chrono::milliseconds patience) {
    endLog4cplusThreads();
    const auto deadline = std::chrono::steady_clock::now() + patience;
    // Twice in a row: the threads are looked at one after another, and one that waits for another
    // runs again once that has gone to sleep.
    int quiet = 0;
    while (quiet < 2) {
        quiet = othersSleep() ? quiet + 1 : 0;
        if (quiet == 0) {
            if (std::chrono::steady_clock::now() > deadline)
                return false;
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
    }
    return true;
}

} // namespace patina::worker
