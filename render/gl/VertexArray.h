// Which buffers feed which vertex attributes. The buffers must outlive it.
#pragma once

#include "render/gl/Buffer.h"

namespace patina::gl {

void deleteVertexArray(unsigned id);

class VertexArray {
  public:
    VertexArray() = default; // empty: id 0, no context needed
    VertexArray(Context& context, std::string_view label);

    [[nodiscard]] unsigned id() const { return m_handle.id(); }
    [[nodiscard]] bool empty() const { return id() == 0; }

    // `components` floats for attribute `location` at `offset` + i · `stride` bytes.
    // The array's state is the driver's: what is const here is which array it is.
    void setFloats(unsigned location, int components, const Buffer& buffer, std::size_t offset,
                   std::size_t stride) const;
    // Zero for all vertices.
    void setConstant(unsigned location) const;
    void setIndices(const Buffer& buffer); // 32-bit

    void bind() const;

  private:
    Handle<deleteVertexArray> m_handle;
};

} // namespace patina::gl
