// Materials and snapshots that are dropped onto the viewport: onto cells and captions of a wall,
// which show them alone, or onto the picture, where a material covers the mesh under the pointer
// and a snapshot is restored.
#pragma once

#include "app/editor/document/DraggedElements.h"

#include <QPointF>
#include <QRect>
#include <QStringList>

namespace patina::editor {

class DocumentController;
class ViewportWidget;
class WallOverlay;
class WallState;

struct ElementDropPlan {
    struct Part {
        Id id = 0;
        std::vector<std::size_t> cells; // of the wall; none: the picture
        Id mesh = 0;                    // of the picture, that a material covers
    };
    std::vector<Part> parts; // none: they are not taken here
    QRect area;              // of the cells, in the viewport; null: all of it
    QStringList lines;       // what it will do, or what to do instead
};

class ElementDrop {
  public:
    ElementDrop(WallState& wall, DocumentController& controller, ViewportWidget& viewport,
                const WallOverlay& overlay);

    // `position` in the viewport; without lines outside of it. Several go to the cells that follow.
    [[nodiscard]] ElementDropPlan plan(const DraggedElements& elements,
                                       const QPointF& position) const;
    void drop(CellElement element, const ElementDropPlan& plan);

  private:
    [[nodiscard]] ElementDropPlan planWall(const DraggedElements& elements,
                                           const QPointF& position) const;
    [[nodiscard]] ElementDropPlan planPicture(const DraggedElements& elements,
                                              const QPointF& position) const;

    WallState& m_wall;
    DocumentController& m_controller;
    ViewportWidget& m_viewport;
    const WallOverlay& m_overlay;
};

} // namespace patina::editor
