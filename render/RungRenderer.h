// Draws a scene lit by one method after the other, each as it looks at rest, and measures what a
// frame takes. All calls need the scene's context to be current, on one thread.
#pragma once

#include "core/bake/local/NearShadows.h"
#include "core/base/Result.h"
#include "core/document/Document.h"
#include "core/image/Image.h"
#include "core/job/JobContext.h"
#include "core/light/EnvironmentTexels.h"
#include "core/trace/blame/Blame.h"
#include "render/FollowedRadiosity.h"
#include "render/WallRenderer.h"
#include "render/view/FrameSettings.h"

#include <memory>

namespace patina::render {

class SceneRenderer;

class RungRenderer {
  public:
    // `frame`: how all are looked at, floats and accumulate set. `light`: of the documents'
    // shownEnvironment(); null: none lights them. The scene outlives it.
    RungRenderer(SceneRenderer& scene, FrameSettings frame, EnvironmentTexelsPtr light);
    ~RungRenderer();

    struct Drawn {
        Image picture;              // F32, linear, 4 channels, premultiplied
        double milliseconds = 0.0;  // of one frame, its programs compiled
        double solvedSeconds = 0.0; // before it: of radiosity
    };
    // `shadows`: of its local lights where a transfer lights it. Errors: Internal from the driver;
    // Cancelled, which is asked for between frames; where radiosity lights it, those of
    // followRadiosity().
    Result<Drawn> draw(Document document, NearShadowsPtr shadows, const JobContext& job);

    // Of a document that is lit by images; `picture` is what draw() made of it. Errors as draw()'s.
    Result<DrawnTerms> terms(Document document, NearShadowsPtr shadows, Image picture,
                             const JobContext& job);

  private:
    [[nodiscard]] CellView cellOf(Document document, NearShadowsPtr shadows) const;

    SceneRenderer& m_scene;
    FrameSettings m_frame;
    EnvironmentTexelsPtr m_light;
    std::unique_ptr<WallRenderer> m_cells;
    FollowedRadiosity m_radiosity;
};

} // namespace patina::render
