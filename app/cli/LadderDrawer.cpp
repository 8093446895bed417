#include "app/cli/LadderDrawer.h"

#include "app/cli/LocalShadows.h"
#include "app/cli/PictureSetup.h"
#include "app/cli/SceneSetup.h"
#include "core/mix/LightMix.h"
#include "render/TermPictures.h"
#include "render/ViewRenderer.h"

#include <chrono>
#include <utility>

namespace patina::cli {

RungDrawer::RungDrawer(Session& session, const LadderOptions& options, render::FrameSettings frame)
    : m_session(session)
    , m_options(options)
    , m_frame(std::move(frame)) {}

Result<void> RungDrawer::begin(const Document& document) {
    Result<std::unique_ptr<gl::Context>> context = createContext(m_session, m_frame);
    if (!context)
        return context.error();
    m_context = std::move(*context);
    m_session.beginPhase();
    m_session.job().setActivity("preparing light");
    if (const ImagePtr image = shownEnvironment(document).image;
        image && !environmentParts(document).empty()) {
        Result<EnvironmentTexelsPtr> light = prepareTexels(image, m_session.job());
        if (!light)
            return light.error();
        m_light = *std::move(light);
    }
    Result<std::unique_ptr<render::SceneRenderer>> scene =
        render::SceneRenderer::create(*m_context);
    if (!scene)
        return scene.error();
    m_scene = std::move(*scene);
    m_cells = std::make_unique<render::WallRenderer>(*m_scene);
    return {};
}

Result<render::CellView> RungDrawer::cellOf(Document document) {
    render::CellView cell;
    cell.frame = m_frame;
    cell.light = m_light;
    if (isLitByBake(m_frame.view, document))
        if (Result<void> followed = followBounces(m_session, m_frame.view, document); !followed)
            return followed.error();
    const Result<NearShadowsPtr> shadows = traceLocalShadows(
        m_session, m_options, document, isLitByBake(m_frame.view, document), m_shadows);
    if (!shadows)
        return shadows.error();
    cell.nearShadows = m_shadows = *shadows;
    cell.document = std::move(document);
    return cell;
}

// Twice: what its programs take to be compiled is no part of its time.
Result<DrawnRung> RungDrawer::draw(Document document) {
    const Result<render::CellView> cell = cellOf(std::move(document));
    if (!cell)
        return cell.error();
    DrawnRung rung;
    for (int time = 0; time < 2; ++time) {
        render::ViewRenderer picture(*m_scene);
        const auto start = std::chrono::steady_clock::now();
        int frames = 0;
        do {
            if (m_session.job().stopping())
                return cancelledError();
            if (Result<void> drawn = m_cells->drawFrame(*cell, picture, frames > 0); !drawn)
                return drawn.error();
            ++frames;
        } while (!render::WallRenderer::isFine(*cell, picture));
        rung.picture = picture.readLinear();
        rung.milliseconds =
            std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
                .count() /
            frames;
    }
    return rung;
}

Result<DrawnTerms> RungDrawer::terms(Document document, Image picture) {
    const Result<render::CellView> cell = cellOf(std::move(document));
    if (!cell)
        return cell.error();
    return render::drawTerms(*m_cells, *m_scene, *cell, std::move(picture), m_session.job());
}

} // namespace patina::cli
