// What plots, charts and pictures of values share: a title, axes, a cursor that the pointer or the
// keys move, one readout of the values at it, words where there are none, and the values as text.
//
// Keys: arrows move the cursor by a step, with Shift by a tenth of it, with Ctrl by ten; Home and
// End go to the ends of an axis; Return and Space do what a press there does; Alt with an arrow
// moves what a drag moves; Esc takes the cursor away; Ctrl+C copies the values.
#pragma once

#include "app/editor/widget/PlotAxis.h"
#include "app/editor/widget/PlotStyle.h"

#include <QWidget>
#include <functional>
#include <optional>
#include <vector>

namespace patina::editor {

// A value at a place: of a curve, a look, a part.
struct PlotValue {
    QString name;                // empty: there is only one
    std::vector<double> numbers; // one, or three of channels
    int look = -1;               // whose sample line stands before it: PlotStyle.h; -1: none
    QString note = {};           // in place of numbers
};

struct PlotReadout {
    QString place;                      // "θₒ = 30°"
    std::vector<ReadoutRow> rows;       // the values there; none: there is nothing to read
    [[nodiscard]] QString text() const; // in one line
};

class PlotFrame : public QWidget {
    Q_OBJECT
  public:
    enum class Cursor { Across, Up, Both }; // the axes it moves along
    // What the left button does: nothing, something once, the same along the way, or it drags
    // something, and there is no readout meanwhile.
    enum class Press { Nothing, Once, Follows, Drags };

    PlotFrame(const QString& title, Cursor cursor, Press press, QWidget* parent = nullptr);

    void setTitle(const QString& title); // empty: no row for it
    [[nodiscard]] QString title() const { return m_title; }
    void setHelp(const QString& help);               // in the status bar, and the description
    void setDescription(const QString& description); // for screen readers, behind the readout
    void setMessage(const QString& message);         // in place of values; empty: none
    void setEmptyText(const QString& text);          // what stands there while there are no values
    [[nodiscard]] QString message() const;           // that is shown; empty: values are

    // Across, up, and what is told by colours or bars where there is such a thing.
    [[nodiscard]] const std::vector<PlotAxis>& axes() const { return m_axes; }

    // A place is a value of the first axis (0 where the cursor only moves up) and of the second (0
    // where it only moves across).
    [[nodiscard]] virtual QPointF pointOf(const QPointF& place) const; // where it is painted
    [[nodiscard]] QPointF position(double x, double y) const { return pointOf({x, y}); }
    // The nearest place, or nothing where there is none.
    [[nodiscard]] virtual std::optional<QPointF> placeAt(const QPointF& point) const;
    [[nodiscard]] virtual std::vector<PlotValue> valuesAt(const QPointF& place) const = 0;
    [[nodiscard]] PlotReadout readoutAt(const QPointF& place) const;
    // A line for each of places(), tabs between columns, units in the first line.
    [[nodiscard]] QString valuesText() const;

    // The cursor; also one that the pointer has set in another plot: then without a readout.
    void setProbe(const std::optional<QPointF>& place);
    [[nodiscard]] const std::optional<QPointF>& probe() const { return m_probe; }
    // The readout is shown: the pointer or the keys are here.
    [[nodiscard]] bool reads() const { return m_reader != Reader::Nobody; }
    void copyValues() const; // to the clipboard

    [[nodiscard]] QSize sizeHint() const override { return {260, 200}; }
    [[nodiscard]] QSize minimumSizeHint() const override { return {140, 110}; }

  Q_SIGNALS:
    void probed(const std::optional<QPointF>& place); // by pointer or keys; nothing: it has left

  protected:
    void setAxes(std::vector<PlotAxis> axes); // two or more
    [[nodiscard]] virtual bool hasValues() const = 0;
    [[nodiscard]] virtual QString placeText(const QPointF& place) const; // "θₒ = 30°"
    [[nodiscard]] virtual std::vector<QPointF> places() const; // all, or evenly spaced ones
    [[nodiscard]] virtual QRectF area() const; // of the values, inside of axes and their numbers
    [[nodiscard]] virtual QPointF startPlace() const; // of the keys; the middle
    // The nearest place that there is, of one within the axes.
    [[nodiscard]] virtual QPointF allowed(const QPointF& place) const { return place; }
    // Returns whether a press there does anything.
    virtual bool pick(const QPointF& place, Qt::KeyboardModifiers modifiers);
    // Alt with an arrow; returns whether there is anything to move.
    virtual bool moveHandle(const QPointF& way);

    virtual void paintGround(QPainter& painter) const; // well, title, the title of the axis
    virtual void paintMessage(QPainter& painter, const QString& message) const;
    virtual void paintValues(QPainter& painter) const = 0;
    virtual void paintProbe(QPainter& painter, const QPointF& place) const;
    [[nodiscard]] virtual QString corner() const; // right of the title: what the values are
    [[nodiscard]] virtual QPointF readoutPoint(const QPointF& place) const; // it stands beside it
    [[nodiscard]] virtual bool boxesReadout() const { return true; } // or it stands elsewhere
    void paintAxes(QPainter& painter) const; // with a grid, but around a picture
    // What colours mean, right of area(): the ends of the third axis; `color` of a share 0…1.
    void paintScale(QPainter& painter, const std::function<QColor(double)>& color) const;
    [[nodiscard]] double scaleWidth() const; // with its numbers
    // That shows on every colour.
    static void paintCross(QPainter& painter, const QPointF& at, double arm = 7.0);
    // Words inside of the plot stand on its ground, not on lines.
    static void paintWords(QPainter& painter, const QPointF& at, const QString& words);

    bool event(QEvent* event) override; // keys that the window would take
    void paintEvent(QPaintEvent* event) final;
    void mousePressEvent(QMouseEvent* event) override;
    void mouseMoveEvent(QMouseEvent* event) override;
    void mouseReleaseEvent(QMouseEvent* event) override;
    void leaveEvent(QEvent* event) override;
    void focusInEvent(QFocusEvent* event) override;
    void focusOutEvent(QFocusEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;
    void contextMenuEvent(QContextMenuEvent* event) override;

    std::vector<PlotAxis> m_axes;

  private:
    enum class Reader { Nobody, Pointer, Keys };
    void read(const std::optional<QPointF>& place, Reader reader);
    void readByKeys(const QPointF& place);
    void describe();
    [[nodiscard]] bool wants(const QKeyEvent& event) const;
    [[nodiscard]] int axisOf(const QPoint& way) const; // that the cursor moves along, or -1
    [[nodiscard]] bool isPicture() const { return m_axes.size() > 2; }
    [[nodiscard]] QString upNumber(double value) const; // on the axis that goes up
    [[nodiscard]] const PlotAxis& valueAxis() const;    // of what is read

    QString m_title, m_message, m_emptyText, m_description;
    std::vector<int> m_moved; // axes
    Press m_press;
    Reader m_reader = Reader::Nobody;
    bool m_pressed = false;
    std::optional<QPointF> m_probe;
    std::optional<QRectF> m_painted; // area() while it paints
};

} // namespace patina::editor
