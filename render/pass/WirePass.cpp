#include "render/pass/WirePass.h"

#include "render/pass/ScreenPasses.h"
#include "render/pass/SurfacePass.h"

#include <epoxy/gl.h>

namespace patina::render {

Result<void> WirePass::draw(const DrawList& list, const glm::vec3& side, int width, int height,
                            const gl::Framebuffer& target) {
    if (m_mask.width() != width || m_mask.height() != height) {
        m_lines = {};
        m_mask = gl::Texture(m_context, "wires",
                             {.format = gl::PixelFormat::R8, .width = width, .height = height});
        m_depth =
            gl::Texture(m_context, "wire depth",
                        {.format = gl::PixelFormat::Depth32f, .width = width, .height = height});
        auto made = gl::Framebuffer::create(m_context, "wires", {&m_mask}, &m_depth);
        if (!made)
            return made.error();
        m_lines = std::move(*made);
    }
    const auto mask = m_shaders.program({{"surface.vert", "mask.frag"}, {}});
    const auto shader = m_shaders.program({{"screen.vert", "wire.frag"}, {}});
    if (!mask || !shader)
        return mask ? shader.error() : mask.error();

    m_lines.bind();
    m_lines.clearColor(0.0f, 0.0f, 0.0f, 0.0f);
    m_lines.clearDepth(1.0f);
    glDisable(GL_BLEND);
    glEnable(GL_DEPTH_TEST);
    glDepthMask(GL_TRUE);
    (*mask)->use();
    // Faces first, pushed back a little, so that hidden edges stay hidden and their own show.
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    glEnable(GL_POLYGON_OFFSET_FILL);
    glPolygonOffset(1.0f, 2.0f);
    for (const auto* items : {&list.opaque, &list.blended})
        for (const DrawItem* item : *items)
            drawItem(*item, isCulled(*item));
    glDisable(GL_POLYGON_OFFSET_FILL);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glDepthFunc(GL_LEQUAL);
    glPolygonMode(GL_FRONT_AND_BACK, GL_LINE);
    for (const auto* items : {&list.opaque, &list.blended})
        for (const DrawItem* item : *items)
            drawItem(*item, isCulled(*item));
    glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
    glDepthFunc(GL_LESS);

    target.bind();
    (*shader)->use();
    (*shader)->set("u_side", side);
    m_mask.bind(0);
    glDisable(GL_DEPTH_TEST);
    glEnable(GL_BLEND);
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    m_screen.drawTriangle();
    glDisable(GL_BLEND);
    return {};
}

} // namespace patina::render
