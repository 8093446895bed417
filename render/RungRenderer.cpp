#include "render/RungRenderer.h"

#include "core/document/ViewChoices.h"
#include "render/SceneRenderer.h"
#include "render/TermPictures.h"
#include "render/ViewRenderer.h"
#include "render/WallRenderer.h"

#include <chrono>
#include <utility>

namespace patina::render {

RungRenderer::RungRenderer(SceneRenderer& scene, FrameSettings frame, EnvironmentTexelsPtr light)
    : m_scene(scene)
    , m_frame(std::move(frame))
    , m_light(std::move(light))
    , m_cells(std::make_unique<WallRenderer>(scene)) {}

RungRenderer::~RungRenderer() = default;

CellView RungRenderer::cellOf(Document document, NearShadowsPtr shadows) const {
    CellView cell;
    cell.frame = m_frame;
    cell.light = m_light;
    cell.nearShadows = std::move(shadows);
    cell.document = std::move(document);
    return cell;
}

Result<DrawnTerms> RungRenderer::terms(Document document, NearShadowsPtr shadows, Image picture,
                                       const JobContext& job) {
    return drawTerms(*m_cells, m_scene, cellOf(std::move(document), std::move(shadows)),
                     std::move(picture), job);
}

Result<RungRenderer::Drawn> RungRenderer::draw(Document document, NearShadowsPtr shadows,
                                               const JobContext& job) {
    const CellView cell = cellOf(std::move(document), std::move(shadows));
    Drawn drawn;
    const auto begin = std::chrono::steady_clock::now();
    const bool solves = isLitBy(LightingMode::Radiosity, cell.document.view.lighting, m_frame.view);
    if (Result<void> solved =
            m_radiosity.update(m_scene, cell.document, m_frame.view, job.part(0.0, 0.0));
        !solved)
        return solved.error();
    if (solves)
        drawn.solvedSeconds =
            std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    for (int time = 0; time < 2; ++time) { // the first compiles its programs
        ViewRenderer picture(m_scene);
        const auto start = std::chrono::steady_clock::now();
        int frames = 0;
        do {
            if (job.stopping())
                return Error{ErrorKind::Cancelled, "cancelled", {}, {}};
            if (Result<void> done = m_cells->drawFrame(cell, picture, frames > 0); !done)
                return done.error();
            ++frames;
        } while (!WallRenderer::isFine(cell, picture));
        drawn.picture = picture.readLinear();
        const std::chrono::duration<double, std::milli> took =
            std::chrono::steady_clock::now() - start;
        drawn.milliseconds = took.count() / frames;
    }
    return drawn;
}

} // namespace patina::render
