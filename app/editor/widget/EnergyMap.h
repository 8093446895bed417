// Energy returned over roughness (to the right) and view angle (upwards) as colours; a press or
// drag chooses the angle.
#pragma once

#include "app/editor/widget/PlotFrame.h"

#include <QImage>
#include <vector>

namespace patina::editor {

class EnergyMap : public PlotFrame {
    Q_OBJECT
  public:
    explicit EnergyMap(QWidget* parent = nullptr);

    // Shares 0…1 and beyond, `size` × `size`: roughness (x + 0.5) / size, angle (y + 0.5) / size ·
    // 90°; empty: none.
    void setValues(std::vector<double> values, int size);
    // Where the material lies, low to high, and the angle that is looked at.
    void setPlace(double lowRoughness, double meanRoughness, double highRoughness, double angleDeg);

    [[nodiscard]] double valueAt(double roughness, double angleDeg) const;
    [[nodiscard]] std::vector<PlotValue> valuesAt(const QPointF& place) const override {
        return {{{}, {100.0 * valueAt(place.x(), place.y())}}};
    }
    [[nodiscard]] QSize sizeHint() const override { return {220, 176}; }
    [[nodiscard]] QSize minimumSizeHint() const override { return {150, 120}; }

  Q_SIGNALS:
    void anglePicked(double angleDeg);

  protected:
    [[nodiscard]] bool hasValues() const override { return m_size > 0; }
    [[nodiscard]] QPointF startPlace() const override; // where the material lies
    bool pick(const QPointF& place, Qt::KeyboardModifiers modifiers) override;
    void paintValues(QPainter& painter) const override;

  private:
    std::vector<double> m_values;
    int m_size = 0;
    double m_low = 0, m_mean = 0, m_high = 0, m_angle = 0;
    QImage m_image;
};

} // namespace patina::editor
