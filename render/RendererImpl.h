// The inside of Renderer: Renderer.cpp draws the picture, RendererViews.cpp the views of its terms.
#pragma once

#include "render/Renderer.h"
#include "render/pass/AdaptationPass.h"
#include "render/pass/InspectPass.h"
#include "render/pass/OverlayPass.h"
#include "render/pass/PickPass.h"
#include "render/pass/RelightPass.h"
#include "render/pass/ScreenPasses.h"
#include "render/pass/ShadowPass.h"
#include "render/pass/SheetTargets.h"
#include "render/pass/SurfacePass.h"
#include "render/pass/Targets.h"
#include "render/pass/ViewPass.h"
#include "render/pass/WirePass.h"
#include "render/scene/DrawList.h"
#include "render/scene/GpuScene.h"

namespace patina::render {

// OpenGL's rows go from bottom to top. RGBA of floats or bytes.
void flipRows(Image& image);

struct Renderer::Impl {
    Impl(gl::Context& c, const std::filesystem::path& shaderFolder)
        : context(c)
        , shaders(c, shaderFolder)
        , scene(c)
        , shadows(c, shaders)
        , relight(c, shaders)
        , surface(shaders)
        , adaptation(c, shaders)
        , screen(c, shaders)
        , views(c, shaders, screen)
        , wires(c, shaders, screen)
        , overlay(c, shaders, screen)
        , picking(c, shaders)
        , inspection(c)
        , frameBlock(c, "frame", sizeof(FrameBlock)) {}

    gl::Context& context;
    ShaderLibrary shaders;
    GpuScene scene;
    ShadowPass shadows;
    RelightPass relight;
    SurfacePass surface;
    AdaptationPass adaptation;
    ScreenPasses screen;
    ViewPass views;
    WirePass wires;
    OverlayPass overlay;
    PickPass picking;
    InspectPass inspection;
    gl::Buffer frameBlock;
    Targets targets;
    SheetTargets sheet;
    FrameBlock lastBlock; // of the last frame
    FrameSettings lastFrame;
    int accumulated = 0;         // frames that the last one is the mean of
    bool sceneIsNew = true;      // something was set since the last frame
    bool luminanceIsNew = true;  // the last frame's scene has not been measured
    bool luminanceKnown = false; // some frame has been measured
    std::optional<ViewRange> shownRange, otherRange;

    // --- Renderer.cpp
    [[nodiscard]] FrameBlock packFrame(const FrameSettings& frame) const;
    void useFrame(const FrameBlock& block);
    // How a view of this kind is lit.
    [[nodiscard]] LightingMode lightingFor(const ViewSettings& view, ViewKind kind) const;
    [[nodiscard]] SurfaceSettings surfaceSettings(const FrameBlock& block, SurfaceOutput output,
                                                  LightingMode lighting) const;
    // The scene with its background into a target of radiance.
    Result<void> drawPicture(const FrameSettings& frame, const FrameBlock& block,
                             const gl::Framebuffer& target, SurfaceOutput output,
                             bool withBackground, ViewKind kind = shading::kViewFinal);
    Result<void> show(const FrameSettings& frame, unsigned targetFramebuffer);
    Result<void> adapt(const FrameSettings& frame);
    void beginGl();
    void endGl(unsigned targetFramebuffer);

    // --- RendererViews.cpp
    // What the frame shows, both sides of its limit, into targets.display(). `drawsScene`: else the
    // last frame's radiance or numbers are shown anew.
    Result<void> drawViews(const FrameSettings& frame, bool drawsScene);
    Result<void> drawSide(const FrameSettings& frame, const ViewChoice& choice,
                          const glm::vec3& side, bool drawsScene);
    // The radiance that a side shows, into targets.linear().
    Result<void> drawRadiance(const FrameSettings& frame, const ViewChoice& choice,
                              std::size_t sideIndex);
    // The numbers of views into a target of floats; anti-aliased where that is multisampled.
    Result<void> drawNumbers(const FrameSettings& frame, const FrameBlock& block,
                             const gl::Framebuffer& target, const ViewsBlock& settings,
                             bool asPicture, SurfaceOutput output,
                             ViewKind kind = shading::kViewFinal);
    // Settings of `choices`, eight at most; `halfFloats`: the target is of half floats.
    [[nodiscard]] ViewsBlock viewsBlock(const ViewSettings& view,
                                        std::span<const ViewChoice> choices, bool halfFloats) const;
    // The numbers of one view of the last frame, looked at in another way.
    Result<Image> readNumbers(const ViewSettings& view, const ViewChoice& choice);
    Result<void> showOnSheet(const FrameSettings& frame, const FrameBlock& block,
                             const ViewChoice& choice, const gl::Texture& values);
    Result<ViewRange> rangeFor(const ViewChoice& choice, const gl::Texture& values);
};

} // namespace patina::render
