#include "core/base/InputFile.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

namespace patina {

namespace {

Error missing(const std::filesystem::path& path, std::string message, std::string detail = {}) {
    return {ErrorKind::InputMissing, std::move(message), path, std::move(detail)};
}

// A text of less than 1,024 bytes that stands for a file which was not downloaded
// (git-lfs/docs/spec.md).
bool isGitLfsPointer(const RegularFile& file) {
    constexpr std::string_view kBegin = "version https://git-lfs.github.com/spec/";
    std::array<char, kBegin.size()> head{};
    return file.size >= head.size() && file.size < 1024 &&
           ::pread(file.fd.get(), head.data(), head.size(), 0) ==
               static_cast<ssize_t>(head.size()) &&
           std::string_view(head.data(), head.size()) == kBegin;
}

} // namespace

Result<RegularFile> openRegularFile(const std::filesystem::path& path) {
    // Looked at before it is opened: opening a device may start something (a tape, a watchdog).
    struct stat status {};
    if (::stat(path.c_str(), &status) == 0 && !S_ISREG(status.st_mode) && !S_ISDIR(status.st_mode))
        return missing(path, "this is a pipe or a device; choose an ordinary file");
    RegularFile file;
    // O_NONBLOCK: opening a pipe that nobody writes to would wait for ever.
    file.fd = FileDescriptor(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY));
    if (!file.fd.valid()) {
        if (errno == ENOENT || errno == ENOTDIR)
            return missing(path, std::string(kNoSuchFile));
        if (errno == EACCES)
            return missing(path, "the file cannot be read; you do not have the permission");
        return missing(path, "the file cannot be opened", std::strerror(errno));
    }
    // And again: the name may stand for something else by now.
    if (::fstat(file.fd.get(), &status) != 0)
        return missing(path, "the file cannot be read", std::strerror(errno));
    if (S_ISDIR(status.st_mode))
        return missing(path, "this is a folder; choose a file inside it");
    if (!S_ISREG(status.st_mode))
        return missing(path, "this is a pipe or a device; choose an ordinary file");
    file.size = static_cast<std::size_t>(status.st_size);
    if (isGitLfsPointer(file))
        return Error{ErrorKind::InputBroken,
                     "this is a Git LFS pointer, in place of the file itself; run \"git lfs pull\" "
                     "in its folder to download it",
                     path,
                     {}};
    return file;
}

Result<InputFile> openInputFile(const std::filesystem::path& path, std::size_t maxSize) {
    Result<RegularFile> opened = openRegularFile(path);
    if (!opened)
        return opened.error();
    InputFile file;
    file.fd = std::move(opened->fd);
    file.size = opened->size;
    if (file.size == 0)
        return Error{
            ErrorKind::InputBroken, "the file is empty; save or download it again", path, {}};
    if (file.size > maxSize)
        return Error{ErrorKind::InputBroken,
                     fmt::format("the file is larger than the supported {} MiB", maxSize >> 20),
                     path,
                     {}};
    constexpr std::size_t kHead = 64;
    file.head.resize(std::min(kHead, file.size));
    const ssize_t got = ::pread(file.fd.get(), file.head.data(), file.head.size(), 0);
    if (got < 0)
        return missing(path, "the file cannot be read", std::strerror(errno));
    file.head.resize(static_cast<std::size_t>(got));
    return file;
}

} // namespace patina
