#include "render/TermPictures.h"

#include "core/document/Views.h"
#include "render/SceneRenderer.h"
#include "render/ViewRenderer.h"

#include <utility>

namespace patina::render {
namespace {

// Colours alone: the sum covers what the first does.
void addColors(Image& sum, const Image& more, float times = 1.0f) {
    const auto to = sum.f32();
    const auto from = more.f32();
    for (std::size_t i = 0; i < to.size(); i += 4)
        for (std::size_t c = 0; c < 3; ++c)
            to[i + c] += times * from[i + c];
}

} // namespace

const std::array<ViewChoice, kTermPictures>& termPictures() {
    static constexpr std::array<ViewChoice, kTermPictures> kChoices{
        {{shading::kViewDiffuseIbl, ViewMode::Raw, {}},
         {shading::kViewSpecularIbl, ViewMode::Raw, {}},
         {shading::kViewDiffuseOcclusion, ViewMode::Contribution, {}},
         {shading::kViewSpecularOcclusion, ViewMode::Contribution, {}},
         {shading::kViewDirect, ViewMode::Raw, {}},
         {shading::kViewThrough, ViewMode::Raw, {}}}};
    return kChoices;
}

DrawnTerms drawnTerms(Image picture, std::array<Image, kTermPictures> terms) {
    auto& [diffuse, specular, hiddenDiffuse, hiddenSpecular, direct, through] = terms;
    DrawnTerms drawn;
    drawn.unoccluded = picture;
    drawn.picture = std::move(picture);
    addColors(drawn.unoccluded, hiddenDiffuse);
    addColors(drawn.unoccluded, hiddenSpecular);
    addColors(diffuse, hiddenDiffuse);
    addColors(diffuse, through, -1.0f); // the view shows both as one term
    addColors(specular, hiddenSpecular);
    drawn.diffuse = std::move(diffuse);
    drawn.specular = std::move(specular);
    drawn.direct = std::move(direct);
    drawn.through = std::move(through);
    return drawn;
}

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

Result<DrawnTerms> drawTerms(WallRenderer& cells, SceneRenderer& scene, CellView cell,
                             Image picture, const JobContext& job) {
    std::array<Image, kTermPictures> terms;
    for (std::size_t i = 0; i < kTermPictures; ++i) {
        cell.frame.view.shown = termPictures()[i];
        Result<Image> drawn = drawFinePicture(cells, scene, cell, job);
        if (!drawn)
            return drawn.error();
        terms[i] = *std::move(drawn);
    }
    return drawnTerms(std::move(picture), std::move(terms));
}

} // namespace patina::render
