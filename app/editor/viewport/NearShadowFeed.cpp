#include "app/editor/viewport/NearShadowFeed.h"

#include "app/editor/job/NearShadowUpdater.h"
#include "render/SceneRenderer.h"

namespace patina::editor {

NearShadowFeed::NearShadowFeed(QObject* parent)
    : QObject(parent) {}

void NearShadowFeed::setShadows(NearShadowUpdater& shadows) {
    m_shadows = &shadows;
    connect(&shadows, &NearShadowUpdater::shownChanged, this, &NearShadowFeed::changed);
}

NearShadowsPtr NearShadowFeed::shown() const {
    return m_shadows ? m_shadows->shown() : nullptr;
}

void NearShadowFeed::upload(render::SceneRenderer& renderer) {
    if (!m_shadows || m_shadows->shown() == m_uploaded)
        return;
    m_uploaded = m_shadows->shown();
    renderer.setNearShadows(m_uploaded);
}

bool NearShadowFeed::isOnItsWay() const {
    return m_shadows && m_shadows->isWanted() && !m_shadows->upToDate();
}

void NearShadowFeed::endFrame(render::SceneRenderer& renderer) {
    if (m_shadows)
        m_shadows->setWanted(renderer.takeNearShadowUse());
}

} // namespace patina::editor
