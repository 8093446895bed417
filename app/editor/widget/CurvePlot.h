// Curves over an angle or any other number: linear or logarithmic, with a marker.
#pragma once

#include "app/editor/widget/PlotFrame.h"

#include <optional>
#include <vector>

namespace patina::editor {

enum class CurveShape { Line, Thin, Dots };

struct PlotCurve {
    int look = 0; // colour and dash: PlotStyle.h
    CurveShape shape = CurveShape::Line;
    QString name;                // in the readout
    std::vector<QPointF> points; // x ascending
};

[[nodiscard]] QPen curvePen(CurveShape shape, int look);

class CurvePlot : public PlotFrame {
    Q_OBJECT
  public:
    explicit CurvePlot(const QString& title, QWidget* parent = nullptr,
                       Press press = Press::Nothing);

    // `yMax`: fixed, from 0; otherwise what the curves need.
    void setAxes(const PlotAxis& x, const PlotAxis& y, std::optional<double> yMax = {});
    void setCurves(std::vector<PlotCurve> curves);
    // What the shapes of curves stand for, explained in the plot; empty: nothing to explain.
    void setKey(std::vector<std::pair<CurveShape, QString>> key);
    void setMarker(std::optional<double> x,
                   const QString& label); // e.g. the mirror direction

    [[nodiscard]] const std::vector<PlotCurve>& curves() const { return m_curves; }
    // The readout's lines at x, one for each curve.
    [[nodiscard]] QStringList readout(double x) const;
    [[nodiscard]] std::vector<PlotValue> valuesAt(const QPointF& place) const override;

  protected:
    [[nodiscard]] bool hasValues() const override { return !m_curves.empty(); }
    [[nodiscard]] std::vector<QPointF> places() const override; // of the first curve's points
    [[nodiscard]] QPointF startPlace() const override;          // the marker, if there is one
    void paintValues(QPainter& painter) const override;
    void paintProbe(QPainter& painter, const QPointF& place) const override;
    [[nodiscard]] virtual QColor colorOf(const PlotCurve& curve) const; // of dots on it
    void paintDots(QPainter& painter, double x) const;                  // on the curves
    virtual void paintCurve(QPainter& painter, const PlotCurve& curve) const;
    // The line through the curve's points, broken where a value is not finite.
    [[nodiscard]] QPainterPath pathOf(const PlotCurve& curve) const;

  private:
    void fitRange();
    void paintMarker(QPainter& painter) const;
    void paintKey(QPainter& painter) const;

    std::vector<std::pair<CurveShape, QString>> m_key;
    QString m_markerLabel;
    std::vector<PlotCurve> m_curves;
    std::optional<double> m_marker, m_yMax;
};

} // namespace patina::editor
