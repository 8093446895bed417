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
#include "render/scene/BandSlicer.h"
#include "render/scene/DrawList.h"
#include "render/scene/FrameSlicer.h"
#include "render/scene/GpuScene.h"

namespace patina::render {

// Whether frames show the same radiance or numbers of what has been set, from the same camera.
[[nodiscard]] bool showSameScene(const FrameSettings& a, const FrameSettings& b);
// Whether they have the same overlays, over as many pixels.
[[nodiscard]] bool showSameOverlays(const FrameSettings& a, const FrameSettings& b);
[[nodiscard]] FrameSettings withOverlaysOf(const FrameSettings& frame, const FrameSettings& other);
// Whether the picture has fewer pixels than what it is shown on: overlays are drawn over that,
// then.
[[nodiscard]] bool isStretched(const FrameSettings& frame);

// OpenGL's rows go from bottom to top. RGBA of floats or bytes.
void flipRows(Image& image);

// What is left of a frame that is drawn in slices, in this order; up to the wires for each side of
// a split.
enum class FrameStage { Scene, Measure, Picture, Wires, Mask, Overlays, Done };

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
    // What the sides' numbers are shown over; ViewRange of the side that was measured last.
    struct Ranges {
        std::optional<ViewRange> shown, other;
        ViewRange side;
    };
    Ranges ranges;

    // Either side of a split, or the whole picture.
    struct Side {
        ViewChoice choice;
        glm::vec3 plane{0.0f}; // shaders/include/side.glsl
        std::size_t index = 0; // of Targets::mean()
        bool isOther = false;  // right of the split
    };

    // A frame that is drawn in slices beside the one that is shown, up to the finished picture.
    struct Preparation {
        bool begun = false;
        std::uint64_t revision = 0; // of what it is drawn of
        std::uint64_t eye = 0;      // AdaptationPass::revision() of the picture
        FrameSettings frame;
        FrameBlock block;
        Targets targets;
        int accumulated = 0;
        bool hasMeans = false; // of the targets that are shown, which it changes
        Ranges ranges;
        std::vector<Side> sides;
        std::size_t side = 0;
        FrameStage stage = FrameStage::Scene;
        double budgetMs = 0.0, expectedMs = -1.0; // of a slice; of the scene of a side
        bool luminanceIsNew = false;              // of what has been drawn of it
        bool hasMask = false;                     // the overlays' mask is its own
        FrameSlicer slicer;
        std::array<BandSlicer, static_cast<std::size_t>(FrameStage::Done)> bands;

        BandSlicer& band() { return bands[static_cast<std::size_t>(stage)]; }
    };
    Preparation next;
    std::uint64_t revision = 0;      // of everything that was set
    std::uint64_t shownRevision = 0; // that the last frame was tone mapped with
    SceneSlice* slice = nullptr;     // what is drawn of the scene; null: all of it
    // What the tiles of a frame cost, by what the last frame shows there.
    std::vector<float> tileCosts;
    Camera tileCamera; // of the frame that they were found for

    void setChanged() {
        sceneIsNew = true;
        ++revision;
    }

    // --- RendererSlices.cpp
    [[nodiscard]] bool isBegun(const FrameSettings& frame) const;
    Result<void> beginPreparing(const FrameSettings& frame, double budgetMs, double expectedMs);
    // A slice of the stage it has come to, and on to the stage after where that was the last.
    Result<void> prepareSlice();
    Result<void> drawStage(SceneSlice& drawn);
    void beginStage(FrameStage stage);
    [[nodiscard]] bool needsStage() const;
    [[nodiscard]] bool hasBands() const; // the stage is drawn band by band
    void advanceStage();
    // The eye has changed since, or the selection, or what else is drawn over the picture.
    [[nodiscard]] bool displaysAnew(const FrameSettings& frame) const;
    void followDisplay(const FrameSettings& frame);
    void swapWithNext();
    void takePrepared(); // what is shown from now on
    [[nodiscard]] std::vector<float> costsOfTiles(const FrameSettings& frame);
    // What lies in the slice, or in the whole picture; clip space of the slice, if that is drawn.
    [[nodiscard]] DrawList visibleItems(const FrameBlock& block, const glm::vec3& eye) const;
    [[nodiscard]] std::optional<glm::mat4> sliceClip(const FrameBlock& block) const;

    // --- Renderer.cpp
    [[nodiscard]] FrameBlock packFrame(const FrameSettings& frame);
    void useFrame(const FrameBlock& block);
    // How a view of this kind is lit.
    [[nodiscard]] LightingMode lightingFor(const ViewSettings& view, ViewKind kind) const;
    [[nodiscard]] SurfaceSettings surfaceSettings(const FrameBlock& block, SurfaceOutput output,
                                                  LightingMode lighting) const;
    // The scene with its background into a target of radiance.
    Result<void> drawPicture(const FrameSettings& frame, const FrameBlock& block,
                             const gl::Framebuffer& target, SurfaceOutput output,
                             bool withBackground, ViewKind kind = shading::kViewFinal);
    // targets.displayed(), with overlays unless they have been drawn.
    Result<void> show(const FrameSettings& frame, bool overlaysDrawn, unsigned targetFramebuffer);
    Result<void> adapt(const FrameSettings& frame);
    Result<void> adaptToMeasured(const FrameSettings& frame);
    // What the last frame showed, with the overlays wanted now.
    [[nodiscard]] FrameSettings kept(const FrameSettings& wanted) const;
    [[nodiscard]] bool isDisplayed(const FrameSettings& frame) const; // a kept one: as it would be
    [[nodiscard]] bool wantsLuminance(const FrameSettings& frame) const;
    [[nodiscard]] static OverlaySettings overlaySettings(const FrameSettings& frame) {
        return {frame.selectedMesh, frame.selectedLight, frame.lobe.get(), frame.overlayScale};
    }
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

    // --- RendererViews.cpp
    // What the frame shows, both sides of its limit, into targets.display(). `drawsScene`: else the
    // last frame's radiance or numbers are shown anew.
    Result<void> drawViews(const FrameSettings& frame, bool drawsScene);
    [[nodiscard]] static std::vector<Side> sidesOf(const FrameSettings& frame);
    [[nodiscard]] bool hasRadiance(const FrameSettings& frame, const ViewChoice& choice) const;
    // What the eye is used to, or the range of the numbers that have been drawn.
    Result<void> measureSide(const FrameSettings& frame, const Side& side);
    // What exposure needs to know before the first picture that does not show it.
    Result<void> meetLuminance(const FrameSettings& frame);
    // Radiance or numbers as colours into targets.display().
    Result<void> displaySide(const FrameSettings& frame, const Side& side);
    Result<void> drawWires(const FrameSettings& frame, const Side& side);
    // What a side shows of the scene: radiance or numbers.
    Result<void> drawScene(const FrameSettings& frame, const ViewChoice& choice,
                           std::size_t sideIndex);
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
