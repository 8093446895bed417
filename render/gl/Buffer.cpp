#include "render/gl/Buffer.h"

#include "core/base/Check.h"
#include "render/gl/Uploads.h"

#include <epoxy/gl.h>

namespace patina::gl {

namespace {

Handle<deleteBuffer> makeBuffer(std::string_view label, std::size_t size, const void* data) {
    CHECK(size > 0);
    GLuint id = 0;
    glCreateBuffers(1, &id);
    glNamedBufferStorage(id, static_cast<GLsizeiptr>(size), data, GL_DYNAMIC_STORAGE_BIT);
    glObjectLabel(GL_BUFFER, id, static_cast<GLsizei>(label.size()), label.data());
    return Handle<deleteBuffer>(id);
}

} // namespace

void deleteBuffer(unsigned id) {
    glDeleteBuffers(1, &id);
}

Buffer::Buffer(Context&, std::string_view label, std::size_t size)
    : m_handle(makeBuffer(label, size, nullptr))
    , m_size(size)
    , m_counted(GpuUse::Buffer, size) {
    glClearNamedBufferData(id(), GL_R8UI, GL_RED_INTEGER, GL_UNSIGNED_BYTE, nullptr);
}

Buffer::Buffer(Context&, std::string_view label, std::span<const std::byte> data)
    : m_handle(makeBuffer(label, data.size(), data.data()))
    , m_size(data.size())
    , m_counted(GpuUse::Buffer, data.size()) {
    countUpload(data.size());
}

void Buffer::write(std::size_t offset, std::span<const std::byte> data) {
    CHECK_LE(offset + data.size(), m_size);
    countUpload(data.size());
    glNamedBufferSubData(id(), static_cast<GLintptr>(offset), static_cast<GLsizeiptr>(data.size()),
                         data.data());
}

std::vector<std::byte> Buffer::read() const {
    std::vector<std::byte> result(m_size);
    if (!empty())
        glGetNamedBufferSubData(id(), 0, static_cast<GLsizeiptr>(m_size), result.data());
    return result;
}

void Buffer::bindUniform(unsigned binding) const {
    glBindBufferBase(GL_UNIFORM_BUFFER, binding, id());
}

void Buffer::bindStorage(unsigned binding) const {
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, id());
}

} // namespace patina::gl
