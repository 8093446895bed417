// The inside of ViewRenderer: ViewRenderer.cpp draws a frame, ViewRendererSides.cpp what its sides
// show, ViewRendererSlices.cpp the same in slices, ViewRendererRead.cpp looks at it.
#pragma once

#include "render/SceneRendererImpl.h"
#include "render/ViewRenderer.h"
#include "render/pass/AdaptationPass.h"
#include "render/pass/OverlayPass.h"
#include "render/pass/Targets.h"
#include "render/pass/WirePass.h"
#include "render/scene/BandSlicer.h"
#include "render/scene/FrameSlicer.h"

namespace patina::render {

// What is left of a frame that is drawn in slices, in this order; up to the wires for each side of
// a split.
enum class FrameStage { Scene, Measure, Picture, Wires, Mask, Overlays, Done };

struct ViewRenderer::Impl {
    using GlScope = SceneRenderer::Impl::GlScope;

    explicit Impl(SceneRenderer::Impl& s)
        : shared(s)
        , adaptation(s.context, s.shaders)
        , wires(s.context, s.shaders, s.screen)
        , overlay(s.context, s.shaders, s.screen) {}

    SceneRenderer::Impl& shared;
    AdaptationPass adaptation;
    WirePass wires;
    OverlayPass overlay;
    Targets targets;
    FrameBlock lastBlock; // of the last frame
    FrameSettings lastFrame;
    // Of the last frame, whose scene is drawn and whose picture finish() makes; nothing: it is
    // made.
    std::optional<View> unfinished;
    int accumulated = 0;             // frames that the last one is the mean of
    std::uint64_t drawnRevision = 0; // of the scene that the last frame shows; 0: it shows none
    bool luminanceIsNew = true;      // the last frame's scene has not been measured
    bool luminanceKnown = false;     // some frame has been measured
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
    std::uint64_t shownRevision = 0; // that the last frame was tone mapped with
    SceneSlice* slice = nullptr;     // what is drawn of the scene; null: all of it
    // What the tiles of a frame cost, by what the last frame shows there.
    std::vector<float> tileCosts;
    Camera tileCamera; // of the frame that they were found for

    // Something was set since the last frame that such a frame shows.
    [[nodiscard]] bool sceneIsNew(const FrameSettings& frame) const {
        return drawnRevision != shared.revision(frame);
    }
    // Of everything that such a frame shows, its display included.
    [[nodiscard]] std::uint64_t revision(const FrameSettings& frame) const {
        return shared.revision(frame) + shared.displayRevision;
    }

    // --- ViewRendererSlices.cpp
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

    // --- ViewRenderer.cpp
    // That the mean with such a frame is of, after so many; 0: it is no mean.
    [[nodiscard]] static int framesWith(const FrameSettings& frame, const Targets& into,
                                        int before);
    // Whether all of a frame but its scene can be drawn whatever the scene has become.
    [[nodiscard]] bool isPlain(const FrameSettings& frame) const;
    // targets.displayed(), with overlays unless they have been drawn.
    Result<void> show(const FrameSettings& frame, bool overlaysDrawn, unsigned targetFramebuffer);
    Result<void> adapt(const FrameSettings& frame);
    Result<void> adaptToMeasured(const FrameSettings& frame);
    // What the last frame showed, with the overlays wanted now.
    [[nodiscard]] FrameSettings kept(const FrameSettings& wanted) const;
    [[nodiscard]] bool isDisplayed(const FrameSettings& frame) const; // a kept one: as it would be
    [[nodiscard]] bool wantsLuminance(const FrameSettings& frame) const;
    [[nodiscard]] OverlaySettings overlaySettings(const FrameSettings& frame) const {
        return {frame.selectedMesh,
                frame.selectedLight,
                frame.meshHandles ? &*frame.meshHandles : nullptr,
                frame.lobe.get(),
                frame.overlayScale,
                shared.lookOf(frame)};
    }

    // --- ViewRendererSides.cpp
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
    // A drawing of the last frame's scene; of the slice where one is drawn.
    [[nodiscard]] SceneDraw drawingOf(const FrameSettings& frame, const FrameBlock& block,
                                      const gl::Framebuffer& target, SurfaceOutput output,
                                      ViewKind kind = shading::kViewFinal) const {
        return {frame, block, target, output, kind, false, true, slice};
    }

    // --- ViewRendererRead.cpp
    // The numbers of one view of the last frame, looked at in another way.
    Result<Image> readNumbers(const ViewSettings& view, const ViewChoice& choice) const;
    Result<void> inspectSurface(Inspection& result) const;
    Result<void> inspectPicture(Inspection& result) const;
};

} // namespace patina::render
