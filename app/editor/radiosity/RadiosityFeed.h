// Brings solved radiosity into the renderer, and says whether a frame is lit by it.
#pragma once

#include "render/view/ViewSettings.h"

#include <QObject>
#include <memory>

namespace patina {
struct ShownRadiosity;
}

namespace patina::render {
class SceneRenderer;
}

namespace patina::editor {

class RadiosityUpdater;

class RadiosityFeed : public QObject {
    Q_OBJECT
  public:
    explicit RadiosityFeed(QObject* parent = nullptr);

    void setRadiosity(RadiosityUpdater& radiosity);
    void restart() { m_uploaded = nullptr; } // the renderer is a new one
    // With the renderer's context current, before a frame: what has come since the last one.
    void upload(render::SceneRenderer& renderer);
    // What the frame shows, of a document that is lit so, or else a cell of the wall.
    void setLooked(const render::ViewSettings& view, LightingMode lighting);
    void setWanted(bool wanted);
    // Another one than what was uploaded, for a frame that is lit by it.
    [[nodiscard]] bool isOnItsWay() const;

  Q_SIGNALS:
    void changed(); // there is something to upload

  private:
    RadiosityUpdater* m_radiosity = nullptr;
    std::shared_ptr<const ShownRadiosity> m_uploaded;
};

} // namespace patina::editor
