// What LightingMode::Radiosity shows of documents that are drawn one after the other, without a
// window: solved before each picture, with what the one before has left the same.
#pragma once

#include "core/base/Result.h"
#include "core/job/JobContext.h"
#include "core/radiosity/document/LiveRadiosity.h"
#include "render/view/ViewSettings.h"

namespace patina::render {

class SceneRenderer;

class FollowedRadiosity {
  public:
    // Nothing where no side of `view` is lit so. `document` is the scene's, or will be. Errors:
    // those of followRadiosity().
    Result<void> update(SceneRenderer& scene, const Document& document, const ViewSettings& view,
                        const JobContext& job);
    [[nodiscard]] const LiveRadiosityPtr& live() const { return m_live; } // null: none was needed

  private:
    LiveRadiosityPtr m_live;
};

// Whether a side of the picture is lit so, of a document that is lit by `ofDocument`.
[[nodiscard]] bool isLitBy(LightingMode lighting, LightingMode ofDocument,
                           const ViewSettings& view);

} // namespace patina::render
