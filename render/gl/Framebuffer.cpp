#include "render/gl/Framebuffer.h"

#include <algorithm>
#include <array>
#include <epoxy/gl.h>
#include <fmt/format.h>
#include <vector>

namespace patina::gl {

void deleteFramebuffer(unsigned id) {
    glDeleteFramebuffers(1, &id);
}

Result<Framebuffer> Framebuffer::create(Context&, std::string_view label,
                                        std::initializer_list<const Texture*> colors,
                                        const Texture* depth) {
    GLuint name = 0;
    glCreateFramebuffers(1, &name);
    Framebuffer result;
    result.m_handle = Handle<deleteFramebuffer>(name);
    glObjectLabel(GL_FRAMEBUFFER, name, static_cast<GLsizei>(label.size()), label.data());

    std::vector<GLenum> attachments;
    for (const Texture* color : colors) {
        attachments.push_back(GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(attachments.size()));
        glNamedFramebufferTexture(name, attachments.back(), color->id(), 0);
        result.m_width = color->width();
        result.m_height = color->height();
    }
    if (depth) {
        glNamedFramebufferTexture(name, GL_DEPTH_ATTACHMENT, depth->id(), 0);
        result.m_width = depth->width();
        result.m_height = depth->height();
    }
    glNamedFramebufferDrawBuffers(name, static_cast<GLsizei>(attachments.size()),
                                  attachments.data());

    const GLenum status = glCheckNamedFramebufferStatus(name, GL_DRAW_FRAMEBUFFER);
    if (status != GL_FRAMEBUFFER_COMPLETE)
        return Error{ErrorKind::Internal,
                     "The graphics driver cannot draw into the needed image formats; try fewer "
                     "samples or another driver.",
                     {},
                     fmt::format("framebuffer {} status 0x{:x}", label, status)};
    return result;
}

void Framebuffer::bind() const {
    glBindFramebuffer(GL_FRAMEBUFFER, id());
    glViewport(0, 0, m_width, m_height);
}

void Framebuffer::clearColor(float r, float g, float b, float a) const {
    const std::array<float, 4> value{r, g, b, a};
    glClearNamedFramebufferfv(id(), GL_COLOR, 0, value.data());
}

void Framebuffer::clearIds(unsigned value) const {
    const std::array<GLuint, 4> values{value, 0, 0, 0};
    glClearNamedFramebufferuiv(id(), GL_COLOR, 0, values.data());
}

void Framebuffer::clearDepth(float depth) const {
    glClearNamedFramebufferfv(id(), GL_DEPTH, 0, &depth);
}

void Framebuffer::resolveTo(const Framebuffer& target, bool withDepth) const {
    const GLbitfield parts = GL_COLOR_BUFFER_BIT | (withDepth ? GL_DEPTH_BUFFER_BIT : 0u);
    glBlitNamedFramebuffer(id(), target.id(), 0, 0, m_width, m_height, 0, 0, m_width, m_height,
                           parts, GL_NEAREST);
}

} // namespace patina::gl
