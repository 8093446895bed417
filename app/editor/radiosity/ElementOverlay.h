// Over the viewport: the element that was chosen by a click, with arrows from what lights it most,
// or its links to clusters and elements, and, step by step, the one that shoots next.
#pragma once

#include "app/editor/viewport/ViewportClick.h"
#include "core/math/Camera.h"
#include "core/radiosity/document/ElementLinks.h"
#include "core/radiosity/document/EnergyFlow.h"

#include <QColor>
#include <QPainter>
#include <QWidget>
#include <cstdint>
#include <optional>
#include <vector>

namespace patina::editor {

class DocumentController;
class RadiosityUpdater;
class ViewLines;
class ViewportWidget;

class ElementOverlay : public QWidget {
    Q_OBJECT
  public:
    ElementOverlay(RadiosityUpdater& radiosity, DocumentController& controller,
                   ViewportWidget& viewport);
    // Whether the dock is seen: without, clicks are not followed, and nothing is drawn.
    void setWanted(bool wanted);
    [[nodiscard]] int drawnArrows() const { return m_arrows; }
    // Of the links of the chosen element those with the most light, in place of arrows.
    static constexpr std::size_t kMostLinks = 300;
    [[nodiscard]] const ElementLinks& links() const { return m_links; }
    [[nodiscard]] int drawnLinks() const { return m_drawnLinks; }

  protected:
    bool eventFilter(QObject* viewport, QEvent* event) override;
    void paintEvent(QPaintEvent* event) override;

  private:
    void follow();
    [[nodiscard]] bool isThere(const std::optional<std::uint32_t>& element) const;
    void choose(const QPointF& at);
    void paintOutline(QPainter& painter, const ViewLines& view,
                      const std::vector<glm::vec3>& corners, const QColor& color) const;
    void paintArrows(QPainter& painter, const ViewLines& view, std::uint32_t element);
    void paintLinks(QPainter& painter, const ViewLines& view, std::uint32_t element);

    RadiosityUpdater& m_radiosity;
    DocumentController& m_controller;
    ViewportWidget& m_viewport;
    ViewportClick m_click;
    std::vector<FlowShare> m_senders; // to the chosen element, the largest first
    Camera m_camera;                  // of what is being painted
    bool m_wanted = false;
    int m_arrows = 0, m_drawnLinks = 0;
    ElementLinks m_links; // of the chosen element; none of most solvers
};

} // namespace patina::editor
