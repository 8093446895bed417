// Lobes in the plane of incidence: how much light goes in which direction. The light is dragged
// around the point, the pointer reads values out.
#pragma once

#include "app/editor/widget/CurvePlot.h"

#include <QWidget>
#include <optional>
#include <vector>

namespace patina::editor {

class PolarPlot : public QWidget {
    Q_OBJECT
  public:
    explicit PolarPlot(const QString& title, QWidget* parent = nullptr);

    // Points (angle -90…90°, value). `peak` > 0 lies on the rim; on a logarithmic radius `decades`
    // below it lie in the middle.
    void setCurves(std::vector<PlotCurve> curves, double peak, bool logarithmic, double decades);
    void setQuantity(const QString& name, const QString& unit);
    void setIncidence(double degrees); // of the light, 0…90
    void setProbe(std::optional<double> degrees);
    void setMessage(const QString& message);

    [[nodiscard]] double incidence() const { return m_incidence; }
    [[nodiscard]] QPointF position(double degrees, double value) const;
    [[nodiscard]] QPointF lightPosition() const; // of the handle
    [[nodiscard]] QStringList readout(double degrees) const;
    [[nodiscard]] QString message() const { return m_message; }

    [[nodiscard]] QSize sizeHint() const override;
    [[nodiscard]] QSize minimumSizeHint() const override;

  Q_SIGNALS:
    void probed(std::optional<double> degrees);
    void incidenceDragged(double degrees);

  protected:
    void paintEvent(QPaintEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;
    void mouseMoveEvent(QMouseEvent* event) override;
    void mouseReleaseEvent(QMouseEvent* event) override;
    void leaveEvent(QEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;

  private:
    struct Dial {
        QPointF center;
        double radius;
    };
    [[nodiscard]] Dial dial() const;
    [[nodiscard]] double radiusOf(double value) const; // 0…1
    [[nodiscard]] QPointF onDial(double degrees, double radius) const;
    [[nodiscard]] double angleAt(const QPointF& point) const; // -90…90
    void paintDial(QPainter& painter) const;
    void paintLight(QPainter& painter) const;
    void paintProbe(QPainter& painter) const;

    QString m_title, m_message, m_name, m_unit;
    std::vector<PlotCurve> m_curves;
    double m_peak = 1, m_decades = 4, m_incidence = 45;
    bool m_logarithmic = false, m_dragging = false, m_hovered = false;
    std::optional<double> m_probe;
};

} // namespace patina::editor
