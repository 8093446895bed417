// What LightingMode::Radiosity shows of documents that are drawn one after the other, without a
// window: solved before each picture, with what the one before, or a cache, has of it.
#pragma once

#include "core/base/Result.h"
#include "core/job/JobContext.h"
#include "core/radiosity/document/LiveRadiosity.h"
#include "core/radiosity/file/SolutionCache.h"
#include "render/view/ViewSettings.h"

#include <optional>
#include <utility>

namespace patina::render {

class SceneRenderer;

class FollowedRadiosity {
  public:
    // `cache`: where light that was solved before is found, and that of the first document is kept;
    // of those that follow it, which are on the way to others, nothing is. A folder that cannot be
    // written is a line in the log.
    explicit FollowedRadiosity(std::optional<radiosity::SolutionCache> cache = std::nullopt)
        : m_cache(std::move(cache)) {}

    // Nothing where no side of `view` is lit so. `document` is the scene's, or will be. Errors:
    // those of followRadiosity().
    Result<void> update(SceneRenderer& scene, const Document& document, const ViewSettings& view,
                        const JobContext& job);
    [[nodiscard]] const LiveRadiosityPtr& live() const { return m_live; } // null: none was needed

  private:
    std::optional<radiosity::SolutionCache> m_cache;
    LiveRadiosityPtr m_live;
};

// Whether a side of the picture is lit so, of a document that is lit by `ofDocument`.
[[nodiscard]] bool isLitBy(LightingMode lighting, LightingMode ofDocument,
                           const ViewSettings& view);

} // namespace patina::render
