// What a frame shows of a scene, and how.
#pragma once

#include "core/document/View.h"
#include "core/image/Image.h"
#include "core/math/Camera.h"
#include "render/scene/LightId.h"
#include "render/scene/MeshGizmo.h"
#include "render/scene/SurfaceLobe.h"
#include "render/view/ViewSettings.h"

#include <limits>
#include <memory>
#include <optional>

namespace patina::render {

struct FrameSettings {
    int width = 0, height = 0; // pixels
    int samples = 4;           // MSAA; 1: none
    // Pixels that the picture is stretched to before the overlays are drawn over it, straight into
    // the target framebuffer; 0: those of the picture.
    int shownWidth = 0, shownHeight = 0;
    // Adds the frame to the ones before of the same scene, each a fraction of a pixel beside the
    // others, ViewRenderer::steadyFrames() at most: anti-aliasing without MSAA, and depth of field
    // where the camera has it. Where there is MSAA and no depth of field, and for views of numbers,
    // without effect. Without it the camera is a pinhole.
    bool accumulate = false;
    Camera camera;
    LightId light = kDocumentLight; // environment that lights the scene and stands behind it
    // Exposure, tone curve and lighting mode in place of the document's; its camera is not used.
    std::optional<View> look;
    bool transparentBackground = false;      // whatever the environment says; its Off does the same
    bool showOverlays = false;               // grid, light gizmos (the editor)
    Id selectedMesh = 0;                     // outlined when showOverlays
    Id selectedLight = 0;                    // shown with its handles when showOverlays
    std::optional<MeshHandles> meshHandles;  // shown when showOverlays; nothing: none
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
    // Without effect when size, samples or what the scene was given have changed since.
    bool reuseScene = false;
    // Shows the last frame's picture again, whatever has been set since, with overlays, exposure
    // and tone curve of the document as it is now: size, camera, light, look and view are that
    // frame's, shownWidth and shownHeight this one's. A split's stays as it was displayed. Without
    // effect before the first frame.
    bool keepPicture = false;

    // Radiance in place of what the scene's picture would be: F32, linear RGBA, premultiplied, row
    // 0 on top, of the frame's size, which has no samples of its own then. For views of other than
    // the picture without effect. There is no depth with it: overlays stay out.
    ImagePtr radiance;

    ViewSettings view; // which terms of the shading equation are shown
};

// Of a framebuffer; from its lower left corner.
struct PixelRectangle {
    int x = 0, y = 0, width = 0, height = 0;
    friend bool operator==(const PixelRectangle&, const PixelRectangle&) = default;
};

// How a picture is shown in a framebuffer, over what is there.
struct Presentation {
    PixelRectangle part;            // which it is stretched to
    std::optional<ViewSplit> split; // shown on its right alone
    float opacity = 1.0f;
};

// The half-plane right of a split's line, in pixels from the bottom left: of
// shaders/include/side.glsl.
[[nodiscard]] glm::vec3 rightSide(const ViewSplit& split, int width, int height);

// Where the camera has depth of field: the mean of frames, without MSAA, that shows it.
[[nodiscard]] FrameSettings withDepthOfField(const FrameSettings& frame);
// Whether frames show the same radiance or numbers of what has been set, from the same camera.
[[nodiscard]] bool showSameScene(const FrameSettings& a, const FrameSettings& b);
// Whether they have the same overlays, over as many pixels.
[[nodiscard]] bool showSameOverlays(const FrameSettings& a, const FrameSettings& b);
[[nodiscard]] FrameSettings withOverlaysOf(const FrameSettings& frame, const FrameSettings& other);
// Whether the picture has fewer pixels than what it is shown on: overlays are drawn over that,
// then.
[[nodiscard]] bool isStretched(const FrameSettings& frame);

} // namespace patina::render
