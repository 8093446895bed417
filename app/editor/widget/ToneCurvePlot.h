// What the display is sent for how much light: stops around middle grey to the right, the display's
// value upwards, and where the picture's average lies.
#pragma once

#include <QWidget>
#include <optional>
#include <vector>

namespace patina::editor {

class ToneCurvePlot : public QWidget {
    Q_OBJECT
  public:
    static constexpr int kStops = 8; // to either side

    explicit ToneCurvePlot(QWidget* parent = nullptr);

    // Display values 0…1 from -kStops to +kStops in even steps, at least two.
    void setCurve(std::vector<float> values);
    // Exposed log-average luminance in stops above middle grey; nothing: not known.
    void setAverage(std::optional<double> stops);

    [[nodiscard]] double valueAt(double stops) const; // of the curve
    [[nodiscard]] std::optional<double> average() const { return m_average; }
    // Where a point of the plot is painted.
    [[nodiscard]] QPointF position(double stops, double value) const;

    [[nodiscard]] QSize sizeHint() const override;
    [[nodiscard]] QSize minimumSizeHint() const override;

  protected:
    void paintEvent(QPaintEvent* event) override;
    bool event(QEvent* event) override; // the tool tip reads the curve under the pointer

  private:
    [[nodiscard]] QRectF plotArea() const;
    void paintGrid(QPainter& painter) const;
    void paintCurve(QPainter& painter) const;
    void paintAverage(QPainter& painter) const;

    std::vector<float> m_values;
    std::optional<double> m_average;
};

} // namespace patina::editor
