#include "render/gl/BufferView.h"

#include "core/base/Check.h"

#include <epoxy/gl.h>

namespace patina::gl {

BufferView::BufferView(Context&, std::string_view label) {
    GLuint name = 0;
    glCreateTextures(GL_TEXTURE_BUFFER, 1, &name);
    m_handle = Handle<deleteTexture>(name);
    glObjectLabel(GL_TEXTURE, name, static_cast<GLsizei>(label.size()), label.data());
}

void BufferView::show(const Buffer& buffer, std::size_t offset, std::size_t size) const {
    CHECK(offset % kAlignment == 0);
    CHECK_LE(offset + size, buffer.size());
    glTextureBufferRange(m_handle.id(), GL_RGBA32F, buffer.id(), static_cast<GLintptr>(offset),
                         static_cast<GLsizeiptr>(size));
}

void BufferView::bind(unsigned unit) const {
    glBindTextureUnit(unit, m_handle.id());
}

std::size_t BufferView::maxBytes() {
    GLint texels = 0;
    glGetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &texels);
    return static_cast<std::size_t>(texels) * 4 * sizeof(float);
}

} // namespace patina::gl
