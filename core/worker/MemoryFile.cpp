#include "core/worker/MemoryFile.h"

#include "core/worker/WorkerProtocol.h"

#include <cstdint>
#include <cstring>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>
#include <utility>

namespace patina {

namespace {

constexpr int kSeals = F_SEAL_SHRINK | F_SEAL_GROW | F_SEAL_WRITE | F_SEAL_SEAL;

// memfd_create(). The kernel takes no size; in a decoding child the call goes to the client instead
// (app/worker/TrappedCalls.h), which keeps count.
FileDescriptor createFile(std::int64_t size) {
    return FileDescriptor(static_cast<int>(
        ::syscall(SYS_memfd_create, "patina", MFD_CLOEXEC | MFD_ALLOW_SEALING, size)));
}

} // namespace

MemoryFile::~MemoryFile() {
    unmap();
}

MemoryFile::MemoryFile(MemoryFile&& other) noexcept
    : m_fd(std::move(other.m_fd))
    , m_data(std::exchange(other.m_data, nullptr))
    , m_size(std::exchange(other.m_size, 0))
    , m_writable(other.m_writable) {}

MemoryFile& MemoryFile::operator=(MemoryFile&& other) noexcept {
    if (this != &other) {
        unmap();
        m_fd = std::move(other.m_fd);
        m_data = std::exchange(other.m_data, nullptr);
        m_size = std::exchange(other.m_size, 0);
        m_writable = other.m_writable;
    }
    return *this;
}

void MemoryFile::unmap() {
    if (m_data != nullptr)
        ::munmap(m_data, m_size);
    m_data = nullptr;
    m_size = 0;
}

std::optional<MemoryFile> MemoryFile::create(std::size_t size) {
    MemoryFile file;
    file.m_fd = createFile(static_cast<std::int64_t>(size));
    if (!file.m_fd.valid() || ::ftruncate(file.fd(), static_cast<off_t>(size)) != 0)
        return std::nullopt;
    file.m_writable = true;
    if (size == 0)
        return file;
    void* data = ::mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_SHARED, file.fd(), 0);
    if (data == MAP_FAILED)
        return std::nullopt;
    file.m_data = static_cast<std::byte*>(data);
    file.m_size = size;
    return file;
}

FileDescriptor MemoryFile::createGrowing() {
    return createFile(protocol::kGrowing);
}

std::optional<MemoryFile> MemoryFile::copyOf(std::span<const std::byte> data) {
    auto file = create(data.size());
    if (file && !data.empty())
        std::memcpy(file->m_data, data.data(), data.size());
    return file;
}

std::optional<MemoryFile> MemoryFile::open(FileDescriptor fd, std::size_t size, bool sealed) {
    struct stat status {};
    if (!fd.valid() || ::fstat(fd.get(), &status) != 0 || !S_ISREG(status.st_mode) ||
        static_cast<std::size_t>(status.st_size) != size)
        return std::nullopt;
    if (sealed && (::fcntl(fd.get(), F_GET_SEALS) & kSeals) != kSeals)
        return std::nullopt;
    MemoryFile file;
    file.m_fd = std::move(fd);
    if (size == 0)
        return file;
    void* data = ::mmap(nullptr, size, PROT_READ, MAP_SHARED, file.fd(), 0);
    if (data == MAP_FAILED)
        return std::nullopt;
    file.m_data = static_cast<std::byte*>(data);
    file.m_size = size;
    return file;
}

std::span<std::byte> MemoryFile::writable() {
    return m_writable ? std::span<std::byte>(m_data, m_size) : std::span<std::byte>();
}

std::span<const std::byte> MemoryFile::bytes() const {
    return {m_data, m_size};
}

std::string_view MemoryFile::text() const {
    return {reinterpret_cast<const char*>(m_data), m_size};
}

bool MemoryFile::seal() {
    unmap(); // a writable mapping would forbid the seal
    m_writable = false;
    return ::fcntl(fd(), F_ADD_SEALS, kSeals) == 0;
}

} // namespace patina
