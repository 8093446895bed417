// Draws the rungs of `patina ladder`: documents of one scene that differ in their lighting.
#pragma once

#include "app/cli/Session.h"
#include "core/bake/local/NearShadows.h"
#include "core/document/Document.h"
#include "core/trace/blame/Blame.h"
#include "core/trace/error/PictureError.h"
#include "render/RungRenderer.h"
#include "render/SceneRenderer.h"
#include "render/gl/Context.h"
#include "render/view/FrameSettings.h"

#include <memory>
#include <optional>

namespace patina::cli {

struct DrawnRung {
    Image picture; // F32, linear
    double milliseconds = 0.0;
    double solvedSeconds = 0.0; // RungRenderer::Drawn
    PictureError error;
    std::optional<Blame> blame; // of those that are lit by images
};

class RungDrawer {
  public:
    // `options` outlives it.
    RungDrawer(Session& session, const LadderOptions& options, render::FrameSettings frame);

    Result<void> begin(const Document& document);
    Result<DrawnRung> draw(Document document);
    // Of a document that is lit by images; `picture` is what draw() made of it.
    Result<DrawnTerms> terms(Document document, Image picture);

  private:
    // What the viewport computes before it draws the document.
    Result<void> complete(Document& document);

    Session& m_session;
    const LadderOptions& m_options;
    const render::FrameSettings m_frame;
    std::unique_ptr<gl::Context> m_context; // outlives what it holds
    std::unique_ptr<render::SceneRenderer> m_scene;
    std::unique_ptr<render::RungRenderer> m_rungs;
    NearShadowsPtr m_shadows;
};

} // namespace patina::cli
