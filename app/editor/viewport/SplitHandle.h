// The line between the two sides of a picture (two views, two cells that are compared), over the
// viewport: its handles, the names on both sides. Dragging the line moves it, dragging the ring
// rotates it (Shift: in steps), Esc removes the split, or takes a drag back.
#pragma once

#include "render/view/ViewSettings.h"

#include <QObject>
#include <QPointF>
#include <QRect>
#include <QString>
#include <QWidget>
#include <optional>

namespace patina::editor {

// What a SplitHandle shows and moves.
class SplitModel : public QObject {
    Q_OBJECT
  public:
    using QObject::QObject;
    // Position and angle; nothing: there is no line.
    [[nodiscard]] virtual std::optional<render::ViewSplit> line() const = 0;
    virtual void moveLine(const render::ViewSplit& line) = 0;
    virtual void removeLine() = 0;
    [[nodiscard]] virtual QString leftName() const = 0;
    [[nodiscard]] virtual QString rightName() const = 0;
    // Of a viewport of this size, the part that is divided.
    [[nodiscard]] virtual QRect area(const QSize& viewport) const { return {{}, viewport}; }

  Q_SIGNALS:
    void lineChanged();
};

// The line in pixels of the area, y downwards.
struct SplitLine {
    QPointF center;
    QPointF along; // unit, upwards at 0°
    QPointF right; // unit, towards the other side

    SplitLine(const render::ViewSplit& split, const QSizeF& size);
    [[nodiscard]] QPointF ring() const;                        // what turns it
    [[nodiscard]] double distance(const QPointF& point) const; // positive on the right
};

class SplitHandle : public QWidget {
    Q_OBJECT
  public:
    // Covers the area in `viewport` and sees its events before those that have listened for longer.
    SplitHandle(SplitModel& model, QWidget& viewport);

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
    void paintCaption(QPainter& painter, const SplitLine& line, const QString& name,
                      double side) const;

    SplitModel& m_model;
    QWidget& m_viewport;
    Part m_hovered = Part::None, m_dragged = Part::None;
    QPointF m_grab;                 // from the pointer to the centre
    render::ViewSplit m_beforeDrag; // where Esc goes back to
    bool m_otherDrag = false;       // a button is held that is not ours
};

} // namespace patina::editor
