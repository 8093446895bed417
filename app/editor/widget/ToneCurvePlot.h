// What the display is sent for how much light: stops around middle grey to the right, the display's
// value upwards, and where the picture's average lies.
#pragma once

#include "app/editor/widget/CurvePlot.h"

namespace patina::editor {

class ToneCurvePlot : public CurvePlot {
    Q_OBJECT
  public:
    static constexpr int kStops = 8; // to either side

    explicit ToneCurvePlot(QWidget* parent = nullptr);

    // Display values 0…1 from -kStops to +kStops in even steps, at least two.
    void setCurve(std::vector<float> values);
    // Exposed log-average luminance in stops above middle grey; nothing: not known.
    void setAverage(std::optional<double> stops);

    [[nodiscard]] double valueAt(double stops) const; // of the curve, 0…1
    [[nodiscard]] std::optional<double> average() const { return m_average; }
    // Where a point of the plot, of a value in 0…1, is painted.
    [[nodiscard]] QPointF position(double stops, double value) const;

    [[nodiscard]] QSize sizeHint() const override;
    [[nodiscard]] QSize minimumSizeHint() const override;

  protected:
    void paintValues(QPainter& painter) const override;
    [[nodiscard]] QColor colorOf(const PlotCurve& curve) const override;
    void paintCurve(QPainter& painter, const PlotCurve& curve) const override;

  private:
    std::vector<float> m_values;
    std::optional<double> m_average;
};

} // namespace patina::editor
