// Which mesh instance lies under a pixel: the ids are drawn once more, on demand, with the scissor
// closed around the pixel.
#pragma once

#include "render/gl/Framebuffer.h"
#include "render/scene/DrawList.h"
#include "render/shader/ShaderLibrary.h"

namespace patina::render {

class PickPass {
  public:
    PickPass(gl::Context& context, ShaderLibrary& shaders)
        : m_context(context)
        , m_shaders(shaders) {}

    // (x, y) from the bottom left of a picture of width × height; 0: nothing there. The frame's
    // uniform block is bound.
    Result<Id> pick(const std::vector<DrawItem>& items, const glm::mat4& worldToClip, int width,
                    int height, int x, int y);
    // Where the last pixel was drawn: its depth is there.
    [[nodiscard]] const gl::Framebuffer& target() const { return m_target; }

  private:
    gl::Context& m_context;
    ShaderLibrary& m_shaders;
    gl::Texture m_ids, m_depth;
    gl::Framebuffer m_target;
};

} // namespace patina::render
