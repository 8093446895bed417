#include "core/base/AtomicFile.h"

#include "core/base/FileDescriptor.h"
#include "core/base/FileNaming.h"
#include "core/base/InputFile.h"
#include "core/base/OwnFile.h"
#include "core/base/TemporaryName.h"

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <fmt/format.h>
#include <optional>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

namespace patina {
namespace {

namespace fs = std::filesystem;

Error systemError(ErrorKind kind, const fs::path& path, std::string message, int code) {
    return {kind, std::move(message), path, std::strerror(code)};
}

Error cannotCreate(const fs::path& path, int code) {
    return systemError(ErrorKind::CannotCreate, path,
                       "the file cannot be created; check that the folder exists and is writable",
                       code);
}

Error cannotWrite(const fs::path& path, int code) {
    return systemError(
        ErrorKind::Io, path,
        code == ENOSPC || code == EDQUOT ? "the disk is full; free some space or save elsewhere"
        : code == EFBIG ? "the file is larger than may be written here (ulimit -f, or the file "
                          "system); raise the limit or save elsewhere"
                        : "writing failed; the previous content is untouched",
        code);
}

// Writes everything or returns errno.
int writeAll(int fd, std::span<const std::span<const std::byte>> pieces) {
    for (std::span<const std::byte> data : pieces) {
        while (!data.empty()) {
            const ssize_t written = ::write(fd, data.data(), data.size());
            if (written < 0) {
                if (errno == EINTR)
                    continue;
                return errno;
            }
            data = data.subspan(static_cast<std::size_t>(written));
        }
    }
    return 0;
}

// The file that the name finally stands for, so that a saved-over link stays a link.
fs::path resolveLinks(const fs::path& path) {
    std::error_code error;
    if (fs::is_symlink(fs::symlink_status(path, error)))
        if (fs::path target = fs::weakly_canonical(path, error); !error)
            return target;
    return path;
}

// Makes `target` hold the pieces in one step; `named` is what the user knows it as. `mode`: of the
// file that is replaced.
Result<void> replaceFile(const fs::path& target, const fs::path& named,
                         std::span<const std::span<const std::byte>> pieces,
                         const std::optional<mode_t>& mode) {
    fs::path folder = target.parent_path();
    if (folder.empty())
        folder = ".";

    // An unnamed file cannot outlive a crash. Where the file system has none, a named one is used
    // and removed on every error path.
    const std::string temporary = temporaryPath(target).string();
    int fd = ::open(folder.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0666);
    const bool unnamed = fd >= 0;
    if (!unnamed && errno != EOPNOTSUPP && errno != EISDIR && errno != EINVAL)
        return cannotCreate(named, errno);
    std::optional<FileNaming> between;
    if (!unnamed)
        between.emplace();
    if (!unnamed)
        fd = ::open(temporary.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666);
    if (fd < 0)
        return cannotCreate(named, errno);
    const FileDescriptor file(fd);
    const auto fail = [&](int code) -> Result<void> {
        ::unlink(temporary.c_str());
        return cannotWrite(named, code);
    };

    if (mode)
        static_cast<void>(::fchmod(fd, *mode & 07777)); // best effort: not ours to own
    if (const int code = writeAll(fd, pieces))
        return fail(code);
    if (::fdatasync(fd) != 0)
        return fail(errno);

    // Give it a name, then move the name over the old one.
    if (unnamed) {
        between.emplace();
        const std::string self = fmt::format("/proc/self/fd/{}", fd);
        if (::linkat(AT_FDCWD, self.c_str(), AT_FDCWD, temporary.c_str(), AT_SYMLINK_FOLLOW) != 0)
            return fail(errno);
    }
    if (::rename(temporary.c_str(), target.c_str()) != 0)
        return fail(errno);
    const FileDescriptor directory(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    if (directory.valid())
        ::fsync(directory.get());
    return {};
}

} // namespace

Result<void> writeFileAtomically(const fs::path& path, std::span<const std::byte> data) {
    return writePiecesAtomically(path, std::span(&data, 1));
}

Result<void> writePiecesAtomically(const fs::path& path,
                                   std::span<const std::span<const std::byte>> pieces) {
    const fs::path target = resolveLinks(path);
    struct stat existing {};
    const bool replaces = ::stat(target.c_str(), &existing) == 0;
    if (replaces && S_ISDIR(existing.st_mode))
        return cannotCreate(path, EISDIR);
    // A device such as /dev/null or a pipe takes the data directly: there is nothing to replace.
    if (replaces && !S_ISREG(existing.st_mode)) {
        // Opening a pipe that nobody reads would wait for a reader for ever.
        const FileDescriptor device(::open(target.c_str(), O_WRONLY | O_NONBLOCK | O_CLOEXEC));
        if (!device.valid() && errno == ENXIO)
            return systemError(ErrorKind::CannotCreate, path,
                               "nothing reads from this pipe; start what reads it first, or name a "
                               "file",
                               ENXIO);
        if (!device.valid())
            return cannotCreate(path, errno);
        ::fcntl(device.get(), F_SETFL, ::fcntl(device.get(), F_GETFL) & ~O_NONBLOCK);
        if (const int code = writeAll(device.get(), pieces))
            return cannotWrite(path, code);
        return {};
    }
    return replaceFile(target, path, pieces,
                       replaces ? std::optional(existing.st_mode) : std::nullopt);
}

Result<void> writeOwnPieces(const fs::path& path,
                            std::span<const std::span<const std::byte>> pieces) {
    struct stat existing {};
    const bool replaces = ::lstat(path.c_str(), &existing) == 0;
    if (replaces && S_ISDIR(existing.st_mode))
        return cannotCreate(path, EISDIR);
    return replaceFile(path, path, pieces,
                       replaces && S_ISREG(existing.st_mode) ? std::optional(existing.st_mode)
                                                             : std::nullopt);
}

Result<void> writeOwnFile(const fs::path& path, std::span<const std::byte> data) {
    return writeOwnPieces(path, std::span(&data, 1));
}

Result<void> makeOwnFolder(const fs::path& folder) {
    const bool made = ::mkdir(folder.c_str(), 0777) == 0;
    if (!made && errno != EEXIST)
        return systemError(ErrorKind::CannotCreate, folder,
                           "the folder cannot be created; check that the one around it exists and "
                           "is writable",
                           errno);
    struct stat there {};
    if (::lstat(folder.c_str(), &there) != 0 || S_ISLNK(there.st_mode))
        return Error{ErrorKind::CannotCreate,
                     "there is a link in the place of this folder, and it is not followed; put the "
                     "folder itself there",
                     folder,
                     {}};
    if (!S_ISDIR(there.st_mode))
        return Error{ErrorKind::CannotCreate,
                     "there is a file in the place of this folder; move it away",
                     folder,
                     {}};
    if (made) {
        const fs::path around = folder.has_parent_path() ? folder.parent_path() : fs::path(".");
        const FileDescriptor parent(::open(around.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
        if (parent.valid())
            ::fsync(parent.get());
    }
    return {};
}

Result<void> writeFileAtomically(const fs::path& path, std::string_view text) {
    return writeFileAtomically(path, std::as_bytes(std::span(text.data(), text.size())));
}

Result<Bytes> readFile(const fs::path& path, std::size_t maxSize) {
    const Result<RegularFile> file = openRegularFile(path);
    if (!file)
        return file.error();

    Bytes data;
    std::byte buffer[1 << 16];
    if (file->size <= maxSize)
        data.reserve(file->size);
    while (true) {
        const ssize_t count = ::read(file->fd.get(), buffer, sizeof buffer);
        if (count < 0) {
            if (errno == EINTR)
                continue;
            return systemError(ErrorKind::InputMissing, path, "the file cannot be read", errno);
        }
        if (count == 0)
            return data;
        if (data.size() + static_cast<std::size_t>(count) > maxSize)
            return Error{ErrorKind::InputBroken,
                         fmt::format("the file is larger than {} MiB, the most Patina reads of "
                                     "this kind",
                                     maxSize >> 20),
                         path,
                         {}};
        data.insert(data.end(), buffer, buffer + count);
    }
}

Result<std::string> readTextFile(const fs::path& path, std::size_t maxSize) {
    Result<Bytes> data = readFile(path, maxSize);
    if (!data)
        return data.error();
    return std::string(reinterpret_cast<const char*>(data->data()), data->size());
}

} // namespace patina
