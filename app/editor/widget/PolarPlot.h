// Lobes in the plane of incidence: how much light goes in which direction. The light is dragged
// around the point; Return brings it to the cursor, Alt with an arrow moves it.
#pragma once

#include "app/editor/widget/CurvePlot.h"

namespace patina::editor {

class PolarPlot : public CurvePlot {
    Q_OBJECT
  public:
    explicit PolarPlot(const QString& title, QWidget* parent = nullptr);

    // Points (angle -90…90°, value). `peak` > 0 lies on the rim; on a logarithmic radius `decades`
    // below it lie in the middle.
    void setCurves(std::vector<PlotCurve> curves, double peak, bool logarithmic, double decades);
    void setQuantity(const QString& name, const QString& unit);
    void setIncidence(double degrees); // of the light, 0…90

    [[nodiscard]] double incidence() const { return m_incidence; }
    [[nodiscard]] QPointF pointOf(const QPointF& place) const override; // degrees, value
    [[nodiscard]] std::optional<QPointF> placeAt(const QPointF& point) const override;
    [[nodiscard]] QPointF lightPosition() const; // of the handle

  Q_SIGNALS:
    void incidenceDragged(double degrees);

  protected:
    [[nodiscard]] QRectF area() const override;
    [[nodiscard]] QPointF startPlace() const override;
    [[nodiscard]] QPointF readoutPoint(const QPointF& place) const override;
    bool pick(const QPointF& place, Qt::KeyboardModifiers modifiers) override;
    bool moveHandle(const QPointF& way) override;
    void paintValues(QPainter& painter) const override;
    void paintProbe(QPainter& painter, const QPointF& place) const override;
    void paintCurve(QPainter& painter, const PlotCurve& curve) const override;

  private:
    struct Dial {
        QPointF center;
        double radius;
    };
    [[nodiscard]] Dial dial() const;
    [[nodiscard]] double radiusOf(double value) const; // 0…1
    [[nodiscard]] QPointF onDial(double degrees, double radius) const;
    [[nodiscard]] std::vector<double> rings() const; // values, from the rim inwards
    void paintDial(QPainter& painter) const;
    void paintLight(QPainter& painter) const;

    double m_peak = 1, m_decades = 4, m_incidence = 45;
    bool m_logarithmic = false;
};

} // namespace patina::editor
