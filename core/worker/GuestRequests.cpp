#include "core/worker/GuestRequests.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <fcntl.h>
#include <fmt/format.h>
#include <linux/sockios.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

namespace patina {

namespace {

namespace fs = std::filesystem;

// A model of many parts reads some hundred files, and tries a few names for each.
constexpr int kMostRequests = 20000;

bool isBelow(const fs::path& folder, const fs::path& path) {
    auto [in, part] = std::mismatch(folder.begin(), folder.end(), path.begin(), path.end());
    if (in != folder.end() || part == path.end())
        return false;
    return std::none_of(part, path.end(),
                        [](const fs::path& name) { return name.native().starts_with('.'); });
}

FileDescriptor open(const fs::path& path, int flags) {
    return FileDescriptor(::open(path.c_str(), flags | O_CLOEXEC | O_NOCTTY | O_NONBLOCK));
}

fs::path nameOf(const FileDescriptor& file) {
    return fmt::format("/proc/self/fd/{}", file.get());
}

} // namespace

int openBelow(const fs::path& folder, const fs::path& path, FileDescriptor& file) {
    const fs::path plain = path.lexically_normal();
    if (folder.empty() || !isBelow(folder, plain))
        return EACCES;
    // Where the file lies is looked up once it is held, so that nobody can exchange it afterwards;
    // it is held without being opened, as opening a device can have an effect.
    const FileDescriptor held = open(plain, O_PATH);
    if (!held.valid())
        return errno;
    std::error_code failed;
    const fs::path real = fs::read_symlink(nameOf(held), failed);
    struct stat status {};
    if (failed || !isBelow(folder, real) || ::fstat(held.get(), &status) != 0 ||
        !S_ISREG(status.st_mode))
        return EACCES;
    file = open(nameOf(held), O_RDONLY);
    return file.valid() ? 0 : errno;
}

GuestRequests::GuestRequests(GuestRights rights)
    : m_rights(std::move(rights))
    , m_memoryLeft(m_rights.memoryBytes)
    , m_mayGrow(m_rights.encodes) {}

int GuestRequests::openFile(std::string_view path, FileDescriptor& file) const {
    const fs::path wanted(path);
    if (!m_rights.file.empty() && wanted == m_rights.file)
        return openPayload(file);
    return openBelow(m_rights.folder, wanted, file);
}

// A second descriptor of its own: with a position of its own, and for reading only.
int GuestRequests::openPayload(FileDescriptor& file) const {
    file = FileDescriptor(
        ::open(fmt::format("/proc/self/fd/{}", m_rights.payloadFd).c_str(), O_RDONLY | O_CLOEXEC));
    return file.valid() ? 0 : errno;
}

int GuestRequests::createMemory(std::int64_t size, FileDescriptor& file) {
    const bool grows = size == protocol::kGrowing;
    if (grows ? !m_mayGrow : size < 0)
        return EPERM;
    if (!grows && static_cast<std::uint64_t>(size) > m_memoryLeft)
        return ENOMEM;
    file = FileDescriptor(::memfd_create("patina-guest", MFD_CLOEXEC | MFD_ALLOW_SEALING));
    if (!file.valid())
        return errno;
    if (grows) {
        m_mayGrow = false; // RLIMIT_FSIZE bounds this one
        return 0;
    }
    if (::ftruncate(file.get(), static_cast<off_t>(size)) != 0 ||
        ::fcntl(file.get(), F_ADD_SEALS, F_SEAL_GROW | F_SEAL_SHRINK) != 0)
        return errno;
    m_memoryLeft -= static_cast<std::size_t>(size);
    return 0;
}

bool GuestRequests::answer(int socket, const protocol::Report& report, std::string_view path) {
    // Descriptors on their way count against the user: a child that does not fetch what it was sent
    // gets no more.
    int unread = 0;
    if (++m_count > kMostRequests || ::ioctl(socket, SIOCOUTQ, &unread) != 0 || unread != 0)
        return false;
    FileDescriptor file;
    protocol::Grant grant;
    switch (report.event) {
    case protocol::Event::OpenFile:
        grant.error = openFile(path, file);
        break;
    case protocol::Event::OpenPayload:
        grant.error = openPayload(file);
        break;
    case protocol::Event::CreateMemory:
        grant.error = createMemory(report.value, file);
        break;
    default:
        return false;
    }
    if (grant.error != 0)
        return protocol::send(socket, grant);
    const std::array<int, 1> descriptors{file.get()};
    return protocol::send(socket, grant, descriptors);
}

} // namespace patina
