// A colour map with its numbers: what colour means what. Dragging its left or right third moves
// that end of the range, dragging the middle moves both, a double-click gives the range back.
#pragma once

#include "app/editor/widget/EditControl.h"
#include "core/image/ColorMap.h"

#include <QWidget>
#include <vector>

namespace patina::editor {

// Round numbers inside min…max, at most `most` (≥ 2) of them: multiples of 1, 2 or 5 times a power
// of ten; on a logarithmic scale (min > 0) powers of ten, or multiples when it spans less than two.
[[nodiscard]] std::vector<double> scaleTicks(double min, double max, bool logarithmic, int most);
// "0.25", "1000", "10⁵": short, and exact for round numbers.
[[nodiscard]] QString tickText(double value);

class ColorScale : public QWidget, public EditControl {
    Q_OBJECT
  public:
    ColorScale(ColorMap map, bool logarithmic, QWidget* parent = nullptr);

    void setRange(double min, double max); // min < max; shows, emits nothing
    [[nodiscard]] double min() const { return m_min; }
    [[nodiscard]] double max() const { return m_max; }
    [[nodiscard]] QSize sizeHint() const override;
    void abandonEdit() override { m_part = 0; }
    [[nodiscard]] QSize minimumSizeHint() const override { return sizeHint(); }

  Q_SIGNALS:
    void dragged(double min, double max);
    void resetRequested();

  protected:
    void paintEvent(QPaintEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;
    void mouseMoveEvent(QMouseEvent* event) override;
    void mouseReleaseEvent(QMouseEvent* event) override;
    void mouseDoubleClickEvent(QMouseEvent* event) override;

  private:
    // Where values are even: the value, or its logarithm.
    [[nodiscard]] double even(double value) const;
    [[nodiscard]] double value(double even) const;
    void paintTicks(QPainter& painter, const QRectF& bar) const;

    ColorMap m_map;
    bool m_logarithmic;
    double m_min = 0, m_max = 1;
    int m_part = 0; // of the press: 1 left end, 2 both, 3 right end; 0: none
    double m_pressX = 0, m_pressMin = 0, m_pressMax = 1; // even
};

} // namespace patina::editor
