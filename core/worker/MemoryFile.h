// Memory that one process fills and another reads: an unnamed file in memory (memfd). It is sealed
// before it changes hands, so that its reader can rely on a size and content that stay.
#pragma once

#include "core/base/FileDescriptor.h"

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

namespace patina {

class MemoryFile {
  public:
    MemoryFile() = default; // empty, no descriptor
    ~MemoryFile();
    MemoryFile(MemoryFile&& other) noexcept;
    MemoryFile& operator=(MemoryFile&& other) noexcept;

    // Zero-filled and writable. Nothing when there is no memory for it.
    static std::optional<MemoryFile> create(std::size_t size);
    static std::optional<MemoryFile> copyOf(std::span<const std::byte> data);
    // Empty, and as long as what is written to it, by its descriptor. For encoders.
    static FileDescriptor createGrowing();
    // The reader's side: maps `size` bytes of a sealed memory file, or of an ordinary file when
    // `sealed` is false. Nothing when the descriptor is not what it claims to be.
    static std::optional<MemoryFile> open(FileDescriptor fd, std::size_t size, bool sealed = true);

    [[nodiscard]] std::span<std::byte> writable(); // only before seal()
    [[nodiscard]] std::span<const std::byte> bytes() const;
    [[nodiscard]] std::string_view text() const;
    [[nodiscard]] int fd() const { return m_fd.get(); }

    // Ends writing, for everybody and for ever; bytes() is empty afterwards in this process.
    [[nodiscard]] bool seal();

  private:
    void unmap();
    FileDescriptor m_fd;
    std::byte* m_data = nullptr;
    std::size_t m_size = 0;
    bool m_writable = false;
};

} // namespace patina
