#include "app/worker/Sandbox.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <linux/capability.h>
#include <sched.h>
#include <seccomp.h>
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

// What root may do beyond other users is given up, but for reading files of any owner.
bool dropCapabilities() {
    __user_cap_header_struct header{_LINUX_CAPABILITY_VERSION_3, 0};
    std::array<__user_cap_data_struct, _LINUX_CAPABILITY_U32S_3> sets{};
    if (::syscall(SYS_capget, &header, sets.data()) != 0)
        return false;
    sets[0].permitted &= 1u << CAP_DAC_READ_SEARCH;
    sets[0].effective &= sets[0].permitted;
    sets[0].inheritable = 0;
    sets[1] = {};
    return ::syscall(SYS_capset, &header, sets.data()) == 0;
}

// System calls a decoder has no use for; they fail with EPERM.
constexpr auto kForbidden = std::to_array<int>({
    // the network
    SCMP_SYS(socket),
    SCMP_SYS(socketpair),
    SCMP_SYS(connect),
    SCMP_SYS(bind),
    SCMP_SYS(listen),
    SCMP_SYS(accept),
    SCMP_SYS(accept4),
    SCMP_SYS(sendto),
    SCMP_SYS(sendmmsg),
    // other programs and processes
    SCMP_SYS(execve),
    SCMP_SYS(execveat),
    SCMP_SYS(fork),
    SCMP_SYS(vfork),
    SCMP_SYS(kill),
    SCMP_SYS(tkill),
    SCMP_SYS(rt_sigqueueinfo),
    SCMP_SYS(rt_tgsigqueueinfo),
    SCMP_SYS(ptrace),
    SCMP_SYS(process_vm_readv),
    SCMP_SYS(process_vm_writev),
    SCMP_SYS(kcmp),
    SCMP_SYS(setpgid),
    SCMP_SYS(setsid),
    SCMP_SYS(setpriority),
    SCMP_SYS(ioprio_set),
    SCMP_SYS(move_pages),
    SCMP_SYS(migrate_pages),
    SCMP_SYS(capset),
    // terminals and other devices: TIOCSTI and TIOCLINUX type into them
    SCMP_SYS(ioctl),
    // changing the file system
    SCMP_SYS(creat),
    SCMP_SYS(truncate),
    SCMP_SYS(rename),
    SCMP_SYS(renameat),
    SCMP_SYS(renameat2),
    SCMP_SYS(unlink),
    SCMP_SYS(unlinkat),
    SCMP_SYS(link),
    SCMP_SYS(linkat),
    SCMP_SYS(symlink),
    SCMP_SYS(symlinkat),
    SCMP_SYS(mkdir),
    SCMP_SYS(mkdirat),
    SCMP_SYS(rmdir),
    SCMP_SYS(mknod),
    SCMP_SYS(mknodat),
    SCMP_SYS(chmod),
    SCMP_SYS(fchmod),
    SCMP_SYS(fchmodat),
    SCMP_SYS(chown),
    SCMP_SYS(fchown),
    SCMP_SYS(lchown),
    SCMP_SYS(fchownat),
    SCMP_SYS(utime),
    SCMP_SYS(utimes),
    SCMP_SYS(utimensat),
    SCMP_SYS(futimesat),
    SCMP_SYS(setxattr),
    SCMP_SYS(lsetxattr),
    SCMP_SYS(fsetxattr),
    SCMP_SYS(removexattr),
    SCMP_SYS(lremovexattr),
    SCMP_SYS(fremovexattr),
    SCMP_SYS(mount),
    SCMP_SYS(umount2),
    SCMP_SYS(pivot_root),
    SCMP_SYS(chroot),
    SCMP_SYS(open_by_handle_at),
    SCMP_SYS(flock),
    SCMP_SYS(inotify_add_watch),
    SCMP_SYS(fanotify_init),
    // the kernel itself, and ways around this filter
    SCMP_SYS(bpf),
    SCMP_SYS(perf_event_open),
    SCMP_SYS(userfaultfd),
    SCMP_SYS(keyctl),
    SCMP_SYS(add_key),
    SCMP_SYS(request_key),
    SCMP_SYS(unshare),
    SCMP_SYS(setns),
    SCMP_SYS(personality),
    SCMP_SYS(init_module),
    SCMP_SYS(finit_module),
    SCMP_SYS(delete_module),
    SCMP_SYS(kexec_load),
    SCMP_SYS(reboot),
    SCMP_SYS(swapon),
    SCMP_SYS(swapoff),
    SCMP_SYS(sethostname),
    SCMP_SYS(setdomainname),
    SCMP_SYS(acct),
    SCMP_SYS(syslog),
    SCMP_SYS(quotactl),
    SCMP_SYS(shmget),
    SCMP_SYS(semget),
    SCMP_SYS(msgget),
    SCMP_SYS(mq_open),
    SCMP_SYS(prlimit64),
});

