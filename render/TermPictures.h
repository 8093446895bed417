// The terms of a picture under image-based light as pictures of their own, over no background: what
// blame holds against traced ones.
#pragma once

#include "core/base/Result.h"
#include "core/job/JobContext.h"
#include "core/trace/blame/BlameSteps.h"
#include "render/WallRenderer.h"
#include "render/view/ViewSettings.h"

#include <array>

namespace patina::render {

class SceneRenderer;

// Diffuse and specular image-based light, what occlusion takes of each, direct light, and what is
// seen through the surface.
inline constexpr std::size_t kTermPictures = 6;
[[nodiscard]] const std::array<ViewChoice, kTermPictures>& termPictures();

// `picture` and pictures of those views, all F32 and linear with 4 channels, of the same frame.
[[nodiscard]] DrawnTerms drawnTerms(Image picture, std::array<Image, kTermPictures> terms);

// The same of a cell whose frames accumulate; `picture` is what it shows. The scene's context is
// current. Errors: Internal from the driver, Cancelled.
Result<DrawnTerms> drawTerms(WallRenderer& cells, SceneRenderer& scene, CellView cell,
                             Image picture, const JobContext& job);

// A picture as fine as it gets; linear RGBA. The same errors.
Result<Image> drawFinePicture(WallRenderer& cells, SceneRenderer& scene, const CellView& cell,
                              const JobContext& job);

} // namespace patina::render
