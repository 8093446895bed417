#include "core/base/FileLock.h"

#include <array>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <fmt/format.h>
#include <string>
#include <sys/file.h>
#include <sys/stat.h>
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
    return ::fstat(fd, &mine) == 0 && ::stat(file.c_str(), &named) == 0 &&
           mine.st_dev == named.st_dev && mine.st_ino == named.st_ino;
}

} // namespace

Result<FileLock> FileLock::take(const fs::path& path) {
    const fs::path file =
        path.parent_path() / fmt::format(".{}.lock", path.filename().string().substr(0, 200));
    while (true) {
        FileDescriptor descriptor(::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666));
        if (!descriptor.valid())
            return Error{ErrorKind::CannotCreate,
                         "the file cannot be locked; check that its folder exists and is writable",
                         path, std::strerror(errno)};
        if (::flock(descriptor.get(), LOCK_EX | LOCK_NB) != 0) {
            if (errno == EINTR)
                continue;
            if (errno == EWOULDBLOCK)
                return Error{ErrorKind::CannotCreate,
                             fmt::format("{} is writing this file already; wait for it, or write "
                                         "another one",
                                         holder(descriptor.get())),
                             path,
                             {}};
            return Error{ErrorKind::CannotCreate, "the file cannot be locked on this drive", path,
                         std::strerror(errno)};
        }
        if (!isStill(descriptor.get(), file))
            continue;
        const std::string self = fmt::format("process {} on {}", ::getpid(), hostName());
        // Only to be named in a message: a full disk does not matter.
        if (::ftruncate(descriptor.get(), 0) == 0)
            static_cast<void>(::pwrite(descriptor.get(), self.data(), self.size(), 0) >= 0);
        return FileLock(file, std::move(descriptor));
    }
}

FileLock::~FileLock() {
    if (m_descriptor.valid())
        ::unlink(m_file.c_str());
}

} // namespace patina
