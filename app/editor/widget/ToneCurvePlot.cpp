#include "app/editor/widget/ToneCurvePlot.h"

#include "app/editor/style/Tokens.h"

#include <QPainterPath>
#include <algorithm>

namespace patina::editor {
namespace {
constexpr int kHeight = 168;
} // namespace

ToneCurvePlot::ToneCurvePlot(QWidget* parent)
    : CurvePlot(tr("Tone curve"), parent) {
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
    setHelp(tr("What the display is sent for light from 8 stops below to 8 above middle grey."));
    setAxes({tr("light"), tr(" EV"), -kStops, kStops, 4.0},
            {tr("display"), QStringLiteral(" %"), 0.0, 100.0, 25.0}, 100.0);
}

void ToneCurvePlot::setCurve(std::vector<float> values) {
    if (values == m_values || values.size() < 2)
        return; // frames come more often than curves
    PlotCurve curve;
    for (std::size_t i = 0; i < values.size(); ++i)
        curve.points.emplace_back(
            kStops * (2.0 * static_cast<double>(i) / static_cast<double>(values.size() - 1) - 1.0),
            100.0 * static_cast<double>(values[i]));
    m_values = std::move(values);
    setCurves({std::move(curve)});
}

void ToneCurvePlot::setAverage(std::optional<double> stops) {
    if (stops == m_average)
        return;
    m_average = stops;
    update();
}

double ToneCurvePlot::valueAt(double stops) const {
    return curves().empty() ? 0.0 : plotPoint(curves().front().points, stops).y() / 100.0;
}

QPointF ToneCurvePlot::position(double stops, double value) const {
    return pointOf({stops, 100.0 * value});
}

QSize ToneCurvePlot::sizeHint() const {
    return {240, kHeight};
}
QSize ToneCurvePlot::minimumSizeHint() const {
    return {160, kHeight};
}

QColor ToneCurvePlot::colorOf(const PlotCurve&) const {
    return QColor(tokens::kAccent);
}

void ToneCurvePlot::paintCurve(QPainter& painter, const PlotCurve& curve) const {
    const QPainterPath path = pathOf(curve);
    QPainterPath filled = path;
    filled.lineTo(area().bottomRight());
    filled.lineTo(area().bottomLeft());
    filled.closeSubpath();
    QColor under(tokens::kAccentDeep);
    under.setAlpha(90);
    painter.fillPath(filled, under);
    painter.setBrush(Qt::NoBrush);
    painter.setPen(QPen(colorOf(curve), 1.8, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
    painter.drawPath(path);
}

void ToneCurvePlot::paintValues(QPainter& painter) const {
    CurvePlot::paintValues(painter);
    if (!m_average)
        return;
    const QRectF plot = area();
    const double stops = std::clamp(*m_average, -double{kStops}, double{kStops});
    const QPointF point = position(stops, valueAt(stops));
    const QColor color(tokens::kCopper);
    painter.setPen(QPen(color, 1.0, Qt::DashLine));
    painter.drawLine(QPointF(point.x(), plot.bottom()), point);
    painter.setPen(QPen(QColor(tokens::kWell), 1.5));
    painter.setBrush(color);
    painter.drawEllipse(point, 4.5, 4.5);

    // Beside the point, where there is room.
    const QFontMetricsF metrics(painter.font());
    const QString label = tr("average");
    const double w = metrics.horizontalAdvance(label);
    const double x = point.x() + 9.0 + w < plot.right() ? point.x() + 9.0 : point.x() - 9.0 - w;
    const double y = std::min(point.y() + metrics.ascent() + 5.0, plot.bottom() - 4.0);
    painter.setPen(color);
    painter.drawText(QPointF(x, y), label);
}

} // namespace patina::editor