// Calls from 424 on have the same number on every architecture. Only these are of use to a decoder
// or to the C library; the others are refused without being named, those that this kernel does not
// have yet included. (openat2 among them: its flags lie in memory, out of the filter's sight.)
constexpr int kFirstNewer = 424;
constexpr int kLastNewer = 511;
constexpr auto kAllowedNewer = std::to_array<int>({
    435, // clone3: has a rule of its own
    436, // close_range
    439, // faccessat2
    441, // epoll_pwait2
    449, // futex_waitv
    453, // map_shadow_stack
    454, // futex_wake
    455, // futex_wait
    456, // futex_requeue
    462  // mseal
});

// Of fcntl: signals to whoever is named, locks and leases that hold other programs up.
constexpr auto kForbiddenFcntl =
    std::to_array<int>({F_SETOWN, F_SETOWN_EX, F_SETSIG, F_SETLK, F_SETLKW, F_OFD_SETLK,
                        F_OFD_SETLKW, F_SETLEASE, F_NOTIFY});

// Of prctl: taking back what was set up below.
constexpr auto kForbiddenPrctl =
    std::to_array<int>({PR_SET_DUMPABLE, PR_SET_PDEATHSIG, PR_SET_PTRACER, PR_SET_MM});

// A decoder may arrange its own threads by the number 0 ("myself"), and look at nobody else's.
constexpr auto kScheduling =
    std::to_array<int>({SCMP_SYS(sched_setaffinity), SCMP_SYS(sched_setattr),
                        SCMP_SYS(sched_setparam), SCMP_SYS(sched_setscheduler)});
constexpr auto kSchedulingQuestions = std::to_array<int>(
    {SCMP_SYS(sched_getaffinity), SCMP_SYS(sched_getattr), SCMP_SYS(sched_getparam),
     SCMP_SYS(sched_getscheduler), SCMP_SYS(sched_rr_get_interval)});

class Filter {
  public:
    Filter()
        : m_context(seccomp_init(SCMP_ACT_ALLOW)) {}
    ~Filter() { seccomp_release(m_context); }
    Filter(const Filter&) = delete;
    Filter& operator=(const Filter&) = delete;

    // What failed, or nothing.
    std::string load(Files files);

  private:
    template <class... Conditions>
    bool forbid(int call, Conditions... conditions) {
        const std::array<scmp_arg_cmp, sizeof...(conditions)> list{conditions...};
        return seccomp_rule_add_array(m_context, SCMP_ACT_ERRNO(EPERM), call,
                                      static_cast<unsigned>(list.size()), list.data()) == 0;
    }
    bool forbidWriting(int call, unsigned flagsArgument);
    bool forbidNewer();
    bool forbidSignals();
    bool forbidScheduling();

    scmp_filter_ctx m_context;
};

