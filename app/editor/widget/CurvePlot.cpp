#include "app/editor/widget/CurvePlot.h"

#include "app/editor/style/Tokens.h"

#include <QMouseEvent>
#include <QPainterPath>
#include <algorithm>
#include <cmath>

namespace patina::editor {
namespace {
constexpr double kPad = 6.0;
constexpr double kMaxDecades = 7.0; // of a logarithmic axis
} // namespace

CurvePlot::CurvePlot(const QString& title, QWidget* parent)
    : QWidget(parent)
    , m_title(title) {
    setMouseTracking(true);
    setAccessibleName(title);
}

QSize CurvePlot::sizeHint() const {
    return {260, 200};
}
QSize CurvePlot::minimumSizeHint() const {
    return {140, 110};
}

void CurvePlot::setTitle(const QString& title) {
    m_title = title;
    update();
}

void CurvePlot::setAxes(const PlotAxes& axes) {
    m_axes = axes;
    fitRange();
    update();
}

void CurvePlot::setCurves(std::vector<PlotCurve> curves) {
    m_curves = std::move(curves);
    fitRange();
    update();
}

void CurvePlot::setMessage(const QString& message) {
    m_message = message;
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

void CurvePlot::setProbe(std::optional<double> x) {
    if (x == m_probe)
        return;
    m_probe = x;
    update();
}

void CurvePlot::fitRange() {
    double largest = 0.0, smallest = std::numeric_limits<double>::infinity();
    for (const PlotCurve& curve : m_curves)
        for (const QPointF& point : curve.points) {
            largest = std::max(largest, point.y());
            if (point.y() > 0.0)
                smallest = std::min(smallest, point.y());
        }
    if (largest <= 0.0) {
        m_yMin = m_axes.logarithmic ? 1e-3 : 0.0;
        m_yMax = 1.0;
        return;
    }
    if (m_axes.logarithmic) {
        const double top = std::ceil(std::log10(largest) - 1e-9);
        const double bottom =
            std::clamp(std::floor(std::log10(smallest)), top - kMaxDecades, top - 1.0);
        m_yMin = std::pow(10.0, bottom);
        m_yMax = std::pow(10.0, top);
        return;
    }
    // A fixed axis still shows what goes beyond it: an albedo above 1 must not hide.
    m_yMin = 0.0;
    if (m_axes.yMax && largest <= *m_axes.yMax * 1.1) {
        m_yMax = std::max(*m_axes.yMax * 1.04, largest * 1.02);
    } else {
        const std::vector<double> steps = roundSteps(0.0, largest * 1.05, 4);
        const double step = steps.size() > 1 ? steps[1] : largest;
        m_yMax = step * std::ceil(largest * 1.02 / step);
    }
}

std::vector<double> CurvePlot::yTicks() const {
    if (!m_axes.logarithmic)
        return roundSteps(m_yMin, m_yMax, height() < 170 ? 3 : 5);
    std::vector<double> ticks;
    const int decades = static_cast<int>(std::round(std::log10(m_yMax / m_yMin)));
    const int stride = std::max(1, decades / (height() < 170 ? 3 : 5));
    for (int i = 0; i <= decades; i += stride)
        ticks.push_back(m_yMax * std::pow(10.0, -i));
    return ticks;
}

QRectF CurvePlot::area() const {
    const QFontMetricsF metrics(plotFont(font()));
    double labels = 0.0;
    for (const double tick : yTicks())
        labels = std::max(labels, metrics.horizontalAdvance(plotNumber(tick)));
    const double left = kPad + labels + kPad, top = plotTitleHeight(font()) + 4.0;
    return {left, top, std::max(width() - left - 2.0 * kPad, 10.0),
            std::max(height() - top - metrics.height() - kPad - 3.0, 10.0)};
}

QPointF CurvePlot::position(double x, double y) const {
    const QRectF plot = area();
    const double t = m_axes.logarithmic
                         ? std::log(std::max(y, m_yMin * 0.5) / m_yMin) / std::log(m_yMax / m_yMin)
                         : (y - m_yMin) / (m_yMax - m_yMin);
    return {plot.left() + plot.width() * (x - m_axes.xMin) / (m_axes.xMax - m_axes.xMin),
            plot.bottom() - plot.height() * t};
}

QStringList CurvePlot::readout(double x) const {
    QStringList lines;
    for (const PlotCurve& curve : m_curves)
        lines << QStringLiteral("%1%2%3").arg(
            curve.name.isEmpty() ? QString() : curve.name + QStringLiteral("  "),
            plotNumber(plotPoint(curve.points, x).y()), m_axes.yUnit);
    return lines;
}

// --- Painting ------------------------------------------------------------------------------------

void CurvePlot::paintEvent(QPaintEvent*) {
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    paintPlotWell(painter, rect(), m_title);
    painter.setFont(plotFont(font()));
    if (!m_message.isEmpty()) {
        paintPlotMessage(painter, rect(), m_message);
        return;
    }
    paintAxes(painter);
    paintAxisNames(painter);
    const QRectF plot = area();
    painter.save();
    painter.setClipRect(plot.adjusted(-1.0, -4.0, 1.0, 2.0));
    // The first look is painted last: it is what the picture shows.
    for (auto curve = m_curves.rbegin(); curve != m_curves.rend(); ++curve)
        paintCurve(painter, *curve);
    painter.restore();
    paintKey(painter);
    paintProbe(painter);
}

void CurvePlot::paintAxes(QPainter& painter) const {
    const QRectF plot = area();
    const QFontMetricsF metrics(painter.font());
    const QColor line(tokens::kLine), text(tokens::kTextDim);
    double taken = plot.left() - 100.0; // numbers reach to here
    for (double x = m_axes.xMin; x <= m_axes.xMax + 1e-6; x += m_axes.xStep) {
        const double at = std::round(position(x, m_yMin).x()) + 0.5;
        painter.setPen(QPen(line, std::abs(x) < 1e-9 && m_axes.xMin < 0 ? 1.6 : 1.0));
        painter.drawLine(QPointF(at, plot.top()), QPointF(at, plot.bottom()));
        const QString number = plotNumber(x) + m_axes.xUnit;
        const double w = metrics.horizontalAdvance(number);
        const double from = std::clamp(at - w / 2, 0.0, width() - w - 3.0);
        if (from < taken + 4.0)
            continue;
        painter.setPen(text);
        painter.drawText(QPointF(from, plot.bottom() + 2.0 + metrics.ascent()), number);
        taken = from + w;
    }
    for (const double y : yTicks()) {
        const double at = std::round(position(m_axes.xMin, y).y()) + 0.5;
        painter.setPen(QPen(line, 1.0));
        painter.drawLine(QPointF(plot.left(), at), QPointF(plot.right(), at));
        const QString number = plotNumber(y);
        painter.setPen(text);
        painter.drawText(QPointF(plot.left() - kPad - metrics.horizontalAdvance(number),
                                 at + metrics.ascent() / 2 - 1.0),
                         number);
    }
    if (m_marker && *m_marker >= m_axes.xMin && *m_marker <= m_axes.xMax) {
        const double at = position(*m_marker, m_yMin).x();
        painter.setPen(QPen(QColor(tokens::kTextOff), 1.0, Qt::DashLine));
        painter.drawLine(QPointF(at, plot.top()), QPointF(at, plot.bottom()));
        const double w = metrics.horizontalAdvance(m_markerLabel);
        const bool right = at + 5.0 + w < plot.right();
        paintWords(painter, {right ? at + 5.0 : at - 5.0 - w, plot.top() + metrics.ascent() + 6.0},
                   m_markerLabel);
    }
}

// That of y beside the title; that of x between the last two numbers, or above them where these
// stand too close.
void CurvePlot::paintAxisNames(QPainter& painter) const {
    const QRectF plot = area();
    const QFontMetricsF metrics(painter.font());
    const QString y = m_axes.yUnit.trimmed().isEmpty()
                          ? m_axes.yName
                          : QStringLiteral("%1 [%2]").arg(m_axes.yName, m_axes.yUnit.trimmed());
    const double title = QFontMetricsF(font()).horizontalAdvance(m_title) + 20.0;
    const double w = metrics.horizontalAdvance(y);
    painter.setPen(QColor(tokens::kTextDim));
    if (width() - 8.0 - w > title)
        painter.drawText(QPointF(width() - 8.0 - w, 5.0 + QFontMetricsF(font()).ascent()), y);
    const double step = plot.width() * m_axes.xStep / (m_axes.xMax - m_axes.xMin);
    const double name = metrics.horizontalAdvance(m_axes.xName);
    const double number = metrics.horizontalAdvance(plotNumber(m_axes.xMax) + m_axes.xUnit);
    if (step > name + 1.6 * number + 8.0)
        painter.drawText(QPointF(plot.right() - (step + name) / 2 - 0.3 * number,
                                 plot.bottom() + 2.0 + metrics.ascent()),
                         m_axes.xName);
    else
        paintWords(painter, {plot.right() - name - 4.0, plot.bottom() - 5.0}, m_axes.xName);
}

// Words inside of the plot stand on its ground, not on lines.
void CurvePlot::paintWords(QPainter& painter, const QPointF& at, const QString& words) const {
    const QFontMetricsF metrics(painter.font());
    painter.fillRect(QRectF(at.x() - 2.0, at.y() - metrics.ascent(),
                            metrics.horizontalAdvance(words) + 4.0, metrics.height()),
                     QColor(tokens::kWell));
    painter.setPen(QColor(tokens::kTextDim));
    painter.drawText(at, words);
}

void CurvePlot::paintCurve(QPainter& painter, const PlotCurve& curve) const {
    QPen pen = plotPen(curve.look);
    if (curve.shape == CurveShape::Dots) {
        painter.setPen(QPen(plotColor(curve.look), 1.3));
        painter.setBrush(QColor(tokens::kWell));
        for (const QPointF& point : curve.points)
            painter.drawEllipse(position(point.x(), point.y()), 2.6, 2.6);
        return;
    }
    if (curve.shape == CurveShape::Thin) {
        pen = QPen(plotColor(curve.look), 1.0, Qt::CustomDashLine);
        pen.setDashPattern({2.0, 4.0});
    }
    QPainterPath path;
    bool first = true;
    for (const QPointF& point : curve.points) {
        const QPointF at = position(point.x(), point.y());
        if (first)
            path.moveTo(at);
        else
            path.lineTo(at);
        first = false;
    }
    painter.setPen(pen);
    painter.setBrush(Qt::NoBrush);
    painter.drawPath(path);
}

// In the lower left, or the upper left where curves run low.
void CurvePlot::paintKey(QPainter& painter) const {
    if (m_key.empty() || m_curves.empty())
        return;
    constexpr double kSample = 24.0;
    const QRectF plot = area();
    const QFontMetricsF metrics(painter.font());
    const double line = std::ceil(metrics.height());
    const double wanted = line * static_cast<double>(m_key.size());
    double lowest = m_yMax;
    for (const PlotCurve& curve : m_curves)
        for (const double share : {0.0, 0.25, 0.5})
            lowest = std::min(
                lowest,
                plotPoint(curve.points, m_axes.xMin + share * (m_axes.xMax - m_axes.xMin)).y());
    const bool below = position(m_axes.xMin, lowest).y() < plot.bottom() - wanted - 8.0;
    double y = below ? plot.bottom() - wanted - 4.0 : plot.top() + 2.0;
    for (const auto& [shape, text] : m_key) {
        const QPointF left(plot.left() + 6.0, y + line / 2);
        if (shape == CurveShape::Dots) {
            painter.setPen(QPen(QColor(tokens::kTextDim), 1.3));
            painter.setBrush(QColor(tokens::kWell));
            painter.drawEllipse(left + QPointF(kSample / 2 - 3.0, 0), 2.6, 2.6);
        } else {
            QPen pen(QColor(tokens::kTextDim), shape == CurveShape::Line ? 1.8 : 1.0);
            if (shape == CurveShape::Thin)
                pen.setDashPattern({2.0, 4.0});
            painter.setPen(pen);
            painter.drawLine(left, left + QPointF(kSample - 6.0, 0));
        }
        painter.setPen(QColor(tokens::kTextDim));
        painter.drawText(QPointF(left.x() + kSample, y + metrics.ascent()), text);
        y += line;
    }
}

void CurvePlot::paintProbe(QPainter& painter) const {
    if (!m_probe || *m_probe < m_axes.xMin || *m_probe > m_axes.xMax)
        return;
    const QRectF plot = area();
    const double x = position(*m_probe, m_yMin).x();
    QColor line(tokens::kText);
    line.setAlpha(110);
    painter.setPen(QPen(line, 1.0));
    painter.drawLine(QPointF(x, plot.top()), QPointF(x, plot.bottom()));
    std::vector<ReadoutRow> rows;
    const QStringList texts = readout(*m_probe);
    for (std::size_t i = 0; i < m_curves.size(); ++i) {
        const PlotCurve& curve = m_curves[i];
        rows.push_back({curve.look, texts[static_cast<int>(i)]});
        if (curve.shape == CurveShape::Dots)
            continue;
        const QPointF at = position(*m_probe, plotPoint(curve.points, *m_probe).y());
        if (!plot.adjusted(-2, -2, 2, 2).contains(at))
            continue;
        painter.setPen(QPen(QColor(tokens::kWell), 1.5));
        painter.setBrush(plotColor(curve.look));
        painter.drawEllipse(at, 3.5, 3.5);
    }
    if (m_hovered)
        paintReadout(
            painter, QRectF(rect()).adjusted(2, 2, -2, -2), {x, plot.top() + plot.height() / 2},
            QStringLiteral("%1 = %2%3").arg(m_axes.xName, plotNumber(*m_probe), m_axes.xUnit),
            rows);
}

void CurvePlot::mouseMoveEvent(QMouseEvent* event) {
    const QRectF plot = area();
    const double t = std::clamp((event->position().x() - plot.left()) / plot.width(), 0.0, 1.0);
    m_hovered = true;
    // Tenths of a degree: numbers that can be read and found again.
    Q_EMIT probed(std::round(10.0 * (m_axes.xMin + t * (m_axes.xMax - m_axes.xMin))) / 10.0);
}

void CurvePlot::leaveEvent(QEvent*) {
    m_hovered = false;
    Q_EMIT probed(std::nullopt);
    update();
}

} // namespace patina::editor
