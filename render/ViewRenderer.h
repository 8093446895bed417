// Draws pictures of a scene: one for each picture that is shown, with its own size, history of
// frames and eye. Several over one SceneRenderer share all that the scene is made of. Qt-free: the
// editor's viewport and the command line both own one. All calls need the scene's context to be
// current, on one thread.
#pragma once

#include "core/base/Result.h"
#include "core/document/ToneResponse.h"
#include "core/image/Image.h"
#include "render/view/FrameSettings.h"
#include "render/view/Inspection.h"

#include <memory>
#include <optional>

namespace patina::render {

class SceneRenderer;

class ViewRenderer {
  public:
    explicit ViewRenderer(SceneRenderer& scene); // which outlives it
    ~ViewRenderer();

    // Renders to the internal HDR target and tone maps into framebuffer `targetFramebuffer`
    // (0: the window's), viewport 0,0 … width,height or shownWidth,shownHeight.
    Result<void> render(const FrameSettings& frame, unsigned targetFramebuffer);

    // render() to kNowhere in two calls, so that the scenes of several pictures are drawn before
    // the first is waited for, which is what making its picture takes on software OpenGL. False:
    // finish() is to follow, which may find the scene set to something else. True: all is done, as
    // it is where the frame shows more than a picture of the scene (a split, numbers, overlays, an
    // eye that adapts).
    Result<bool> begin(const FrameSettings& frame);
    Result<void> finish();

    // Instead of a framebuffer: the picture is only drawn, and present() shows it. Of overlays such
    // a picture has those that are drawn at its own size.
    static constexpr unsigned kNowhere = ~0u;
    // Shows the last picture as it is, whatever has been set since. CHECKs that there was a frame.
    Result<void> present(unsigned targetFramebuffer, const Presentation& how) const;

    // Draws a slice of a frame's scene beside the one that is shown, and waits for it: of about
    // `budgetMs`, by the time that slices before took. True: the frame is complete, and render()
    // shows it as if it had drawn it in one piece. What is set meanwhile, and settings of another
    // scene, begin it anew. `expectedMs`: what the whole may take; below 0: unknown. Errors:
    // Internal from the driver.
    Result<bool> prepare(const FrameSettings& frame, double budgetMs, double expectedMs);
    [[nodiscard]] bool isPrepared(const FrameSettings& frame) const;
    // The scene of it is complete, and its picture under way, in the light that the eye is used to:
    // an eye that adapts now begins that anew.
    [[nodiscard]] bool preparesPicture(const FrameSettings& frame) const;
    // Whether the last frame shows the scene as these settings want it, as fine as they do.
    [[nodiscard]] bool isCurrent(const FrameSettings& frame) const;

    // The scene shows again what the last frame was drawn of, after something else: the next frame
    // goes on from there.
    void resume();
    // Frames that the last one is the mean of; steadyFrames(): more will not change it.
    [[nodiscard]] int accumulatedFrames() const;
    static constexpr int kSteadyFrames = 8;
    // Through a lens each frame sees the scene from another point of it. A pinhole's frames are
    // kSteadyFrames.
    static constexpr int kLensFrames = 64;
    [[nodiscard]] static int steadyFrames(const Camera& camera);
    // Another frame will not change the last one's picture.
    [[nodiscard]] bool isSteady() const;

    // The newest luminance known of a frame that measured it (automatic exposure, the photographic
    // operator, FrameSettings::measureLuminance); nothing before the first. luminance() is usually
    // that of the last frame but one and never waits; readLuminance() waits for the last one.
    [[nodiscard]] std::optional<Luminance> luminance();
    [[nodiscard]] std::optional<Luminance> readLuminance();
    [[nodiscard]] bool luminancePending() const; // luminance() will have a newer one

    // Has the driver compile what lights near by need under transfer in such light; shows nothing.
    // CHECKs that there was a frame.
    Result<void> prepareNearLights(LightingMode lighting);

    // --- Looking at the last frame: changes nothing ----------------------------------------------
    // The last frame before tone mapping: linear RGBA floats, top row first, colour premultiplied
    // by alpha (as OpenEXR wants it).
    [[nodiscard]] Image readLinear() const;
    // The last frame as displayed: 8-bit RGBA sRGB, top row first, straight alpha (as PNG wants
    // it).
    [[nodiscard]] Image readDisplayed() const;

    // The numbers of a view for the camera and size of the last frame: linear RGBA floats, top row
    // first; alpha 1 where a surface is. Radiance is premultiplied by its opacity and sampled like
    // the picture, other numbers are of one sample per pixel. CHECKs that there was a frame.
    // Errors: Internal from the driver.
    [[nodiscard]] Result<Image> readView(ViewKind kind, ViewMode mode = ViewMode::Raw) const;
    // What the background adds to the last frame's picture beside and behind its surfaces, the same
    // way: with the terms (kTermViews) it adds up to readLinear().
    [[nodiscard]] Result<Image> readBackground() const;
    // Everything the shader computes at a pixel of the last frame (top-left origin), with all of
    // its triangles if that frame was coarse: one pass over one pixel. CHECKs that the pixel lies
    // inside the frame.
    [[nodiscard]] Result<Inspection> inspect(int x, int y) const;
    // The range that the last frame's view was shown over: the locked one, the table's, or the
    // picture's own; nothing for views without one. The other: that right of the split.
    [[nodiscard]] std::optional<ViewRange> shownRange() const;
    [[nodiscard]] std::optional<ViewRange> otherRange() const;

    // The mesh instance under a pixel of the last frame (top-left origin), 0 when there is none.
    [[nodiscard]] Id pick(int x, int y) const;

  private:
    Result<void> render(const FrameSettings& frame, unsigned targetFramebuffer, bool begins);

    friend class SheetRenderer;
    struct Impl;
    std::unique_ptr<Impl> m_impl;
};

} // namespace patina::render
