#include "render/TermPictures.h"

#include "core/document/Views.h"
#include "core/math/Shading.h"
#include "render/SceneRenderer.h"
#include "render/ViewRenderer.h"

#include <utility>

namespace patina::render {

Result<Image> drawFinePicture(WallRenderer& cells, SceneRenderer& scene, const CellView& cell,
                              const JobContext& job) {
    ViewRenderer picture(scene);
    int frames = 0;
    do {
        if (job.stopping())
            return Error{ErrorKind::Cancelled, "cancelled", {}, {}};
        if (Result<void> drawn = cells.drawFrame(cell, picture, frames > 0); !drawn)
            return drawn.error();
        ++frames;
    } while (!WallRenderer::isFine(cell, picture));
    return picture.readLinear();
}

Result<void> drawTerms(WallRenderer& cells, SceneRenderer& scene, CellView unoccluded,
                       DrawnTerms& terms, const JobContext& job) {
    for (const auto& [kind, picture] : {std::pair{shading::kViewDiffuseIbl, &terms.diffuse},
                                        std::pair{shading::kViewSpecularIbl, &terms.specular},
                                        std::pair{shading::kViewDirect, &terms.direct}}) {
        unoccluded.frame.view.shown = {kind, ViewMode::Raw, {}};
        Result<Image> drawn = drawFinePicture(cells, scene, unoccluded, job);
        if (!drawn)
            return drawn.error();
        *picture = *std::move(drawn);
    }
    return {};
}

} // namespace patina::render
