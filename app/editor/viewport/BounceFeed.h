// Brings the light that has bounced off edited surfaces into the renderer, and the renderer's light
// to whoever follows it.
#pragma once

#include "app/editor/job/BounceWork.h"

#include <QObject>

namespace patina::render {
class SceneRenderer;
}

namespace patina::editor {

class BounceUpdater;

class BounceFeed : public QObject {
    Q_OBJECT
  public:
    explicit BounceFeed(QObject* parent = nullptr);

    void setBounces(BounceUpdater& bounces);
    // The renderer has forgotten what it was given: it is a new one, or has a new bake.
    void restart() { m_forgotten = true; }
    // With the renderer's context current, before a frame: what has come since the last one.
    void upload(render::SceneRenderer& renderer);
    void endFrame(const render::SceneRenderer& renderer);
    // Light of other surfaces, or of another number of bounces, than what was uploaded.
    [[nodiscard]] bool isOnItsWay() const;

  Q_SIGNALS:
    void changed(); // there is something to upload

  private:
    BounceUpdater* m_bounces = nullptr;
    BouncedLightPtr m_uploaded;
    bool m_forgotten = false;
};

} // namespace patina::editor
