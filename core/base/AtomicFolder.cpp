#include "core/base/AtomicFolder.h"

#include "core/base/Check.h"
#include "core/base/FileDescriptor.h"
#include "core/base/FileNaming.h"
#include "core/base/TemporaryName.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
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

constexpr std::size_t kChunkBytes = std::size_t{4} << 20; // between two looks for a cancel

Error refusal(const fs::path& folder, const char* why) {
    return {ErrorKind::CannotCreate, why, folder, {}};
}

Error cannotCreateFolder(const fs::path& folder, int code) {
    return {ErrorKind::CannotCreate, "the folder cannot be created; choose another place", folder,
            std::strerror(code)};
}

Error cannotWriteIn(const fs::path& folder, int code) {
    return {ErrorKind::Io,
            code == ENOSPC || code == EDQUOT
                ? "the disk is full; free some space or write elsewhere"
                : "writing failed; what was there before is untouched",
            folder, std::strerror(code)};
}

Error cancelledError(const fs::path& folder) {
    return {ErrorKind::Cancelled, "cancelled; nothing was written", folder, {}};
}

// The folder that the name stands for: links followed, "out/" is "out".
fs::path target(const fs::path& folder) {
    std::error_code error;
    const fs::path absolute = fs::absolute(folder, error); // a name alone has no folder around it
    fs::path path = fs::weakly_canonical(absolute, error);
    if (error)
        path = absolute.lexically_normal();
    return path.has_filename() ? path : path.parent_path();
}

// Removes the unfinished folder unless it was kept.
class Unfinished {
  public:
    explicit Unfinished(fs::path path)
        : m_path(std::move(path)) {}
    ~Unfinished() {
        std::error_code ignored;
        if (!m_path.empty())
            fs::remove_all(m_path, ignored);
    }
    Unfinished(const Unfinished&) = delete;
    Unfinished& operator=(const Unfinished&) = delete;
    void keep() { m_path.clear(); }

  private:
    fs::path m_path;
};

// Writes everything or returns errno; ECANCELED after a cancel.
int writeAll(int fd, std::span<const std::byte> data, const std::function<bool()>& cancelled) {
    while (!data.empty()) {
        if (cancelled())
            return ECANCELED;
        const ssize_t written = ::write(fd, data.data(), std::min(data.size(), kChunkBytes));
        if (written < 0 && errno != EINTR)
            return errno;
        if (written > 0)
            data = data.subspan(static_cast<std::size_t>(written));
    }
    return ::fdatasync(fd) == 0 ? 0 : errno;
}

// Gives the unnamed files their names in `folder`.
int nameFiles(const fs::path& folder, std::span<const FolderFile> files,
              const std::vector<FileDescriptor>& unnamed) {
    for (std::size_t i = 0; i < files.size(); ++i) {
        const std::string self = fmt::format("/proc/self/fd/{}", unnamed[i].get());
        if (::linkat(AT_FDCWD, self.c_str(), AT_FDCWD, (folder / files[i].name).c_str(),
                     AT_SYMLINK_FOLLOW) != 0)
            return errno;
    }
    return 0;
}

// Moves `fresh` to `path`. What was there is then called like `fresh` and removed by its owner.
int swapIn(const fs::path& fresh, const fs::path& path) {
    if (::rename(fresh.c_str(), path.c_str()) == 0) // nothing there, or an empty folder
        return 0;
    if (errno != ENOTEMPTY && errno != EEXIST)
        return errno;
    return ::renameat2(AT_FDCWD, fresh.c_str(), AT_FDCWD, path.c_str(), RENAME_EXCHANGE) == 0
               ? 0
               : errno;
}

} // namespace

Result<void> checkFolderOutput(const fs::path& folder, const MayReplaceFolder& mayReplace) {
    const fs::path path = target(folder);
    std::error_code error;
    if (fs::exists(path, error)) {
        if (!fs::is_directory(path, error))
            return refusal(folder, "this is a file; name a new folder");
        const bool empty = fs::is_empty(path, error);
        if (error)
            return refusal(folder, "this folder cannot be read; choose another one");
        if (!empty && !mayReplace(path))
            return refusal(folder, "this folder holds other files; name a new or an empty one");
    }
    const fs::path parent = path.parent_path();
    if (!fs::is_directory(parent, error))
        return refusal(folder, "the folder around it does not exist; create it first");
    if (::access(parent.c_str(), W_OK) != 0)
        return refusal(folder, "the folder around it is not writable; choose another one");
    return {};
}

Result<void> writeFolderAtomically(const fs::path& folder, std::span<const FolderFile> files,
                                   const MayReplaceFolder& mayReplace,
                                   const std::function<bool()>& cancelled) {
    CHECK(!files.empty());
    if (Result<void> possible = checkFolderOutput(folder, mayReplace); !possible)
        return possible;
    const fs::path path = target(folder);
    const fs::path parent = path.parent_path();
    const fs::path part = temporaryPath(path);

    // Unnamed files vanish with the process. Where the file system has none, the files get their
    // names at once, in a folder that has not got its own yet.
    std::vector<FileDescriptor> written;
    const auto createUnnamed = [&] {
        return ::open(parent.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0666);
    };
    const int first = createUnnamed();
    const int openError = errno;
    const bool unnamed = first >= 0;
    if (!unnamed && openError != EOPNOTSUPP && openError != EISDIR && openError != EINVAL)
        return cannotCreateFolder(folder, openError);
    std::optional<FileNaming> between; // until what is unfinished is gone
    if (!unnamed)
        between.emplace();
    Unfinished unfinished(part);
    if (!unnamed && ::mkdir(part.c_str(), 0777) != 0)
        return cannotCreateFolder(folder, errno);
    for (const FolderFile& file : files) {
        int fd = -1;
        if (!unnamed)
            fd = ::open((part / file.name).c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666);
        else
            fd = written.empty() ? first : createUnnamed();
        if (fd < 0)
            return cannotWriteIn(folder, errno);
        written.emplace_back(fd);
        if (const int code = writeAll(fd, file.data, cancelled))
            return code == ECANCELED ? cancelledError(folder) : cannotWriteIn(folder, code);
    }

    // From here on it is a matter of names.
    if (unnamed) {
        between.emplace();
        if (::mkdir(part.c_str(), 0777) != 0)
            return cannotWriteIn(folder, errno);
        if (const int code = nameFiles(part, files, written))
            return cannotWriteIn(folder, code);
    }
    const FileDescriptor fresh(::open(part.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    if (fresh.valid())
        ::fsync(fresh.get());
    if (const int code = swapIn(part, path))
        return cannotWriteIn(folder, code);
    const FileDescriptor around(::open(parent.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    if (around.valid())
        ::fsync(around.get());
    return {}; // a replaced folder, now under the unfinished one's name, goes with it
}

} // namespace patina
