// The edges of all triangles that are seen, over the displayed picture.
#pragma once

#include "render/gl/Framebuffer.h"
#include "render/scene/DrawList.h"
#include "render/shader/ShaderLibrary.h"

namespace patina::render {

class ScreenPasses;

class WirePass {
  public:
    WirePass(gl::Context& context, ShaderLibrary& shaders, const ScreenPasses& screen)
        : m_context(context)
        , m_shaders(shaders)
        , m_screen(screen) {}

    // Blends the lines into `target` of width × height; the frame's block is bound.
    Result<void> draw(const DrawList& list, const glm::vec3& side, int width, int height,
                      const gl::Framebuffer& target);

  private:
    gl::Context& m_context;
    ShaderLibrary& m_shaders;
    const ScreenPasses& m_screen;
    gl::Texture m_mask, m_depth;
    gl::Framebuffer m_lines;
};

} // namespace patina::render
