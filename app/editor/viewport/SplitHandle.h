// The limit between two views, over the viewport: its line, its handles, the names on both sides.
// Dragging the line moves it, dragging the ring turns it (Shift: in steps), Esc takes the split
// away, or a drag back.
#pragma once

#include "render/view/ViewSettings.h"

#include <QPointF>
#include <QWidget>

namespace patina::editor {

class ViewState;

// The limit in pixels of a viewport, y downwards.
struct SplitLine {
    QPointF center;
    QPointF along; // unit, upwards at 0°
    QPointF right; // unit, towards the other view

    SplitLine(const render::ViewSplit& split, const QSizeF& size);
    [[nodiscard]] QPointF ring() const;                        // what turns it
    [[nodiscard]] double distance(const QPointF& point) const; // positive on the right
};

class SplitHandle : public QWidget {
    Q_OBJECT
  public:
    // Covers `viewport` and sees its events before those that have listened for longer.
    SplitHandle(ViewState& views, QWidget& viewport);

  protected:
    void paintEvent(QPaintEvent* event) override;
    bool eventFilter(QObject* viewport, QEvent* event) override;

  private:
    enum class Part { None, Line, Ring };
    [[nodiscard]] Part partAt(const QPointF& point) const;
    void refresh();
    void hover(Part part);
    bool press(const QPointF& point);
    void drag(const QPointF& point, bool inSteps);
    bool escape();
    void paintCaption(QPainter& painter, const SplitLine& line, const render::ViewChoice& choice,
                      double side) const;

    ViewState& m_views;
    QWidget& m_viewport;
    Part m_hovered = Part::None, m_dragged = Part::None;
    QPointF m_grab;                 // from the pointer to the centre
    render::ViewSplit m_beforeDrag; // where Esc goes back to
    bool m_otherDrag = false;       // a button is held that is not ours
};

} // namespace patina::editor
