// Brings a running bake's results into the renderer.
#pragma once

#include <QElapsedTimer>
#include <QObject>
#include <QTimer>

namespace patina::render {
class SceneRenderer;
}

namespace patina::editor {

class BakeService;

class PreviewFeed : public QObject {
    Q_OBJECT
  public:
    explicit PreviewFeed(QObject* parent = nullptr);

    void setBakes(BakeService& bakes); // whose live preview is shown
    // The renderer is a new one, which knows nothing yet.
    void restart();
    // While the hand moves, frames have little time for what is new.
    void setHandMoves(bool moves) { m_handMoves = moves; }
    // With the renderer's context current: what has come since the last call, or the end of it.
    void upload(render::SceneRenderer& renderer);

  Q_SIGNALS:
    void changed(); // there is something to upload

  private:
    void poll();

    BakeService* m_bakes = nullptr;
    QTimer m_timer;
    bool m_shown = false, m_handMoves = false;
    bool m_pending = false; // a new pass is to be uploaded
    int m_samples = 0;      // of the pass seen last
    QElapsedTimer m_sinceShown;
};

} // namespace patina::editor
