// Curves over an angle: axes with units, linear or logarithmic, a marker, and a probe that reads
// the values out under the pointer.
#pragma once

#include "app/editor/widget/PlotStyle.h"

#include <QWidget>
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

struct PlotAxes {
    QString xName, yName; // "θo", "f_r"
    QString xUnit, yUnit; // "°", " sr⁻¹"; stands behind numbers in the readout
    double xMin = 0, xMax = 90, xStep = 30;
    bool logarithmic = false;   // of y
    std::optional<double> yMax; // fixed, from 0; otherwise what the curves need
};

class CurvePlot : public QWidget {
    Q_OBJECT
  public:
    explicit CurvePlot(const QString& title, QWidget* parent = nullptr);

    void setTitle(const QString& title);
    void setAxes(const PlotAxes& axes);
    void setCurves(std::vector<PlotCurve> curves);
    void setMessage(const QString& message); // in place of curves; empty: none
    // What the shapes of curves stand for, explained in the plot; empty: nothing to explain.
    void setKey(std::vector<std::pair<CurveShape, QString>> key);
    // An angle of its own (the mirror direction); one that a pointer, here or in another plot, is
    // at.
    void setMarker(std::optional<double> x, const QString& label);
    void setProbe(std::optional<double> x);

    [[nodiscard]] const std::vector<PlotCurve>& curves() const { return m_curves; }
    [[nodiscard]] QPointF position(double x, double y) const; // where a value is painted
    // What the readout says at an angle, a line for each curve.
    [[nodiscard]] QStringList readout(double x) const;
    [[nodiscard]] QString message() const { return m_message; }

    [[nodiscard]] QSize sizeHint() const override;
    [[nodiscard]] QSize minimumSizeHint() const override;

  Q_SIGNALS:
    void probed(std::optional<double> x); // by the pointer; nothing when it has left

  protected:
    void paintEvent(QPaintEvent* event) override;
    void mouseMoveEvent(QMouseEvent* event) override;
    void leaveEvent(QEvent* event) override;

  private:
    [[nodiscard]] QRectF area() const;
    [[nodiscard]] std::vector<double> yTicks() const;
    void fitRange();
    void paintAxes(QPainter& painter) const;
    void paintAxisNames(QPainter& painter) const;
    void paintWords(QPainter& painter, const QPointF& at, const QString& words) const;
    void paintCurve(QPainter& painter, const PlotCurve& curve) const;
    void paintKey(QPainter& painter) const;
    void paintProbe(QPainter& painter) const;

    std::vector<std::pair<CurveShape, QString>> m_key;
    QString m_title, m_message, m_markerLabel;
    PlotAxes m_axes;
    std::vector<PlotCurve> m_curves;
    std::optional<double> m_marker, m_probe;
    bool m_hovered = false;
    double m_yMin = 0, m_yMax = 1;
};

} // namespace patina::editor
