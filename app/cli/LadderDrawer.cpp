#include "app/cli/LadderDrawer.h"

#include "app/cli/LocalShadows.h"
#include "app/cli/PictureSetup.h"
#include "app/cli/SceneSetup.h"
#include "core/mix/LightMix.h"

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
    EnvironmentTexelsPtr light;
    if (const ImagePtr image = shownEnvironment(document).image;
        image && !environmentParts(document).empty()) {
        Result<EnvironmentTexelsPtr> texels = prepareTexels(image, m_session.job());
        if (!texels)
            return texels.error();
        light = *std::move(texels);
    }
    Result<std::unique_ptr<render::SceneRenderer>> scene =
        render::SceneRenderer::create(*m_context);
    if (!scene)
        return scene.error();
    m_scene = std::move(*scene);
    m_rungs = std::make_unique<render::RungRenderer>(*m_scene, m_frame, std::move(light));
    return {};
}

Result<void> RungDrawer::complete(Document& document) {
    const bool baked = isLitByBake(m_frame.view, document);
    if (baked)
        if (Result<void> followed = followBounces(m_session, m_frame.view, document); !followed)
            return followed;
    const Result<NearShadowsPtr> shadows =
        traceLocalShadows(m_session, m_options, document, baked, m_shadows);
    if (!shadows)
        return shadows.error();
    m_shadows = *shadows;
    return {};
}

Result<DrawnRung> RungDrawer::draw(Document document) {
    if (Result<void> completed = complete(document); !completed)
        return completed.error();
    Result<render::RungRenderer::Drawn> drawn =
        m_rungs->draw(std::move(document), m_shadows, m_session.job());
    if (!drawn)
        return drawn.error();
    DrawnRung rung;
    rung.picture = std::move(drawn->picture);
    rung.milliseconds = drawn->milliseconds;
    rung.solvedSeconds = drawn->solvedSeconds;
    return rung;
}

Result<DrawnTerms> RungDrawer::terms(Document document, Image picture) {
    if (Result<void> completed = complete(document); !completed)
        return completed.error();
    return m_rungs->terms(std::move(document), m_shadows, std::move(picture), m_session.job());
}

} // namespace patina::cli
