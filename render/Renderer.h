// Draws a document with OpenGL 4.5. Qt-free: the editor's viewport and the command line both own
// one. All calls need the context it was created with to be current, on one thread.
#pragma once

#include "core/bake/local/NearShadows.h"
#include "core/base/Result.h"
#include "core/document/Document.h"
#include "core/document/ToneResponse.h"
#include "core/io/DisplayTransform.h"
#include "core/light/EnvironmentTexels.h"
#include "render/gl/Context.h"
#include "render/scene/SurfaceLobe.h"
#include "render/shader/ShaderLibrary.h"
#include "render/view/Inspection.h"
#include "render/view/ViewSettings.h"

#include <array>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace patina::render {

struct FrameSettings {
    int width = 0, height = 0; // pixels
    int samples = 4;           // MSAA; 1: none
    // Pixels that the picture is stretched to before the overlays are drawn over it, straight into
    // the target framebuffer; 0: those of the picture.
    int shownWidth = 0, shownHeight = 0;
    // Adds the frame to the ones before of the same scene, each a fraction of a pixel beside the
    // others, kSteadyFrames at most: anti-aliasing without MSAA. Where there is MSAA, and for views
    // of numbers, without effect.
    bool accumulate = false;
    Camera camera;
    bool transparentBackground = false;      // whatever the document says; its Off does the same
    bool showOverlays = false;               // grid, light gizmos (the editor)
    Id selectedMesh = 0;                     // outlined when showOverlays
    Id selectedLight = 0;                    // shown with its handles when showOverlays
    std::shared_ptr<const SurfaceLobe> lobe; // drawn when showOverlays; null: none
    float overlayScale = 1.0f; // pixels per pixel that marks are sized in (the editor: a widget's)
    bool coarse = false;       // fewer triangles, where a reduced frame hides it (the editor)
    bool dither = false;       // hides the bands of 8-bit values (the editor)
    bool floats = false;       // 32-bit floats instead of half floats: pictures for linear files

    // Seconds since the last frame, for automatic exposure; infinite: the eye is used to the
    // picture already.
    float adaptSeconds = std::numeric_limits<float>::infinity();
    // Measures the luminance even when the picture does not depend on it.
    bool measureLuminance = false;
    // The scene looks as in the last frame: only exposure, tone curve and overlays are done anew.
    // Without effect when size, samples or what the renderer was given have changed since.
    bool reuseScene = false;
    // Shows the last frame's picture again, whatever has been set since, with overlays, exposure
    // and tone curve of now: size, camera and view are that frame's, shownWidth and shownHeight
    // this one's. A split's stays as it was displayed. Without effect before the first frame.
    bool keepPicture = false;

    ViewSettings view; // which terms of the shading equation are shown
};

// Several views drawn small, side by side in one picture.
struct ViewSheet {
    std::vector<ViewKind> kinds;
    ViewMode mode = ViewMode::Raw;
    int width = 0, height = 0; // pixels of each
};

class Renderer {
  public:
    // Compiles the programs. `shaderFolder`: read shaders from there and watch them (hot reload);
    // empty: the ones built in. Errors: NoOpenGl, Internal with the compiler's log.
    static Result<std::unique_ptr<Renderer>> create(gl::Context& context,
                                                    const std::filesystem::path& shaderFolder = {});
    ~Renderer();

    // Takes over what differs from the document before, and keeps the snapshot. The camera travels
    // with each frame instead.
    void setDocument(const Document& document);

    // Light and background of document.environment.image; prepared elsewhere (a job in the editor,
    // directly in the command line). Until set, a grey sky lights the scene.
    void setEnvironment(const EnvironmentTexels& texels);
    void setIbl(const IblMaps& maps); // light alone
    // setEnvironment() in pieces between frames: the old environment is shown until the new one is
    // complete. proceedEnvironment() uploads about so many bytes more; true when nothing is left.
    void beginEnvironment(EnvironmentTexelsPtr texels);
    bool proceedEnvironment(std::size_t bytes);

    // Coefficients (8 bands) of a picture that takes part in a cross-fade. With both known,
    // transfer is lit by exactly their mix while the picture of both is still on its way; those of
    // a picture that was set come with it.
    using ProjectionSh = std::array<glm::vec3, 64>;
    void setProjection(const ImagePtr& image, const ProjectionSh& coefficients);
    [[nodiscard]] bool knowsProjection(const ImagePtr& image) const;
    // Radiance coefficients, order² of them, of the light from far away that transfer is lit by
    // now: the environments of the mix and the directional lights as discs.
    [[nodiscard]] std::vector<glm::vec3> transferLight(int order) const;

    // What ToneMap::OpenColorIo shows; null: nothing yet, the default curve stands in for it. Error
    // Internal when the driver refuses its shader; the stand-in is used then, too.
    Result<void> setDisplay(const DisplayTransformPtr& display);

