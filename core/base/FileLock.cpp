#include "core/base/FileLock.h"

#include "core/base/Log.h"

#include <array>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <fmt/format.h>
#include <string>
#include <string_view>
#include <sys/file.h>
#include <sys/stat.h>
#include <thread>
#include <unistd.h>

namespace patina {
namespace {

namespace fs = std::filesystem;

std::string hostName() {
    std::array<char, 256> name{};
    return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "this machine";
}

// Who holds the lock, as they wrote it.
std::string holder(int fd) {
    std::array<char, 300> text{};
    const ssize_t count = ::pread(fd, text.data(), text.size(), 0);
    return count > 0 ? std::string(text.data(), static_cast<std::size_t>(count))
                     : std::string("another process");
}

// The file may have been removed by its last holder between open() and flock().
bool isStill(int fd, const fs::path& file) {
    struct stat mine {
    }, named{};
    return ::fstat(fd, &mine) == 0 && ::lstat(file.c_str(), &named) == 0 &&
           mine.st_dev == named.st_dev && mine.st_ino == named.st_ino;
}

fs::path lockFile(const fs::path& path) {
    return path.parent_path() / fmt::format(".{}.lock", path.filename().string().substr(0, 200));
}

constexpr std::string_view kHolder = "process "; // what locks begin with

// A file that was made for this: nothing that a second name leads to, no pipe, nothing that says
// something else.
bool isLockFile(int fd) {
    struct stat info {};
    if (::fstat(fd, &info) != 0 || !S_ISREG(info.st_mode) || info.st_nlink > 1)
        return false;
    std::array<char, kHolder.size()> start{};
    const ssize_t count = ::pread(fd, start.data(), start.size(), 0);
    return count == 0 ||
           (count > 0 &&
            kHolder.starts_with(std::string_view(start.data(), static_cast<std::size_t>(count))));
}

struct Attempt {
    FileDescriptor descriptor; // valid: locked
    bool held = false;         // by somebody else
    Error error;
};

Attempt lockOnce(const fs::path& path) {
    const fs::path file = lockFile(path);
    const auto refused = [&](std::string message, std::string detail) {
        return Attempt{
            {}, false, {ErrorKind::CannotCreate, std::move(message), path, std::move(detail)}};
    };
    while (true) {
        FileDescriptor descriptor(
            ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, 0666));
        const int code = errno;
        const bool strange = descriptor.valid() ? !isLockFile(descriptor.get()) : code == ELOOP;
        // Between its holder's unlink() and now it may have no name at all.
        if (descriptor.valid() && strange && !isStill(descriptor.get(), file))
            continue;
        if (strange)
            return refused(fmt::format("the file cannot be locked: {} is not a lock, but a link or "
                                       "a file of its own; remove it",
                                       file.filename().string()),
                           descriptor.valid() ? std::string() : std::strerror(code));
        if (!descriptor.valid())
            return refused(
                "the file cannot be locked; check that its folder exists and is writable",
                std::strerror(code));
        if (::flock(descriptor.get(), LOCK_EX | LOCK_NB) != 0) {
            if (errno == EINTR)
                continue;
            if (errno != EWOULDBLOCK)
                return refused("the file cannot be locked on this drive", std::strerror(errno));
            Attempt attempt =
                refused(fmt::format("{} is writing this file already; wait for it, or "
                                    "write another one",
                                    holder(descriptor.get())),
                        {});
            attempt.held = true;
            return attempt;
        }
        if (!isStill(descriptor.get(), file))
            continue;
        const std::string self = fmt::format("{}{} on {}", kHolder, ::getpid(), hostName());
        // Only to be named in a message: a full disk does not matter.
        if (::ftruncate(descriptor.get(), 0) == 0)
            static_cast<void>(::pwrite(descriptor.get(), self.data(), self.size(), 0) >= 0);
        return {std::move(descriptor), false, {}};
    }
}

} // namespace

Result<FileLock> FileLock::take(const fs::path& path) {
    Attempt attempt = lockOnce(path);
    if (!attempt.descriptor.valid())
        return std::move(attempt.error);
    return FileLock(lockFile(path), std::move(attempt.descriptor));
}

Result<std::optional<FileLock>> FileLock::takeWhenFree(const fs::path& path,
                                                       std::chrono::milliseconds patience) {
    constexpr std::chrono::milliseconds kPause(10);
    const auto end = std::chrono::steady_clock::now() + patience;
    while (true) {
        Attempt attempt = lockOnce(path);
        if (attempt.descriptor.valid())
            return std::optional(FileLock(lockFile(path), std::move(attempt.descriptor)));
        if (!attempt.held) {
            logWarning("Written without a lock: {}", attempt.error.text());
            return std::optional<FileLock>();
        }
        if (std::chrono::steady_clock::now() >= end)
            return std::move(attempt.error);
        std::this_thread::sleep_for(kPause);
    }
}

FileLock::~FileLock() {
    if (m_descriptor.valid())
        ::unlink(m_file.c_str());
}

} // namespace patina
