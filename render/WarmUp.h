// Compiling ahead: drivers compile a program when it is first drawn with, for hundreds of
// milliseconds on software OpenGL, and keep the result on disk. A second renderer with a context of
// its own, on a thread of its own, draws every program of a document once and small; the first one
// then finds them there. (Objects cannot be shared instead: llvmpipe compiles per context.)
#pragma once

#include "core/document/Document.h"
#include "core/job/JobContext.h"
#include "render/Renderer.h"
#include "render/pass/SurfaceOutput.h"

#include <cstdint>
#include <map>

namespace patina::render {

// The programs of surface.frag that frames of `document` are drawn with, and for each a mesh
// instance that needs it. A program's name is a hash of what drivers compile it for: its variant
// and the formats of the maps it reads.
[[nodiscard]] std::map<std::uint64_t, Id> surfacePrograms(const Document& document,
                                                          SurfaceOutput output);

// A document that is drawn with the programs of `document` at next to no cost: for each of them a
// square with its material, side by side along x, the maps reduced to 4 × 4 texels.
[[nodiscard]] Document warmUpScene(const Document& document);

class WarmUp {
  public:
    // `context`: current on the calling thread whenever something is called. Errors as
    // Renderer::create().
    static Result<WarmUp> create(gl::Context& context, const Document& document);

    // Draws what frames of this kind need: the picture with its overlays, every view, a sheet, the
    // explanation of a pixel. Cancelled between two frames when the job is.
    Result<void> draw(SurfaceOutput output, const JobContext& job);

  private:
    WarmUp(gl::Context& context, std::unique_ptr<Renderer> renderer, const Document& document);
    Result<void> drawFrame(const ViewSettings& view, const JobContext& job);
    Result<void> drawViews(const JobContext& job);
    Result<void> inspectAll(const JobContext& job);

    gl::Context& m_context;
    std::unique_ptr<Renderer> m_renderer;
    Document m_scene;
    FrameSettings m_frame;
};

} // namespace patina::render