    // Live bake preview: values of a running bake, drawn instead of an attached artifact's. `kind`
    // is AoVertex or PrtVertex; `values`: all vertices of the mesh, `stride` numbers each.
    void previewVertices(BakeKind kind, Id mesh, int stride, std::span<const float> values);
    void previewTexels(Id material, int size, std::span<const float> values); // whole texture
    void clearPreview();
    // Radiance per vertex that a surface of albedo 1 sends out by way of other surfaces in
    // transferLight(): replaces what the attached bake holds of it (LightingMode::Prt) until it is
    // cleared or another bake is attached. Lights near by are added to it, through the bake.
    void setBouncedLight(Id mesh, std::span<const glm::vec3> radiance);
    void clearBouncedLight();
    // Shadows of the document's local lights under transfer (core/bake/local/NearShadows.h), sharp
    // and complete, instead of what the bake's bands know of them; null: none. They hold until they
    // are set again: those of a light that has moved, or of other geometry, are still shown. What
    // has none (another bake, a light that was added) shows what the bands know.
    void setNearShadows(const NearShadowsPtr& shadows);
    // Whether a picture or view showed local lights by way of a bake since the last call.
    [[nodiscard]] bool takeNearShadowUse();

    // Renders to the internal HDR target and tone maps into framebuffer `targetFramebuffer`
    // (0: the window's), viewport 0,0 … width,height or shownWidth,shownHeight.
    Result<void> render(const FrameSettings& frame, unsigned targetFramebuffer);

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

    // Frames that the last one is the mean of; kSteadyFrames: more will not change it.
    [[nodiscard]] int accumulatedFrames() const;
    static constexpr int kSteadyFrames = 8;

    // The newest luminance known of a frame that measured it (automatic exposure, the photographic
    // operator, FrameSettings::measureLuminance); nothing before the first. luminance() is usually
    // that of the last frame but one and never waits; readLuminance() waits for the last one.
    [[nodiscard]] std::optional<Luminance> luminance();
    [[nodiscard]] std::optional<Luminance> readLuminance();
    [[nodiscard]] bool luminancePending() const; // luminance() will have a newer one

    // The last frame before tone mapping: linear RGBA floats, top row first, colour premultiplied
    // by alpha (as OpenEXR wants it).
    [[nodiscard]] Image readLinear();
    // The last frame as displayed: 8-bit RGBA sRGB, top row first, straight alpha (as PNG wants
    // it).
    [[nodiscard]] Image readDisplayed();

    // The numbers of a view for the camera and size of the last frame: linear RGBA floats, top row
    // first; alpha 1 where a surface is. Radiance is premultiplied by its opacity and sampled like
    // the picture, other numbers are of one sample per pixel. CHECKs that there was a frame.
    // Errors: Internal from the driver.
    [[nodiscard]] Result<Image> readView(ViewKind kind, ViewMode mode = ViewMode::Raw);
    // What the background adds to the last frame's picture beside and behind its surfaces, the same
    // way: with the terms (kTermViews) it adds up to readLinear().
    [[nodiscard]] Result<Image> readBackground();
    // The views of `sheet` as displayed, each 8-bit RGBA, top row first, for the camera of the last
    // frame; up to eight are drawn in one pass.
    [[nodiscard]] Result<std::vector<Image>> drawSheet(const FrameSettings& frame,
                                                       const ViewSheet& sheet);
    // Everything the shader computes at a pixel of the last frame (top-left origin), with all of
    // its triangles if that frame was coarse: one pass over one pixel. CHECKs that the pixel lies
    // inside the frame.
    [[nodiscard]] Result<Inspection> inspect(int x, int y);
    // The range that the last frame's view was shown over: the locked one, the table's, or the
    // picture's own; nothing for views without one. The other: that right of the split.
    [[nodiscard]] std::optional<ViewRange> shownRange() const;
    [[nodiscard]] std::optional<ViewRange> otherRange() const;

    // Has the driver compile what lights near by need under transfer in such light; shows nothing.
    // CHECKs that there was a frame.
    Result<void> prepareNearLights(LightingMode lighting);
    // What it has compiled so far: files and #defines of each program.
    [[nodiscard]] std::vector<ProgramKey> programs() const;

    // Recompiles shaders that changed on disk; a shader that does not compile keeps the last good
    // program. Returns the messages (file, line) of what failed.
    std::vector<std::string> reloadShaders();

    // The mesh instance under a pixel of the last frame (top-left origin), 0 when there is none.
    [[nodiscard]] Id pick(int x, int y);

  private:
    struct Impl;
    explicit Renderer(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> m_impl;
};

} // namespace patina::render
