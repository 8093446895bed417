// Over the viewport: the rays of the pixel that the Ray Tree dock shows, in colours by their kind,
// with the points that they meet and the normals there. A click in the classical picture chooses
// the pixel.
#pragma once

#include "app/editor/viewport/ViewportClick.h"
#include "core/math/Camera.h"

#include <QPainter>
#include <QWidget>

namespace patina {
struct RayNode;
}

namespace patina::editor {

class DocumentController;
class RayTreeProbe;
class ViewLines;
class ViewportWidget;

class RayTreeOverlay : public QWidget {
    Q_OBJECT
  public:
    RayTreeOverlay(RayTreeProbe& probe, DocumentController& controller, ViewportWidget& viewport);
    // Of the nodes that are drawn: the camera ray of the selected one, with all below it.
    [[nodiscard]] int drawnRays() const;

  protected:
    bool eventFilter(QObject* viewport, QEvent* event) override;
    void paintEvent(QPaintEvent* event) override;

  private:
    void follow();
    [[nodiscard]] glm::vec3 endOf(const RayNode& node) const;
    void paintRay(QPainter& painter, const ViewLines& view, const RayNode& node, bool selected,
                  bool dimmed) const;

    RayTreeProbe& m_probe;
    DocumentController& m_controller;
    ViewportWidget& m_viewport;
    ViewportClick m_click;
    Camera m_camera;      // of what is being painted
    float m_reach = 1.0f; // metres, of rays that meet nothing
};

} // namespace patina::editor
