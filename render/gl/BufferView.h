// A part of a buffer as shaders fetch it through a samplerBuffer: four floats at a time.
#pragma once

#include "render/gl/Buffer.h"
#include "render/gl/Texture.h"

namespace patina::gl {

class BufferView {
  public:
    BufferView(Context& context, std::string_view label);

    // Shows `size` bytes from `offset`, a multiple of kAlignment; both inside the buffer, which
    // must outlive what is drawn.
    void show(const Buffer& buffer, std::size_t offset, std::size_t size) const;
    void bind(unsigned unit) const;

    static constexpr std::size_t kAlignment =
        256; // no driver asks for more (OpenGL 4.6, table 23.55)
    [[nodiscard]] static std::size_t maxBytes(); // that can be shown at once

  private:
    Handle<deleteTexture> m_handle;
};

} // namespace patina::gl