bool Filter::forbidWriting(int call, unsigned flagsArgument) {
    const auto with = [&](std::uint64_t mask, std::uint64_t flag) {
        return forbid(call, SCMP_CMP(flagsArgument, SCMP_CMP_MASKED_EQ, mask, flag));
    };
    return with(O_ACCMODE, O_WRONLY) && with(O_ACCMODE, O_RDWR) && with(O_CREAT, O_CREAT) &&
           with(O_TRUNC, O_TRUNC);
}

bool Filter::forbidNewer() {
    for (int call = kFirstNewer; call <= kLastNewer; ++call)
        if (std::find(kAllowedNewer.begin(), kAllowedNewer.end(), call) == kAllowedNewer.end() &&
            !forbid(call))
            return false;
    return true;
}

// The kernel reads the low 32 bits of these arguments: so does the filter.
bool Filter::forbidSignals() {
    constexpr std::uint64_t kLow = 0xffffffff;
    const auto is = [&](unsigned argument, int value) {
        return SCMP_CMP(argument, SCMP_CMP_MASKED_EQ, kLow, static_cast<std::uint32_t>(value));
    };
    for (const int command : kForbiddenFcntl)
        if (!forbid(SCMP_SYS(fcntl), is(1, command)))
            return false;
    for (const int option : kForbiddenPrctl)
        if (!forbid(SCMP_SYS(prctl), is(0, option)))
            return false;
    return forbid(SCMP_SYS(fcntl), is(1, F_SETFL),
                  SCMP_CMP(2, SCMP_CMP_MASKED_EQ, O_ASYNC, O_ASYNC));
}

bool Filter::forbidScheduling() {
    for (const int call : kScheduling)
        if (!forbid(call, SCMP_CMP(0, SCMP_CMP_NE, 0)))
            return false;
    // The C library asks for the affinity of threads by their number, and takes ENOSYS for "none".
    for (const int call : kSchedulingQuestions)
        if (const scmp_arg_cmp other = SCMP_CMP(0, SCMP_CMP_NE, 0);
            seccomp_rule_add_array(m_context, SCMP_ACT_ERRNO(ENOSYS), call, 1, &other) != 0)
            return false;
    return true;
}

std::string Filter::load(Files files) {
    if (m_context == nullptr)
        return "seccomp_init";
    // Rules as a binary tree: each system call passes a handful of them and not all.
    if (seccomp_attr_set(m_context, SCMP_FLTATR_CTL_OPTIMIZE, 2) != 0)
        return "seccomp_attr_set";
    if (!forbidNewer() || !forbidSignals() || !forbidScheduling())
        return "seccomp rules for newer calls, signals and scheduling";
    for (const int call : kForbidden)
        if (!forbid(call))
            return "seccomp rule " + std::to_string(call);
    if (files == Files::ReadOnly &&
        (!forbidWriting(SCMP_SYS(open), 1) || !forbidWriting(SCMP_SYS(openat), 2)))
        return "seccomp rule for open";

    // Threads are allowed, processes are not. clone3 hides its flags in memory: without it the C
    // library falls back to clone.
    if (!forbid(SCMP_SYS(clone), SCMP_CMP(0, SCMP_CMP_MASKED_EQ, CLONE_THREAD, 0)))
        return "seccomp rule for clone";
    if (seccomp_rule_add(m_context, SCMP_ACT_ERRNO(ENOSYS), SCMP_SYS(clone3), 0) != 0)
        return "seccomp rule for clone3";
    // abort() signals its own thread group.
    if (!forbid(SCMP_SYS(tgkill), SCMP_CMP(0, SCMP_CMP_NE, static_cast<std::uint64_t>(::getpid()))))
        return "seccomp rule for tgkill";
    const int failure = seccomp_load(m_context);
    return failure == 0 ? std::string() : std::string("seccomp: ") + std::strerror(-failure);
}

} // namespace

std::string confine(std::uint64_t memoryBytes, double cpuSeconds, Files files) {
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
    return Filter().load(files);
}

} // namespace patina::worker
