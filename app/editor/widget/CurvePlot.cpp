#include "app/editor/widget/CurvePlot.h"

#include "app/editor/style/Tokens.h"

#include <QPainterPath>
#include <algorithm>
#include <cmath>
#include <limits>

namespace patina::editor {
namespace {
constexpr double kMaxDecades = 7.0; // of a logarithmic axis
} // namespace

QPen curvePen(CurveShape shape, int look) {
    if (shape == CurveShape::Line)
        return plotPen(look);
    if (shape == CurveShape::Dots)
        return {plotColor(look), 1.3};
    QPen pen(plotColor(look), 1.0, Qt::CustomDashLine);
    pen.setDashPattern({2.0, 4.0});
    return pen;
}

CurvePlot::CurvePlot(const QString& title, QWidget* parent, Press press)
    : PlotFrame(title, Cursor::Across, press, parent) {}

void CurvePlot::setAxes(const PlotAxis& x, const PlotAxis& y, std::optional<double> yMax) {
    PlotFrame::setAxes({x, y});
    m_yMax = yMax;
    fitRange();
}

void CurvePlot::setCurves(std::vector<PlotCurve> curves) {
    m_curves = std::move(curves);
    fitRange();
    update();
}

void CurvePlot::setKey(std::vector<std::pair<CurveShape, QString>> key) {
    m_key = std::move(key);
    update();
}

void CurvePlot::setMarker(std::optional<double> x, const QString& label) {
    m_marker = x;
    m_markerLabel = label;
    update();
}

void CurvePlot::fitRange() {
    double largest = 0.0, smallest = std::numeric_limits<double>::infinity();
    for (const PlotCurve& curve : m_curves)
        for (const QPointF& point : curve.points) {
            if (!std::isfinite(point.y()))
                continue;
            largest = std::max(largest, point.y());
            if (point.y() > 0.0)
                smallest = std::min(smallest, point.y());
        }
    PlotAxis& y = m_axes[1];
    if (largest <= 0.0) {
        y.min = y.logarithmic ? 1e-3 : 0.0;
        y.max = 1.0;
        return;
    }
    if (y.logarithmic) {
        const double top = std::ceil(std::log10(largest) - 1e-9);
        const double bottom =
            std::clamp(std::floor(std::log10(smallest)), top - kMaxDecades, top - 1.0);
        y.min = std::pow(10.0, bottom);
        y.max = std::pow(10.0, top);
        return;
    }
    // A fixed axis still shows what goes beyond it: an albedo above 1 must not hide.
    y.min = 0.0;
    if (m_yMax && largest <= *m_yMax * 1.1) {
        y.max = std::max(*m_yMax * 1.04, largest * 1.02);
    } else {
        const std::vector<double> steps = roundSteps(0.0, largest * 1.05, 4);
        const double step = steps.size() > 1 ? steps[1] : largest;
        y.max = step * std::ceil(largest * 1.02 / step);
    }
}

// --- Reading -------------------------------------------------------------------------------------

QStringList CurvePlot::readout(double x) const {
    QStringList lines;
    for (const ReadoutRow& row : readoutAt({x, 0.0}).rows)
        lines << row.text;
    return lines;
}

std::vector<PlotValue> CurvePlot::valuesAt(const QPointF& place) const {
    std::vector<PlotValue> values;
    for (const PlotCurve& curve : m_curves)
        values.push_back({curve.name,
                          {plotPoint(curve.points, place.x()).y()},
                          m_curves.size() > 1 ? curve.look : -1});
    return values;
}

std::vector<QPointF> CurvePlot::places() const {
    return m_curves.empty() ? std::vector<QPointF>() : m_curves.front().points;
}

QPointF CurvePlot::startPlace() const {
    return {m_axes[0].rounded(m_marker.value_or(m_axes[0].value(0.5))), 0.0};
}

// --- Painting ------------------------------------------------------------------------------------

void CurvePlot::paintValues(QPainter& painter) const {
    paintAxes(painter);
    paintMarker(painter);
    painter.save();
    painter.setClipRect(area().adjusted(-1.0, -4.0, 1.0, 2.0));
    // The first look is painted last: it is what the picture shows.
    for (auto curve = m_curves.rbegin(); curve != m_curves.rend(); ++curve)
        paintCurve(painter, *curve);
    painter.restore();
    paintKey(painter);
}

void CurvePlot::paintMarker(QPainter& painter) const {
    if (!m_marker || *m_marker < m_axes[0].min || *m_marker > m_axes[0].max)
        return;
    const QRectF plot = area();
    const QFontMetricsF metrics(painter.font());
    const double at = pointOf({*m_marker, m_axes[1].min}).x();
    painter.setPen(QPen(QColor(tokens::kTextOff), 1.0, Qt::DashLine));
    painter.drawLine(QPointF(at, plot.top()), QPointF(at, plot.bottom()));
    const double w = metrics.horizontalAdvance(m_markerLabel);
    const bool right = at + 5.0 + w < plot.right();
    paintWords(painter, {right ? at + 5.0 : at - 5.0 - w, plot.top() + metrics.ascent() + 6.0},
               m_markerLabel);
}

QPainterPath CurvePlot::pathOf(const PlotCurve& curve) const {
    QPainterPath path;
    bool inside = false;
    for (const QPointF& point : curve.points) {
        const bool finite = std::isfinite(point.y());
        if (finite && inside)
            path.lineTo(pointOf(point));
        else if (finite)
            path.moveTo(pointOf(point));
        inside = finite;
    }
    return path;
}

void CurvePlot::paintCurve(QPainter& painter, const PlotCurve& curve) const {
    painter.setPen(curvePen(curve.shape, curve.look));
    if (curve.shape == CurveShape::Dots) {
        painter.setBrush(QColor(tokens::kWell));
        for (const QPointF& point : curve.points)
            if (std::isfinite(point.y()))
                painter.drawEllipse(pointOf(point), 2.6, 2.6);
        return;
    }
    painter.setBrush(Qt::NoBrush);
    painter.drawPath(pathOf(curve));
}

// In the lower left, or the upper left where curves run low.
void CurvePlot::paintKey(QPainter& painter) const {
    if (m_key.empty())
        return;
    constexpr double kSample = 24.0;
    const QRectF plot = area();
    const QFontMetricsF metrics(painter.font());
    const double line = std::ceil(metrics.height());
    const double wanted = line * static_cast<double>(m_key.size());
    double lowest = m_axes[1].max;
    for (const PlotCurve& curve : m_curves)
        for (const double share : {0.0, 0.25, 0.5})
            lowest = std::min(lowest, plotPoint(curve.points, m_axes[0].value(share)).y());
    const bool below = pointOf({m_axes[0].min, lowest}).y() < plot.bottom() - wanted - 8.0;
    double y = below ? plot.bottom() - wanted - 4.0 : plot.top() + 2.0;
    for (const auto& [shape, text] : m_key) {
        const QPointF left(plot.left() + 6.0, y + line / 2);
        QPen pen = curvePen(shape, 0);
        pen.setColor(QColor(tokens::kTextDim));
        painter.setPen(pen);
        painter.setBrush(QColor(tokens::kWell));
        if (shape == CurveShape::Dots)
            painter.drawEllipse(left + QPointF(kSample / 2 - 3.0, 0), 2.6, 2.6);
        else
            painter.drawLine(left, left + QPointF(kSample - 6.0, 0));
        painter.setPen(QColor(tokens::kTextDim));
        painter.drawText(QPointF(left.x() + kSample, y + metrics.ascent()), text);
        y += line;
    }
}

void CurvePlot::paintProbe(QPainter& painter, const QPointF& place) const {
    if (place.x() < m_axes[0].min || place.x() > m_axes[0].max)
        return;
    PlotFrame::paintProbe(painter, place);
    paintDots(painter, place.x());
}

QColor CurvePlot::colorOf(const PlotCurve& curve) const {
    return plotColor(curve.look);
}

void CurvePlot::paintDots(QPainter& painter, double x) const {
    for (const PlotCurve& curve : m_curves) {
        const double y = plotPoint(curve.points, x).y();
        if (curve.shape == CurveShape::Dots || !std::isfinite(y))
            continue;
        const QPointF at = pointOf({x, y});
        if (!area().adjusted(-2, -2, 2, 2).contains(at))
            continue;
        painter.setPen(QPen(QColor(tokens::kWell), 1.5));
        painter.setBrush(colorOf(curve));
        painter.drawEllipse(at, 3.5, 3.5);
    }
}

} // namespace patina::editor
