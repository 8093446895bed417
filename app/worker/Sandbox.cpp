#include "app/worker/Sandbox.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <sched.h>
#include <seccomp.h>
#include <sys/prctl.h>
#include <sys/resource.h>
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
    SCMP_SYS(pidfd_open),
    SCMP_SYS(pidfd_send_signal),
    SCMP_SYS(pidfd_getfd),
    SCMP_SYS(rt_sigqueueinfo),
    SCMP_SYS(rt_tgsigqueueinfo),
    SCMP_SYS(ptrace),
    SCMP_SYS(process_vm_readv),
    SCMP_SYS(process_vm_writev),
    SCMP_SYS(process_madvise),
    SCMP_SYS(kcmp),
    SCMP_SYS(setpgid),
    SCMP_SYS(setsid),
    SCMP_SYS(setpriority),
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
    SCMP_SYS(openat2), // its flags lie in memory, out of sight
    // the kernel itself, and ways around this filter
    SCMP_SYS(io_uring_setup),
    SCMP_SYS(io_uring_enter),
    SCMP_SYS(io_uring_register),
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

    scmp_filter_ctx m_context;
};

bool Filter::forbidWriting(int call, unsigned flagsArgument) {
    const auto with = [&](std::uint64_t mask, std::uint64_t flag) {
        return forbid(call, SCMP_CMP(flagsArgument, SCMP_CMP_MASKED_EQ, mask, flag));
    };
    return with(O_ACCMODE, O_WRONLY) && with(O_ACCMODE, O_RDWR) && with(O_CREAT, O_CREAT) &&
           with(O_TRUNC, O_TRUNC);
}

std::string Filter::load(Files files) {
    if (m_context == nullptr)
        return "seccomp_init";
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
    if (::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0)
        return std::string("prctl: ") + std::strerror(errno);
    return Filter().load(files);
}

} // namespace patina::worker
