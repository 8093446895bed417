// Over the viewport: the element that was chosen by a click, with arrows from what lights it most,
// and, step by step, the one that shoots next.
#pragma once

#include "app/editor/viewport/ViewportClick.h"
#include "core/math/Camera.h"
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

  protected:
    bool eventFilter(QObject* viewport, QEvent* event) override;
    void paintEvent(QPaintEvent* event) override;

  private:
    void follow();
    [[nodiscard]] bool isThere(const std::optional<std::uint32_t>& element) const;
    void choose(const QPointF& at);
    void paintOutline(QPainter& painter, const ViewLines& view, std::uint32_t element,
                      const QColor& color) const;
    void paintArrows(QPainter& painter, const ViewLines& view, std::uint32_t element);

    RadiosityUpdater& m_radiosity;
    DocumentController& m_controller;
    ViewportWidget& m_viewport;
    ViewportClick m_click;
    std::vector<FlowShare> m_senders; // to the chosen element, the largest first
    Camera m_camera;                  // of what is being painted
    bool m_wanted = false;
    int m_arrows = 0;
};

} // namespace patina::editor
