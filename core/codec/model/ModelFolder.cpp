#include "core/codec/model/ModelFolder.h"

#include <algorithm>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace patina::codec {

ModelFolder::ModelFolder(std::filesystem::path folder, std::string modelName, int modelFd)
    : m_folder(std::move(folder))
    , m_modelName(std::move(modelName))
    , m_modelFd(modelFd) {}

std::optional<MemoryFile> ModelFolder::open(const std::string& path) const {
    FileDescriptor fd;
    if (path == modelPath()) {
        fd = FileDescriptor(::fcntl(m_modelFd, F_DUPFD_CLOEXEC, 0));
    } else {
        std::string forward = path;
        std::replace(forward.begin(), forward.end(), '\\', '/');
        const auto full = (m_folder / forward).lexically_normal();
        const auto mismatch =
            std::mismatch(m_folder.begin(), m_folder.end(), full.begin(), full.end());
        if (mismatch.first != m_folder.end())
            return std::nullopt;
        fd = FileDescriptor(::open(full.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
    }
    struct stat status {};
    if (!fd.valid() || ::fstat(fd.get(), &status) != 0 || !S_ISREG(status.st_mode))
        return std::nullopt;
    return MemoryFile::open(std::move(fd), static_cast<std::size_t>(status.st_size), false);
}

std::string decodePercent(const std::string& uri) {
    const auto digit = [](char c) {
        if (c >= '0' && c <= '9')
            return c - '0';
        if (c >= 'a' && c <= 'f')
            return c - 'a' + 10;
        if (c >= 'A' && c <= 'F')
            return c - 'A' + 10;
        return -1;
    };
    std::string path;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        if (uri[i] == '%' && i + 2 < uri.size() && digit(uri[i + 1]) >= 0 &&
            digit(uri[i + 2]) >= 0) {
            path += static_cast<char>(digit(uri[i + 1]) * 16 + digit(uri[i + 2]));
            i += 2;
        } else {
            path += uri[i];
        }
    }
    return path;
}

} // namespace patina::codec
