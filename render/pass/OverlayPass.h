// What the editor draws over the picture: ground grid, outline of the selection, lights,
// a lobe on the surface.
// It is added after tone mapping, so exposure does not touch it.
#pragma once

#include "render/pass/LobePass.h"
#include "render/pass/ScreenPasses.h"
#include "render/scene/DrawList.h"
#include "render/scene/LightGizmo.h"
#include "render/scene/MeshGizmo.h"

namespace patina::render {

struct OverlaySettings {
    Id selectedMesh = 0;                      // outlined; 0: none
    Id selectedLight = 0;                     // shown with its handles; 0: none
    const MeshHandles* meshHandles = nullptr; // of the selected mesh; null: not shown
    const SurfaceLobe* lobe = nullptr;
    float scale = 1.0f; // pixels per pixel that marks are sized in
    View look;          // exposure of the grid
};

class OverlayPass {
  public:
    OverlayPass(gl::Context& context, ShaderLibrary& shaders, ScreenPasses& screen)
        : m_context(context)
        , m_shaders(shaders)
        , m_screen(screen)
        , m_lobe(context, shaders)
        , m_noAttributes(context, "no attributes") {}

    // Onto `canvas`, with the depth of targets, which may have fewer pixels. `frame` is that of the
    // canvas' size, and bound.
    Result<void> draw(const Canvas& canvas, const Targets& targets, const GpuScene& scene,
                      const FrameBlock& frame, const Camera& camera,
                      const OverlaySettings& settings);
    // The two parts of that. Which pixels the selection covers is kept from the first to the
    // second, which may be drawn in bands (glScissor).
    Result<void> drawMask(const Canvas& canvas, const GpuScene& scene,
                          const OverlaySettings& settings);
    Result<void> drawLines(const Canvas& canvas, const Targets& targets, const GpuScene& scene,
                           const FrameBlock& frame, const Camera& camera,
                           const OverlaySettings& settings);

  private:
    Result<void> drawGrid(const Canvas& canvas, const Targets& targets, const View& view,
                          const Camera& camera);
    Result<void> drawOutline(const Canvas& canvas, const OverlaySettings& settings);
    Result<void> drawLights(const Canvas& canvas, const GpuScene& scene, const FrameBlock& frame,
                            const OverlaySettings& settings);
    Result<void> drawMeshHandles(const Canvas& canvas, const FrameBlock& frame,
                                 const MeshHandles& handles, float pixels);
    Result<void> drawHandle(const GizmoPoint& handle, float scale);
    Result<void> drawLobe(const Canvas& canvas, const Targets& targets, const SurfaceLobe& lobe,
                          const FrameBlock& frame, float pixels);
    Result<void> drawLine(const GizmoLine& line, float scale);
    Result<void> drawMark(const char* shape, const glm::vec2& center, const glm::vec2& axisX,
                          const glm::vec2& axisY, const glm::vec3& color, float scale);

    gl::Context& m_context;
    ShaderLibrary& m_shaders;
    ScreenPasses& m_screen;
    LobePass m_lobe;
    gl::VertexArray m_noAttributes;
    bool m_hasMask = false; // something is selected
    gl::Texture m_mask;
    gl::Framebuffer m_maskTarget;
};

} // namespace patina::render
