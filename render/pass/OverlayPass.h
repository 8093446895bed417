// What the editor draws over the picture: ground grid, outline of the selection, marks of lights.
// It is added after tone mapping, so exposure does not touch it.
#pragma once

#include "render/pass/ScreenPasses.h"
#include "render/scene/DrawList.h"

namespace patina::render {

class OverlayPass {
  public:
    OverlayPass(gl::Context& context, ShaderLibrary& shaders, ScreenPasses& screen)
        : m_context(context)
        , m_shaders(shaders)
        , m_screen(screen)
        , m_noAttributes(context, "no attributes") {}

    // Into targets.display(). `selected`: the outlined instance, 0 for none.
    Result<void> draw(const Targets& targets, const GpuScene& scene, const FrameBlock& frame,
                      const Camera& camera, Id selected);

  private:
    Result<void> drawGrid(const Targets& targets, const View& view, const Camera& camera);
    Result<void> drawOutline(const Targets& targets, const GpuScene& scene, Id selected);
    Result<void> drawLights(const Targets& targets, const GpuScene& scene, const FrameBlock& frame);
    Result<void> drawMark(const char* shape, const glm::vec2& center, const glm::vec2& axisX,
                          const glm::vec2& axisY, const glm::vec3& color, float scale);

    gl::Context& m_context;
    ShaderLibrary& m_shaders;
    ScreenPasses& m_screen;
    gl::VertexArray m_noAttributes;
    gl::Texture m_mask;
    gl::Framebuffer m_maskTarget;
};

} // namespace patina::render
