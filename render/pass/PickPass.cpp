#include "render/pass/PickPass.h"

#include "render/pass/SurfacePass.h"

#include <epoxy/gl.h>

namespace patina::render {

Result<Id> PickPass::pick(const std::vector<DrawItem>& items, const glm::mat4& worldToClip,
                          int width, int height, int x, int y) {
    if (m_ids.width() != width || m_ids.height() != height) {
        m_target = {};
        m_ids = gl::Texture(m_context, "ids",
                            {.format = gl::PixelFormat::R32ui, .width = width, .height = height});
        m_depth =
            gl::Texture(m_context, "id depth",
                        {.format = gl::PixelFormat::Depth32f, .width = width, .height = height});
        auto target = gl::Framebuffer::create(m_context, "ids", {&m_ids}, &m_depth);
        if (!target)
            return target.error();
        m_target = std::move(*target);
    }
    m_target.bind();
    glScissor(x, y, 1, 1);
    glEnable(GL_SCISSOR_TEST);
    m_target.clearIds(0);
    m_target.clearDepth(1.0f);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LESS);
    glDepthMask(GL_TRUE);
    glDisable(GL_BLEND);

    Result<Id> result = Id{0};
    for (const DrawItem& item : items) {
        if (!insideFrustum(item.bounds, worldToClip))
            continue;
        const SurfaceFeatures features = coverageFeatures(item.material->features);
        auto shader = m_shaders.program({{"surface.vert", "id.frag"}, surfaceDefines(features)});
        if (!shader) {
            result = shader.error();
            break;
        }
        (*shader)->use();
        bindMap(*item.material, MaterialInput::BaseColor);
        drawItem(item, isCulled(item));
    }
    glDisable(GL_SCISSOR_TEST);
    if (result) {
        GLuint id = 0;
        glPixelStorei(GL_PACK_ALIGNMENT, 1);
        glBindFramebuffer(GL_READ_FRAMEBUFFER, m_target.id());
        glReadPixels(x, y, 1, 1, GL_RED_INTEGER, GL_UNSIGNED_INT, &id);
        result = Id{id};
    }
    return result;
}

} // namespace patina::render
