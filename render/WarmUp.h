// Compiling ahead: drivers compile a program when it is first drawn with, for hundreds of
// milliseconds on software OpenGL, and keep the result on disk. A second renderer with a context of
// its own, on a thread of its own, draws every program of a document once and small; the first one
// then finds them there. (Objects cannot be shared instead: llvmpipe compiles per context.)
#pragma once

#include "core/document/Document.h"
#include "core/job/JobContext.h"
#include "render/SceneRenderer.h"
#include "render/SheetRenderer.h"
#include "render/ViewRenderer.h"
#include "render/pass/SurfaceOutput.h"

#include <compare>
#include <cstdint>
#include <map>
#include <vector>

namespace patina::render {

// Frames of a document that are drawn with the same programs: what surfaces write, and how they are
// lit.
struct FrameKind {
    SurfaceOutput output = SurfaceOutput::Picture;
    LightingMode lighting{};
    friend auto operator<=>(const FrameKind&, const FrameKind&) = default;
};

// What a frame with this view is drawn as: one kind, or one for each side.
[[nodiscard]] std::vector<FrameKind> frameKinds(const ViewSettings& view, const Document& document);
// What a thumbnail of a view is drawn as.
[[nodiscard]] FrameKind sheetKind(ViewKind kind, const Document& document);
// Everything that may be looked at: first in the document's light, then in the others that have
// views in this document.
[[nodiscard]] std::vector<FrameKind> allFrameKinds(const Document& document);

// The programs of surface.frag that frames of `document` are drawn with, and for each a mesh
// instance that needs it. A program's name is a hash of what drivers compile it for: its variant
// and the formats of the maps it reads; light under transfer comes with it.
[[nodiscard]] std::map<std::uint64_t, Id> surfacePrograms(const Document& document,
                                                          const FrameKind& frame);

// A document that is drawn with the programs of `document` at next to no cost: for each of them a
// square with its material, side by side along x, the maps reduced to few texels.
[[nodiscard]] Document warmUpScene(const Document& document);

class WarmUp {
  public:
    // `context`: current on the calling thread whenever something is called. Errors as
    // SceneRenderer::create().
    static Result<WarmUp> create(gl::Context& context, const Document& document);

    // Draws what frames of this kind need: the picture with its overlays, every view, a sheet, the
    // explanation of a pixel. Cancelled between two frames when the job is.
    Result<void> draw(const FrameKind& frame, const JobContext& job);

    [[nodiscard]] const SceneRenderer& renderer() const { return *m_renderer; }

  private:
    WarmUp(gl::Context& context, std::unique_ptr<SceneRenderer> renderer, const Document& document);
    Result<void> prepareRadiosity(LightingMode lighting, const JobContext& job);
    Result<void> drawFrame(const ViewSettings& view, const JobContext& job);
    Result<void> drawViews(LightingMode lighting, const JobContext& job);
    Result<void> drawSheet(LightingMode lighting, const JobContext& job);
    Result<void> inspectAll(LightingMode lighting, const JobContext& job);

    gl::Context& m_context;
    std::unique_ptr<SceneRenderer> m_renderer;
    std::unique_ptr<ViewRenderer> m_picture;
    std::unique_ptr<SheetRenderer> m_thumbnails;
    Document m_scene;
    FrameSettings m_frame;
    bool m_hasRadiosity = false;
};

} // namespace patina::render
