#include "app/editor/radiosity/RadiosityFeed.h"

#include "app/editor/radiosity/RadiosityUpdater.h"
#include "core/document/ViewChoices.h"
#include "render/FollowedRadiosity.h"
#include "render/SceneRenderer.h"

namespace patina::editor {

RadiosityFeed::RadiosityFeed(QObject* parent)
    : QObject(parent) {}

void RadiosityFeed::setRadiosity(RadiosityUpdater& radiosity) {
    m_radiosity = &radiosity;
    connect(&radiosity, &RadiosityUpdater::shownChanged, this, &RadiosityFeed::changed);
}

void RadiosityFeed::upload(render::SceneRenderer& renderer) {
    if (!m_radiosity || m_radiosity->shown() == m_uploaded)
        return;
    m_uploaded = m_radiosity->shown();
    renderer.setRadiosity(m_uploaded);
}

void RadiosityFeed::setLooked(const render::ViewSettings& view, LightingMode lighting) {
    setWanted(render::isLitBy(LightingMode::Radiosity, lighting, view));
    const auto isOfFactors = [](const render::ViewChoice& choice) {
        return choice.kind == shading::kViewFormFactor;
    };
    if (m_radiosity && m_radiosity->isWanted() &&
        (isOfFactors(view.shown) || (view.split && isOfFactors(view.split->other))))
        m_radiosity->lookAtFactors();
}

bool RadiosityFeed::isOnItsWay() const {
    return m_radiosity && m_radiosity->isWanted() && m_radiosity->isOnItsWay();
}

void RadiosityFeed::setWanted(bool wanted) {
    if (m_radiosity)
        m_radiosity->setWanted(wanted);
}

} // namespace patina::editor
