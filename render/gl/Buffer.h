// A block of GPU memory of fixed size: vertices, indices, uniform and storage blocks.
#pragma once

#include "render/gl/Context.h"
#include "render/gl/GpuMemory.h"
#include "render/gl/Handle.h"

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

namespace patina::gl {

void deleteBuffer(unsigned id);

class Buffer {
  public:
    Buffer() = default; // empty: id 0, no context needed
    // `size` > 0 bytes, zero-filled; or a copy of `data`, which must not be empty.
    Buffer(Context& context, std::string_view label, std::size_t size);
    Buffer(Context& context, std::string_view label, std::span<const std::byte> data);

    template <class T>
    static Buffer of(Context& context, std::string_view label, std::span<const T> values) {
        return Buffer(context, label, std::as_bytes(values));
    }

    [[nodiscard]] unsigned id() const { return m_handle.id(); }
    [[nodiscard]] bool empty() const { return id() == 0; }
    [[nodiscard]] std::size_t size() const { return m_size; } // bytes

    // Replaces a part; CHECKs that it lies inside.
    void write(std::size_t offset, std::span<const std::byte> data);
    template <class T>
    void writeValue(const T& value) {
        write(0, std::as_bytes(std::span<const T>(&value, 1)));
    }
    [[nodiscard]] std::vector<std::byte> read() const; // waits for the GPU

    void bindUniform(unsigned binding) const;
    void bindStorage(unsigned binding) const;

  private:
    Handle<deleteBuffer> m_handle;
    std::size_t m_size = 0;
    CountedBytes m_counted;
};

} // namespace patina::gl
