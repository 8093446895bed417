// Brings the coefficients of both pictures of a cross-fade into the renderer, so that light under
// transfer follows the fade at once, before there is a picture of both.
#pragma once

#include "app/editor/job/LatestJob.h"
#include "core/document/Document.h"
#include "render/SceneRenderer.h"

#include <QObject>
#include <memory>

namespace patina::editor {

class ProjectionFeed : public QObject {
    Q_OBJECT
  public:
    explicit ProjectionFeed(TaskRunner& runner, QObject* parent = nullptr);

    // With the renderer's context current, before a frame of the document.
    void upload(render::SceneRenderer& renderer, const Document& document);
    [[nodiscard]] bool isOnItsWay() const { return m_job.busy(); }

  Q_SIGNALS:
    void changed(); // there is something to upload

  private:
    ImagePtr m_asked; // under way, or done
    std::shared_ptr<const render::SceneRenderer::ProjectionSh> m_done;
    LatestJob m_job; // last: it ends first
};

} // namespace patina::editor
