// The inside of SceneRenderer: what the pictures of a scene share, and how the scene is drawn into
// a target of any of them.
#pragma once

#include "render/SceneRenderer.h"
#include "render/pass/InspectPass.h"
#include "render/pass/PickPass.h"
#include "render/pass/ReadTargets.h"
#include "render/pass/RelightPass.h"
#include "render/pass/ScreenPasses.h"
#include "render/pass/ShadowPass.h"
#include "render/pass/SurfacePass.h"
#include "render/pass/ViewPass.h"
#include "render/scene/DrawList.h"
#include "render/scene/GpuScene.h"
#include "render/view/FrameSettings.h"

#include <cstdint>
#include <map>
#include <span>

namespace patina::render {

// One drawing of the scene: a picture, a side of it, numbers of views.
struct SceneDraw {
    const FrameSettings& frame;
    const FrameBlock& block; // in use
    const gl::Framebuffer& target;
    SurfaceOutput output = SurfaceOutput::Picture;
    ViewKind kind = shading::kViewFinal; // which may say how it is lit
    bool withBackground = false;
    bool floats = false;         // the target's colour is of 32-bit floats
    SceneSlice* slice = nullptr; // what is drawn of the scene; null: all of it
};

struct SceneRenderer::Impl {
    Impl(gl::Context& c, const std::filesystem::path& shaderFolder)
        : context(c)
        , shaders(c, shaderFolder)
        , scene(c)
        , shadows(c, shaders)
        , relight(c, shaders)
        , surface(shaders)
        , screen(c, shaders)
        , views(c, shaders, screen)
        , picking(c, shaders)
        , inspection(c)
        , frameBlock(c, "frame", sizeof(FrameBlock)) {}

    gl::Context& context;
    ShaderLibrary shaders;
    GpuScene scene;
    ShadowPass shadows;
    RelightPass relight;
    SurfacePass surface;
    ScreenPasses screen;
    ViewPass views;
    PickPass picking;
    InspectPass inspection;
    gl::Buffer frameBlock;
    ReadTargets reading; // of whichever picture is looked at

    // --- What has been set -----------------------------------------------------------------------
    // Counts what all pictures show, what those do that have no look of their own, and what those
    // of a light do.
    std::uint64_t sharedRevision = 1, lookRevision = 0, displayRevision = 0;
    std::map<LightId, std::uint64_t> lightRevisions;
    std::uint64_t scenes = 0; // Counts::scenes
    // Grows with everything that the scene of such a frame, or its light, is drawn of.
    [[nodiscard]] std::uint64_t revision(const FrameSettings& frame) const;
    void lightChanged(LightId light) { ++lightRevisions[light]; }

    // --- Frames ----------------------------------------------------------------------------------
    [[nodiscard]] const View& lookOf(const FrameSettings& frame) const {
        return frame.look ? *frame.look : scene.document().view;
    }
    // After shadows.update().
    [[nodiscard]] FrameBlock packFrame(const FrameSettings& frame);
    void useFrame(const FrameBlock& block);
    // How a view of this kind is lit.
    [[nodiscard]] LightingMode lightingFor(const FrameSettings& frame, ViewKind kind) const;
    [[nodiscard]] RelightSettings relightSettings(const FrameSettings& frame, ViewKind kind) const;
    [[nodiscard]] SurfaceSettings surfaceSettings(const FrameSettings& frame,
                                                  const FrameBlock& block, SurfaceOutput output,
                                                  ViewKind kind) const;
    // Settings of `choices`, eight at most; `halfFloats`: the target is of half floats.
    [[nodiscard]] ViewsBlock viewsBlock(const ViewSettings& view,
                                        std::span<const ViewChoice> choices, bool halfFloats) const;

    // The scene with its background into a target of radiance.
    Result<void> drawPicture(const SceneDraw& draw);
    // The numbers of views into a target of floats; `asPicture`: anti-aliased where that is
    // multisampled, radiance laid over what is behind.
    Result<void> drawNumbers(const SceneDraw& draw, const ViewsBlock& settings, bool asPicture);
    // What numbers of a view are shown over.
    Result<ViewRange> rangeFor(const ViewChoice& choice, const gl::Texture& values);
    // Whether the view does not apply to what the frame shows.
    [[nodiscard]] bool isEmpty(const FrameSettings& frame, ViewKind kind) const;

    // While it lives, OpenGL's state is the renderer's: Qt shares the context and leaves its own
    // behind. Afterwards it is what Qt expects, errors included.
    class GlScope {
      public:
        explicit GlScope(const Impl& renderer, unsigned targetFramebuffer = 0);
        ~GlScope();
        GlScope(const GlScope&) = delete;
        GlScope& operator=(const GlScope&) = delete;

      private:
        const Impl& m_renderer;
        unsigned m_targetFramebuffer;
    };

  private:
    [[nodiscard]] DrawList visibleItems(const SceneDraw& draw) const;
    // Clip space of the slice, if that is drawn.
    [[nodiscard]] static std::optional<glm::mat4> sliceClip(const SceneDraw& draw);
};

// Whether what is recorded is radiance with the opacity of its surface, to be laid over what is
// behind; other numbers stand alone.
[[nodiscard]] bool blends(const ViewChoice& choice);

// OpenGL's rows go from bottom to top. RGBA of floats or bytes.
void flipRows(Image& image);

} // namespace patina::render
