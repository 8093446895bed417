#include "app/worker/TrappedCalls.h"

#include "core/worker/WorkerProtocol.h"

#include <array>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <poll.h>
#include <string_view>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <ucontext.h>
#include <unistd.h>

// Everything below runs in a signal handler, between two instructions of a library: no memory is
// allocated, and nothing is thrown.
namespace patina::worker {

namespace {

using Arguments = std::array<std::uintptr_t, 4>;

#if defined(__x86_64__)
Arguments argumentsOf(const ucontext_t& context) {
    const auto& registers = context.uc_mcontext.gregs;
    return {static_cast<std::uintptr_t>(registers[REG_RDI]),
            static_cast<std::uintptr_t>(registers[REG_RSI]),
            static_cast<std::uintptr_t>(registers[REG_RDX]),
            static_cast<std::uintptr_t>(registers[REG_R10])};
}
void setResult(ucontext_t& context, long result) {
    context.uc_mcontext.gregs[REG_RAX] = result;
}
#elif defined(__aarch64__)
Arguments argumentsOf(const ucontext_t& context) {
    const auto& registers = context.uc_mcontext.regs;
    return {registers[0], registers[1], registers[2], registers[3]};
}
void setResult(ucontext_t& context, long result) {
    context.uc_mcontext.regs[0] = static_cast<std::uint64_t>(result);
}
#else
#error "Say here where this processor keeps a system call's arguments and its result."
#endif

// One request at a time: its answer follows on the same socket.
std::atomic_flag s_requesting = ATOMIC_FLAG_INIT;

long receiveGrant() {
    protocol::Grant grant;
    iovec io{&grant, sizeof grant};
    alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof(int))> control{};
    msghdr header{};
    header.msg_iov = &io;
    header.msg_iovlen = 1;
    header.msg_control = control.data();
    header.msg_controllen = control.size();
    ssize_t size = 0;
    do {
        size = ::recvmsg(protocol::kRequestFd, &header, MSG_CMSG_CLOEXEC);
    } while (size < 0 && errno == EINTR);
    if (size != sizeof grant || grant.magic != protocol::kMagic)
        return -EIO;
    if (grant.error != 0)
        return -grant.error;
    const cmsghdr* rights = CMSG_FIRSTHDR(&header);
    if (rights == nullptr || rights->cmsg_type != SCM_RIGHTS)
        return -EMFILE; // the kernel had no room for it
    int file = -1;
    std::memcpy(&file, CMSG_DATA(rights), sizeof file);
    return file;
}

// A descriptor, or a negative errno.
long request(protocol::Event event, std::int64_t value = 0, std::string_view path = {}) {
    protocol::Report report;
    report.event = event;
    report.value = value;
    std::array<iovec, 2> io{
        {{&report, sizeof report}, {const_cast<char*>(path.data()), path.size()}}};
    msghdr header{};
    header.msg_iov = io.data();
    header.msg_iovlen = io.size();
    while (s_requesting.test_and_set(std::memory_order_acquire))
        s_requesting.wait(true, std::memory_order_relaxed);
    ssize_t sent = 0;
    do {
        sent = ::sendmsg(protocol::kRequestFd, &header, MSG_NOSIGNAL);
    } while (sent < 0 && errno == EINTR);
    const long result = sent < 0 ? -EIO : receiveGrant();
    s_requesting.clear(std::memory_order_release);
    s_requesting.notify_one();
    return result;
}

// "/proc/self/fd/5": 5, a file that is open. -1: another path.
int descriptorNamed(std::string_view path) {
    constexpr std::string_view kFolder = "/proc/self/fd/";
    if (!path.starts_with(kFolder))
        return -1;
    int number = -1;
    const auto [end, failure] =
        std::from_chars(path.data() + kFolder.size(), path.data() + path.size(), number);
    return failure == std::errc() && end == path.data() + path.size() ? number : -1;
}

// A memory file that an encoder writes: the same one again, from its start.
long openForWriting(int file, int flags) {
    if ((flags & O_TRUNC) != 0 && ::ftruncate(file, 0) != 0)
        return -errno;
    if (::lseek(file, 0, SEEK_SET) < 0)
        return -errno;
    const int copy = ::fcntl(file, F_DUPFD_CLOEXEC, 0);
    return copy < 0 ? -errno : copy;
}

long open(const char* name, int flags) {
    const std::string_view path(name);
    if (path.size() > protocol::kMaxPathBytes)
        return -ENAMETOOLONG;
    const bool writes = (flags & (O_WRONLY | O_RDWR)) != 0;
    if (const int file = descriptorNamed(path); file >= 0)
        return writes ? openForWriting(file, flags) : request(protocol::Event::OpenPayload);
    return writes ? -EACCES : request(protocol::Event::OpenFile, 0, path);
}

long statusOfOpen(int file, struct stat* status) {
    return ::syscall(SYS_fstat, file, status) == 0 ? 0 : -errno;
}

// What a stranger's file is like is told of those that may be read.
long statusOf(const char* name, struct stat* status) {
    if (const int file = descriptorNamed(name); file >= 0)
        return statusOfOpen(file, status);
    const long file = open(name, O_RDONLY);
    if (file < 0)
        return file;
    const long result = statusOfOpen(static_cast<int>(file), status);
    ::close(static_cast<int>(file));
    return result;
}

long accessOf(const char* name, int mode) {
    struct stat status {};
    const long result = statusOf(name, &status);
    return result == 0 && (mode & (W_OK | X_OK)) != 0 ? -EACCES : result;
}

template <class T>
T* pointer(std::uintptr_t argument) {
    return reinterpret_cast<T*>(argument);
}

long carryOut(int call, const Arguments& a) {
    const auto number = [&](std::size_t i) { return static_cast<int>(a[i]); };
    switch (call) {
#if defined(SYS_open) // older architectures have these, too
    case SYS_open:
        return open(pointer<const char>(a[0]), number(1));
    case SYS_stat:
    case SYS_lstat:
        return statusOf(pointer<const char>(a[0]), pointer<struct stat>(a[1]));
    case SYS_access:
        return accessOf(pointer<const char>(a[0]), number(1));
#endif
    case SYS_openat:
        return open(pointer<const char>(a[1]), number(2));
    case SYS_newfstatat:
        if ((number(3) & AT_EMPTY_PATH) != 0 && *pointer<const char>(a[1]) == '\0')
            return statusOfOpen(number(0), pointer<struct stat>(a[2]));
        return statusOf(pointer<const char>(a[1]), pointer<struct stat>(a[2]));
    case SYS_faccessat:
        return accessOf(pointer<const char>(a[1]), number(2));
    case SYS_memfd_create: // MemoryFile.cpp adds its size, in bytes
        return request(protocol::Event::CreateMemory, static_cast<std::int64_t>(a[2]));
    default:
        return -ENOSYS;
    }
}

void onTrappedCall(int /*signal*/, siginfo_t* info, void* context) {
    const int before = errno;
    auto& state = *static_cast<ucontext_t*>(context);
    setResult(state, carryOut(info->si_syscall, argumentsOf(state)));
    errno = before;
}

} // namespace

const std::vector<int>& trappedCalls() {
    static const std::vector<int> calls = {
#if defined(SYS_open)
        SYS_open,
        SYS_stat,
        SYS_lstat,
        SYS_access,
#endif
        SYS_openat,
        SYS_newfstatat,
        SYS_faccessat,
        SYS_memfd_create
    };
    return calls;
}

std::string handleTrappedCalls() {
    struct sigaction action {};
    action.sa_sigaction = onTrappedCall;
    action.sa_flags = SA_SIGINFO | SA_NODEFER | SA_RESTART;
    return ::sigaction(SIGSYS, &action, nullptr) == 0
               ? std::string()
               : std::string("sigaction: ") + std::strerror(errno);
}

} // namespace patina::worker
