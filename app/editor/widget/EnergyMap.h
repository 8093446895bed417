// Energy returned over roughness (to the right) and view angle (upwards) as colours; a press or
// drag chooses the angle.
#pragma once

#include <QImage>
#include <QWidget>
#include <vector>

namespace patina::editor {

class EnergyMap : public QWidget {
    Q_OBJECT
  public:
    explicit EnergyMap(QWidget* parent = nullptr);

    // Shares 0…1 and beyond, `size` × `size`: roughness (x + 0.5) / size, angle (y + 0.5) / size
    // · 90°.
    void setValues(std::vector<double> values, int size);
    // Where the material lies, low to high, and the angle that is looked at.
    void setPlace(double lowRoughness, double meanRoughness, double highRoughness, double angleDeg);

    [[nodiscard]] double valueAt(double roughness, double angleDeg) const;
    [[nodiscard]] QPointF position(double roughness, double angleDeg) const; // where it is painted
    [[nodiscard]] QSize sizeHint() const override;
    [[nodiscard]] QSize minimumSizeHint() const override;

  Q_SIGNALS:
    void anglePicked(double angleDeg);

  protected:
    void paintEvent(QPaintEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;
    void mouseMoveEvent(QMouseEvent* event) override;
    bool event(QEvent* event) override; // the tool tip reads the map under the pointer

  private:
    [[nodiscard]] QRectF area() const;
    void paintScale(QPainter& painter, const QRectF& plot) const;
    void pickAngle(const QPointF& position);

    std::vector<double> m_values;
    int m_size = 0;
    double m_min = 0, m_max = 1; // of the colours
    double m_low = 0, m_mean = 0, m_high = 0, m_angle = 0;
    QImage m_image;
};

} // namespace patina::editor
