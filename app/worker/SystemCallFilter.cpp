#include "app/worker/SystemCallFilter.h"

#include "app/worker/TrappedCalls.h"
#include "core/worker/WorkerProtocol.h"

#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <fcntl.h>
#include <sched.h>
#include <seccomp.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <unistd.h>

namespace patina::worker {

namespace {

// Whatever their arguments. Each acts on this process alone, or on a descriptor that it has.
constexpr auto kAllowed = std::to_array<int>({
    // descriptors
    SCMP_SYS(read),
    SCMP_SYS(pread64),
    SCMP_SYS(write),
    SCMP_SYS(writev),
    SCMP_SYS(lseek),
    SCMP_SYS(close),
    SCMP_SYS(fstat),
    SCMP_SYS(ftruncate),
    // memory; mmap and mprotect have conditions
    SCMP_SYS(brk),
    SCMP_SYS(munmap),
    SCMP_SYS(mremap),
    SCMP_SYS(madvise),
    // threads; clone has conditions
    SCMP_SYS(futex),
    SCMP_SYS(set_robust_list),
    SCMP_SYS(rseq),
    SCMP_SYS(sched_yield),
    SCMP_SYS(exit),
    SCMP_SYS(exit_group),
    // signals of its own; tgkill has conditions
    SCMP_SYS(rt_sigaction),
    SCMP_SYS(rt_sigprocmask),
    SCMP_SYS(rt_sigreturn),
    SCMP_SYS(restart_syscall),
    // time, chance, itself
    SCMP_SYS(clock_gettime),
    SCMP_SYS(clock_nanosleep),
    SCMP_SYS(gettimeofday),
    SCMP_SYS(getrandom),
    SCMP_SYS(getpid),
    SCMP_SYS(gettid),
});

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
// A report names functions and lines, which takes the program's own files; UBSan tries whether
// memory can be read by writing it to a pipe.
constexpr auto kForReports = std::to_array<int>(
    {SCMP_SYS(open), SCMP_SYS(openat), SCMP_SYS(stat), SCMP_SYS(lstat), SCMP_SYS(newfstatat),
     SCMP_SYS(access), SCMP_SYS(readlink), SCMP_SYS(readlinkat), SCMP_SYS(memfd_create),
     SCMP_SYS(getdents64), SCMP_SYS(sigaltstack), SCMP_SYS(pipe), SCMP_SYS(pipe2)});
#endif

// Of fcntl: copies, flags and seals; no locks, leases or signals to whoever is named.
constexpr auto kFcntl = std::to_array<int>(
    {F_DUPFD, F_DUPFD_CLOEXEC, F_GETFD, F_SETFD, F_GETFL, F_ADD_SEALS, F_GET_SEALS});
// Of prctl: names of threads, and what a child may know of itself.
constexpr auto kPrctl = std::to_array<int>({PR_SET_NAME, PR_GET_NAME, PR_GET_DUMPABLE});

// A thread, and no process; what the C library passes. (clone3 hides its flags in memory: without
// it the library falls back to clone.)
constexpr std::uint64_t kThread = CLONE_VM | CLONE_FS | CLONE_FILES | CLONE_SIGHAND | CLONE_THREAD |
                                  CLONE_SYSVSEM | CLONE_SETTLS | CLONE_PARENT_SETTID |
                                  CLONE_CHILD_CLEARTID;

// The kernel reads the low 32 bits of these arguments: so does the filter.
scmp_arg_cmp isInt(unsigned argument, int value) {
    constexpr std::uint64_t kLow = 0xffffffff;
    return SCMP_CMP(argument, SCMP_CMP_MASKED_EQ, kLow, static_cast<std::uint32_t>(value));
}
scmp_arg_cmp lacks(unsigned argument, int flag) {
    return SCMP_CMP(argument, SCMP_CMP_MASKED_EQ, static_cast<std::uint32_t>(flag), 0);
}

class Filter {
  public:
    Filter()
        : m_context(seccomp_init(SCMP_ACT_ERRNO(ENOSYS))) {}
    ~Filter() { seccomp_release(m_context); }
    Filter(const Filter&) = delete;
    Filter& operator=(const Filter&) = delete;

    std::string load(); // what failed, or nothing

  private:
    template <class... Conditions>
    void add(std::uint32_t action, int call, Conditions... conditions) {
        const std::array<scmp_arg_cmp, sizeof...(conditions)> list{conditions...};
        if (seccomp_rule_add_array(m_context, action, call, static_cast<unsigned>(list.size()),
                                   list.data()) != 0)
            m_failed = call;
    }
    template <class... Conditions>
    void allow(int call, Conditions... conditions) {
        add(SCMP_ACT_ALLOW, call, conditions...);
    }
    void allowMemory();
    void allowThreads();
    void allowDescriptors();

    scmp_filter_ctx m_context;
    int m_failed = -1;
};

// No page may be run that was not there at the start: neither written code nor a library.
void Filter::allowMemory() {
    allow(SCMP_SYS(mmap), lacks(2, PROT_EXEC));
    allow(SCMP_SYS(mprotect), lacks(2, PROT_EXEC));
}

void Filter::allowThreads() {
    allow(SCMP_SYS(clone), SCMP_CMP(0, SCMP_CMP_EQ, kThread));
    // abort() signals its own thread group.
    allow(SCMP_SYS(tgkill), isInt(0, ::getpid()));
    // 0 is the calling thread. The C library asks for those of others by their number, and takes
    // ENOSYS for "none".
    allow(SCMP_SYS(sched_getaffinity), isInt(0, 0));
    for (const int option : kPrctl)
        allow(SCMP_SYS(prctl), isInt(0, option));
    // Limits may be read, its own.
    allow(SCMP_SYS(prlimit64), isInt(0, 0), SCMP_CMP(2, SCMP_CMP_EQ, 0));
}

void Filter::allowDescriptors() {
    for (const int command : kFcntl)
        allow(SCMP_SYS(fcntl), isInt(1, command));
    // Its client, and no other socket it might be handed.
    allow(SCMP_SYS(sendmsg), isInt(0, protocol::kRequestFd));
    allow(SCMP_SYS(recvmsg), isInt(0, protocol::kRequestFd));
}

std::string Filter::load() {
    if (m_context == nullptr)
        return "seccomp_init";
    // Rules as a binary tree: each system call passes a handful of them and not all. All threads:
    // a library may start one as soon as it is forked.
    if (seccomp_attr_set(m_context, SCMP_FLTATR_CTL_OPTIMIZE, 2) != 0 ||
        seccomp_attr_set(m_context, SCMP_FLTATR_CTL_TSYNC, 1) != 0)
        return "seccomp_attr_set";
    for (const int call : kAllowed)
        allow(call);
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
    for (const int call : kForReports)
        allow(call);
#else
    for (const int call : trappedCalls())
        add(SCMP_ACT_TRAP, call);
#endif
    allowThreads();
    allowMemory();
    allowDescriptors();
    if (m_failed != -1)
        return "seccomp rule " + std::to_string(m_failed);
    const int failure = seccomp_load(m_context);
    return failure == 0 ? std::string() : std::string("seccomp: ") + std::strerror(-failure);
}

} // namespace

std::string filterSystemCalls() {
    return Filter().load();
}

} // namespace patina::worker
