// Cells of a sheet as the viewport draws them.
#include "app/cli/LocalShadows.h"
#include "app/cli/PictureSetup.h"
#include "app/cli/Report.h"
#include "app/cli/SheetCells.h"
#include "core/document/ViewChoices.h"
#include "core/image/Channels.h"
#include "core/light/Light.h"
#include "core/material/Material.h"
#include "core/mix/LightMix.h"
#include "render/FollowedRadiosity.h"
#include "render/SceneRenderer.h"
#include "render/ViewRenderer.h"
#include "render/WallRenderer.h"

#include <algorithm>
#include <tuple>
#include <utility>
#include <vector>

namespace patina::cli {

namespace {

class SheetDrawn : public SheetCells {
  public:
    explicit SheetDrawn(SheetSource source)
        : SheetCells(std::move(source))
        , m_session(m_source.session)
        , m_frame(m_source.frame) {}

    Result<void> begin() override {
        // Linear pictures need no display.
        const View& view = m_source.document.view;
        const Result<DisplayTransformPtr> display =
            m_frame.floats ? DisplayTransformPtr() : openDisplay(m_session, view);
        if (!display)
            return display.error();
        m_displayOf = view;
        Result<std::unique_ptr<gl::Context>> context = createContext(m_session, m_frame);
        if (!context)
            return context.error();
        m_context = std::move(*context);
        Result<std::unique_ptr<render::SceneRenderer>> scene =
            render::SceneRenderer::create(*m_context);
        if (!scene)
            return scene.error();
        m_scene = std::move(*scene);
        m_cells = std::make_unique<render::WallRenderer>(*m_scene);
        return m_scene->setDisplay(*display);
    }

    Result<sheet::DrawnCell> draw(const Cell& cell, const std::string& of, double,
                                  double to) override {
        Result<Document> shown = shownBy(cell);
        if (!shown)
            return shown.error();
        if (Result<void> followed = follow(*shown); !followed)
            return followed.error();
        if (Result<void> solved =
                m_radiosity.update(*m_scene, *shown, m_frame.view, m_session.job().part(0.0, 0.0));
            !solved)
            return solved.error();
        if (Result<void> fits = fitDisplay(shown->view); !fits)
            return fits.error();
        render::CellView view;
        view.frame = m_frame;
        view.frame.camera = shown->view.camera;
        view.frame = render::withDepthOfField(view.frame);
        if (!environmentParts(*shown).empty()) {
            const Result<EnvironmentTexelsPtr> light = lightOf(shownEnvironment(*shown).image);
            if (!light)
                return light.error();
            view.light = *light;
        }
        const Result<NearShadowsPtr> shadows = traceLocalShadows(
            m_session, m_source.options, *shown, isLitByBake(m_frame.view, *shown), m_shadows);
        if (!shadows)
            return shadows.error();
        view.nearShadows = m_shadows = *shadows;
        view.document = std::move(*shown);
        if (Result<void> drawn = m_cells->draw({&view, 1}); !drawn)
            return drawn.error();
        const render::ViewRenderer& picture = m_cells->picture(0);
        Image image = m_frame.floats ? picture.readLinear() : picture.readDisplayed();
        sheet::DrawnCell drawn;
        drawn.picture = m_frame.transparentBackground ? std::move(image) : withoutAlpha(image);
        m_session.job().setActivity(of + "drawing");
        m_session.job().setProgress(to);
        return drawn;
    }

  private:
    void letGoOfLight() override {
        m_lightImage = nullptr;
        m_light = nullptr;
    }

    // A snapshot may be shown through another display of OpenColorIO.
    Result<void> fitDisplay(const View& view) {
        const auto display = [](const View& of) {
            return std::tie(of.toneMap, of.ocioConfig, of.ocioDisplay, of.ocioView);
        };
        if (m_frame.floats || view.toneMap != ToneMap::OpenColorIo ||
            display(view) == display(m_displayOf))
            return {};
        const Result<DisplayTransformPtr> other = openDisplay(m_session, view);
        if (!other)
            return other.error();
        m_displayOf = view;
        return m_scene->setDisplay(*other);
    }

    // Of the last picture, which most often is the next one's, too.
    Result<EnvironmentTexelsPtr> lightOf(const ImagePtr& image) {
        if (!image || image == m_lightImage)
            return m_light;
        Result<EnvironmentTexelsPtr> light = prepareTexels(image, m_session.job());
        if (!light)
            return light;
        m_session.beginPhase(); // the light's progress is over
        m_lightImage = image;
        m_light = *light;
        return m_light;
    }

    // Bounces off the colours that the cell's surfaces have, found once for all cells of the same.
    Result<void> follow(Document& shown) {
        if (!isLitByBake(m_frame.view, shown))
            return {};
        const auto known = std::ranges::find_if(m_followed, [&](const Followed& other) {
            return other.materials == shown.materials && other.meshes == shown.meshes &&
                   other.bounces == shown.view.bounces && other.lighting == shown.view.lighting;
        });
        if (known != m_followed.end()) {
            shown.bakes = known->bakes;
            return {};
        }
        if (Result<void> followed = followBounces(m_session, m_frame.view, shown); !followed)
            return followed;
        m_followed.push_back(
            {shown.materials, shown.meshes, shown.view.bounces, shown.view.lighting, shown.bakes});
        return {};
    }

    // What followBounces() made of what.
    struct Followed {
        std::vector<Material> materials;
        std::vector<MeshInstance> meshes;
        int bounces;
        LightingMode lighting;
        std::vector<BakeArtifactPtr> bakes;
    };

    Session& m_session;
    const render::FrameSettings m_frame;
    std::unique_ptr<gl::Context> m_context; // outlives what it holds
    std::unique_ptr<render::SceneRenderer> m_scene;
    std::unique_ptr<render::WallRenderer> m_cells;
    View m_displayOf;
    ImagePtr m_lightImage;
    EnvironmentTexelsPtr m_light;
    NearShadowsPtr m_shadows;
    std::vector<Followed> m_followed;
    render::FollowedRadiosity m_radiosity;
};

} // namespace

std::unique_ptr<SheetCells> drawnCells(SheetSource source) {
    return std::make_unique<SheetDrawn>(std::move(source));
}

} // namespace patina::cli
