// Brings traced shadows of local lights into the renderer, and says whether it has use for them.
#pragma once

#include "core/bake/local/NearShadows.h"

#include <QObject>

namespace patina::render {
class SceneRenderer;
}

namespace patina::editor {

class NearShadowUpdater;

class NearShadowFeed : public QObject {
    Q_OBJECT
  public:
    explicit NearShadowFeed(QObject* parent = nullptr);

    void setShadows(NearShadowUpdater& shadows);
    [[nodiscard]] NearShadowsPtr shown() const; // null: none
    void restart() { m_uploaded = nullptr; }    // the renderer is a new one
    // With the renderer's context current, before a frame: what has come since the last one.
    void upload(render::SceneRenderer& renderer);
    void endFrame(render::SceneRenderer& renderer);
    [[nodiscard]] bool isOnItsWay() const; // others than those that were uploaded

  Q_SIGNALS:
    void changed(); // there is something to upload

  private:
    NearShadowUpdater* m_shadows = nullptr;
    NearShadowsPtr m_uploaded;
};

} // namespace patina::editor
