#include "app/worker/Sandbox.h"

#include "app/worker/Landlock.h"
#include "app/worker/SystemCallFilter.h"
#include "app/worker/TrappedCalls.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <linux/capability.h>
#include <string>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

namespace patina::worker {

namespace {

// Bytes of address space that count before the first file is looked at. The sanitizers reserve
// terabytes for their shadow memory; there the limit is on what comes on top.
std::uint64_t reservedAddressSpace() {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    std::uint64_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    return pages * static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
#else
    return 0;
#endif
}

// A sanitizer's report reads the program's own files.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kReportsReadFiles = true;
#else
constexpr bool kReportsReadFiles = false;
#endif

bool limit(__rlimit_resource resource, rlim_t soft, rlim_t hard) {
    rlimit current{};
    if (::getrlimit(resource, &current) != 0)
        return false;
    const rlimit wanted{std::min(soft, current.rlim_max), std::min(hard, current.rlim_max)};
    return ::setrlimit(resource, &wanted) == 0;
}

// Files a decoder may hold open, and threads it may start on top of all that the system runs.
constexpr rlim_t kOpenFiles = 1024;
constexpr rlim_t kThreads = 1024;

// The kernel counts the tasks of the user and not of the process: all of the system's are an upper
// bound of those. 0 when it cannot be read.
rlim_t systemTasks() {
    std::string average;
    std::string tasks; // "4/107": running, all
    std::ifstream stream("/proc/loadavg");
    for (int i = 0; i < 3; ++i)
        stream >> average;
    stream >> tasks;
    const std::size_t slash = tasks.find('/');
    return slash == std::string::npos ? 0 : std::strtoull(tasks.c_str() + slash + 1, nullptr, 10);
}

// What root may do beyond other users.
bool dropCapabilities() {
    __user_cap_header_struct header{_LINUX_CAPABILITY_VERSION_3, 0};
    std::array<__user_cap_data_struct, _LINUX_CAPABILITY_U32S_3> sets{};
    return ::syscall(SYS_capset, &header, sets.data()) == 0;
}

} // namespace

std::string confine(std::uint64_t memoryBytes, double cpuSeconds, int landlock) {
    // One second after the soft limit's SIGXCPU, which names the cause, the kernel kills.
    const auto seconds = static_cast<rlim_t>(std::max(1.0, std::ceil(cpuSeconds)));
    const rlim_t addressSpace = reservedAddressSpace() + memoryBytes;
    if (!limit(RLIMIT_CORE, 0, 0) || !limit(RLIMIT_CPU, seconds, seconds + 1) ||
        !limit(RLIMIT_FSIZE, memoryBytes, memoryBytes) ||
        !limit(RLIMIT_AS, addressSpace, addressSpace))
        return std::string("setrlimit: ") + std::strerror(errno);
    const rlim_t tasks = systemTasks();
    if (tasks == 0)
        return "/proc/loadavg cannot be read";
    if (!limit(RLIMIT_NPROC, tasks + kThreads, tasks + kThreads) ||
        !limit(RLIMIT_NOFILE, kOpenFiles, kOpenFiles))
        return std::string("setrlimit: ") + std::strerror(errno);
    if (!dropCapabilities())
        return std::string("capset: ") + std::strerror(errno);
    if (::prctl(PR_SET_DUMPABLE, 0, 0, 0, 0) != 0 || ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0)
        return std::string("prctl: ") + std::strerror(errno);
    if (!kReportsReadFiles) {
        if (landlock > 0)
            if (std::string failure = giveUpFiles(landlock); !failure.empty())
                return failure;
        if (std::string failure = handleTrappedCalls(); !failure.empty())
            return failure;
    }
    return filterSystemCalls();
}

} // namespace patina::worker
