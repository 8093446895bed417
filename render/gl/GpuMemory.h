// How much memory this process has asked OpenGL for, of all contexts: what the driver rounds up,
// its programs and its own buffers are not known. With software OpenGL it is the process's memory.
#pragma once

#include <cstddef>

namespace patina::gl {

struct GpuMemory {
    std::size_t textures = 0, buffers = 0; // bytes
};

[[nodiscard]] GpuMemory gpuMemory(); // on any thread

enum class GpuUse { Texture, Buffer };

// Counts bytes for as long as it lives.
class CountedBytes {
  public:
    CountedBytes() = default;
    CountedBytes(GpuUse use, std::size_t bytes);
    CountedBytes(CountedBytes&& other) noexcept;
    CountedBytes& operator=(CountedBytes&& other) noexcept;
    ~CountedBytes();

  private:
    GpuUse m_use = GpuUse::Texture;
    std::size_t m_bytes = 0;
};

} // namespace patina::gl
