#include "render/gl/VertexArray.h"

#include <epoxy/gl.h>

namespace patina::gl {

void deleteVertexArray(unsigned id) {
    glDeleteVertexArrays(1, &id);
}

VertexArray::VertexArray(Context&, std::string_view label) {
    GLuint name = 0;
    glCreateVertexArrays(1, &name);
    m_handle = Handle<deleteVertexArray>(name);
    glObjectLabel(GL_VERTEX_ARRAY, name, static_cast<GLsizei>(label.size()), label.data());
}

void VertexArray::setFloats(unsigned location, int components, const Buffer& buffer,
                            std::size_t offset, std::size_t stride) const {
    glEnableVertexArrayAttrib(id(), location);
    glVertexArrayAttribFormat(id(), location, components, GL_FLOAT, GL_FALSE, 0);
    glVertexArrayAttribBinding(id(), location, location);
    glVertexArrayVertexBuffer(id(), location, buffer.id(), static_cast<GLintptr>(offset),
                              static_cast<GLsizei>(stride));
}

void VertexArray::setConstant(unsigned location) const {
    glDisableVertexArrayAttrib(id(), location);
    glVertexAttrib4f(location, 0.0f, 0.0f, 0.0f, 0.0f);
}

void VertexArray::setIndices(const Buffer& buffer) {
    glVertexArrayElementBuffer(id(), buffer.id());
}

void VertexArray::bind() const {
    glBindVertexArray(id());
}

} // namespace patina::gl
