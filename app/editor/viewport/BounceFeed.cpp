#include "app/editor/viewport/BounceFeed.h"

#include "app/editor/job/BounceUpdater.h"
#include "render/SceneRenderer.h"

namespace patina::editor {

BounceFeed::BounceFeed(QObject* parent)
    : QObject(parent) {}

void BounceFeed::setBounces(BounceUpdater& bounces) {
    m_bounces = &bounces;
    connect(&bounces, &BounceUpdater::shownChanged, this, &BounceFeed::changed);
}

void BounceFeed::upload(render::SceneRenderer& renderer) {
    if (!m_bounces || (m_bounces->shown() == m_uploaded && !m_forgotten))
        return;
    m_forgotten = false;
    m_uploaded = m_bounces->shown();
    if (!m_uploaded) {
        renderer.clearBouncedLight();
        return;
    }
    for (const auto& [mesh, radiance] : *m_uploaded)
        renderer.setBouncedLight(mesh, radiance);
}

bool BounceFeed::isOnItsWay() const {
    return m_bounces && m_bounces->isOnItsWay();
}

void BounceFeed::endFrame(const render::SceneRenderer& renderer) {
    if (!m_bounces)
        return;
    if (const int order = m_bounces->lightOrder(); order > 0)
        m_bounces->setLight(renderer.transferLight(order));
}

} // namespace patina::editor
