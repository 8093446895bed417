#include "app/editor/widget/PolarPlot.h"

#include "app/editor/style/FocusRing.h"
#include "app/editor/style/Tokens.h"

#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainterPath>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace patina::editor {
namespace {

constexpr double kPad = 6.0;
constexpr double kNumberGap = 9.0; // between the rim and the numbers of angles
constexpr QRgb kSun = 0xfffff0b8;

double radians(double degrees) {
    return degrees * std::numbers::pi / 180.0;
}

} // namespace

PolarPlot::PolarPlot(const QString& title, QWidget* parent)
    : QWidget(parent)
    , m_title(title) {
    setMouseTracking(true);
    setFocusPolicy(Qt::StrongFocus);
    setAccessibleName(title);
    setAccessibleDescription(
        tr("Which way light goes. Drag to turn the light about the point, or use the arrow keys."));
    setStatusTip(accessibleDescription());
}

QSize PolarPlot::sizeHint() const {
    return {260, 200};
}
QSize PolarPlot::minimumSizeHint() const {
    return {140, 110};
}

void PolarPlot::setCurves(std::vector<PlotCurve> curves, double peak, bool logarithmic,
                          double decades) {
    m_curves = std::move(curves);
    m_peak = peak;
    m_logarithmic = logarithmic;
    m_decades = decades;
    update();
}

void PolarPlot::setQuantity(const QString& name, const QString& unit) {
    m_name = name;
    m_unit = unit;
    update();
}

void PolarPlot::setIncidence(double degrees) {
    m_incidence = degrees;
    update();
}

void PolarPlot::setProbe(std::optional<double> degrees) {
    if (degrees == m_probe)
        return;
    m_probe = degrees;
    update();
}

void PolarPlot::setMessage(const QString& message) {
    m_message = message;
    update();
}

PolarPlot::Dial PolarPlot::dial() const {
    const QFontMetricsF metrics(plotFont(font()));
    const double number = metrics.horizontalAdvance(QStringLiteral("60°"));
    const double top = plotTitleHeight(font()) + metrics.height() + 2.0;
    const double bottom = metrics.height() + kPad; // numbers along the surface
    // Beside the rim stand the numbers of 60°; those of 90° stand below its ends.
    const double wide =
        std::min((width() / 2.0 - kPad - number) / std::sin(radians(60.0)) - kNumberGap,
                 width() / 2.0 - kPad - number / 2.0);
    const double radius = std::max(std::min(wide, height() - top - bottom), 10.0);
    const double spare = height() - top - bottom - radius;
    return {{width() / 2.0, top + radius + std::max(spare, 0.0) / 2.0}, radius};
}

double PolarPlot::radiusOf(double value) const {
    if (!(value > 0.0) || !(m_peak > 0.0))
        return 0.0;
    if (m_logarithmic)
        return std::clamp(1.0 + std::log10(value / m_peak) / m_decades, 0.0, 1.2);
    return std::min(value / m_peak, 1.2);
}

QPointF PolarPlot::onDial(double degrees, double radius) const {
    const Dial d = dial();
    return d.center +
           d.radius * radius * QPointF(std::sin(radians(degrees)), -std::cos(radians(degrees)));
}

QPointF PolarPlot::position(double degrees, double value) const {
    return onDial(degrees, radiusOf(value));
}

QPointF PolarPlot::lightPosition() const {
    return onDial(-m_incidence, 1.0);
}

double PolarPlot::angleAt(const QPointF& point) const {
    const QPointF way = point - dial().center;
    const double degrees = std::atan2(way.x(), std::max(-way.y(), 0.0)) * 180.0 / std::numbers::pi;
    return std::round(10.0 * degrees) / 10.0;
}

QStringList PolarPlot::readout(double degrees) const {
    QStringList lines;
    for (const PlotCurve& curve : m_curves)
        lines << QStringLiteral("%1%2%3").arg(
            curve.name.isEmpty() ? QString() : curve.name + QStringLiteral("  "),
            plotNumber(plotPoint(curve.points, degrees).y()), m_unit);
    return lines;
}

// --- Painting ------------------------------------------------------------------------------------

void PolarPlot::paintEvent(QPaintEvent*) {
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    paintPlotWell(painter, rect(), m_title);
    painter.setFont(plotFont(font()));
    if (!m_message.isEmpty()) {
        paintPlotMessage(painter, rect(), m_message);
        return;
    }
    paintDial(painter);
    for (auto curve = m_curves.rbegin(); curve != m_curves.rend(); ++curve) {
        QPainterPath path(dial().center);
        for (const QPointF& point : curve->points)
            path.lineTo(position(point.x(), point.y()));
        path.closeSubpath();
        QColor fill = plotColor(curve->look);
        fill.setAlpha(curve->look == 0 ? 46 : 18);
        painter.fillPath(path, fill);
        painter.setPen(plotPen(curve->look));
        painter.setBrush(Qt::NoBrush);
        painter.drawPath(path);
    }
    paintLight(painter);
    paintProbe(painter);
    if (hasFocus()) {
        painter.setPen(QColor(tokens::kFocus));
        painter.setBrush(Qt::NoBrush);
        painter.drawRoundedRect(QRectF(rect()).adjusted(0.5, 0.5, -0.5, -0.5), tokens::kRadius,
                                tokens::kRadius);
    }
}

void PolarPlot::paintDial(QPainter& painter) const {
    const Dial d = dial();
    const QFontMetricsF metrics(painter.font());
    const QColor line(tokens::kLine), text(tokens::kTextDim);

    // Rings at round values, with numbers along the surface where they do not touch.
    std::vector<double> rings;
    if (m_logarithmic) {
        for (double v = std::pow(10.0, std::floor(std::log10(std::max(m_peak, 1e-30))));
             radiusOf(v) > 0.02; v /= 10.0)
            rings.push_back(v);
    } else {
        for (const double v : roundSteps(0.0, m_peak, 3))
            if (v > 0.0)
                rings.push_back(v);
        std::reverse(rings.begin(), rings.end());
    }
    painter.setBrush(Qt::NoBrush);
    const auto arc = [&](double radius) {
        const double r = d.radius * radius;
        painter.drawArc(QRectF(d.center.x() - r, d.center.y() - r, 2 * r, 2 * r), 0, 180 * 16);
    };
    painter.setPen(QPen(line, 1.4));
    arc(1.0);
    // The angles' own numbers stand at the ends of the surface.
    double taken = d.center.x() + d.radius - metrics.horizontalAdvance(QStringLiteral("90°")) / 2.0;
    for (const double value : rings) {
        painter.setPen(QPen(line, 1.0));
        arc(radiusOf(value));
        const QString label = plotNumber(value);
        const double w = metrics.horizontalAdvance(label);
        const double x = d.center.x() + d.radius * radiusOf(value) - w / 2;
        if (x + w > taken - 6.0 || x < d.center.x() + 4.0)
            continue;
        painter.setPen(text);
        painter.drawText(QPointF(x, d.center.y() + 2.0 + metrics.ascent()), label);
        taken = x;
    }
    for (int degrees = -90; degrees <= 90; degrees += 30) {
        painter.setPen(QPen(line, degrees == 0 ? 1.4 : 1.0));
        painter.drawLine(d.center, onDial(degrees, 1.0));
        const QString label = QStringLiteral("%1°").arg(std::abs(degrees));
        const double w = metrics.horizontalAdvance(label);
        painter.setPen(text);
        if (std::abs(degrees) == 90) {
            painter.drawText(
                QPointF(onDial(degrees, 1.0).x() - w / 2, d.center.y() + 2.0 + metrics.ascent()),
                label);
            continue;
        }
        const QPointF at = onDial(degrees, 1.0 + kNumberGap / d.radius);
        const double x = at.x() - w * (0.5 - 0.5 * std::sin(radians(degrees)));
        painter.drawText(QPointF(x, at.y() + metrics.ascent() / 2 - 2.0), label);
    }
    painter.setPen(QPen(QColor(tokens::kTextOff), 1.4));
    painter.drawLine(onDial(-90, 1.0), onDial(90, 1.0));
    const QString quantity = m_unit.trimmed().isEmpty()
                                 ? m_name
                                 : QStringLiteral("%1 [%2]").arg(m_name, m_unit.trimmed());
    const double w = metrics.horizontalAdvance(quantity);
    painter.setPen(text);
    if (width() - 8.0 - w > QFontMetricsF(font()).horizontalAdvance(m_title) + 20.0)
        painter.drawText(QPointF(width() - 8.0 - w, 5.0 + QFontMetricsF(font()).ascent()),
                         quantity);
}

void PolarPlot::paintLight(QPainter& painter) const {
    const Dial d = dial();
    painter.setPen(QPen(QColor(tokens::kTextOff), 1.0, Qt::DashLine));
    painter.drawLine(d.center, onDial(m_incidence, 1.0));
    const QColor sun(kSun);
    painter.setPen(QPen(sun, 1.5));
    painter.drawLine(lightPosition(), d.center);
    // The head of an arrow into the point.
    const QPointF tip = onDial(-m_incidence, 14.0 / d.radius);
    const QPointF along = (d.center - lightPosition()) / d.radius;
    const QPointF across(-along.y(), along.x());
    QPainterPath head(tip + along * 8.0);
    head.lineTo(tip + across * 3.5);
    head.lineTo(tip - across * 3.5);
    head.closeSubpath();
    painter.fillPath(head, sun);
    painter.setPen(QPen(QColor(tokens::kWell), 1.5));
    painter.setBrush(sun);
    painter.drawEllipse(lightPosition(), 5.5, 5.5);
}

void PolarPlot::paintProbe(QPainter& painter) const {
    if (!m_probe || m_dragging || std::abs(*m_probe) > 90.0)
        return;
    QColor line(tokens::kText);
    line.setAlpha(110);
    painter.setPen(QPen(line, 1.0));
    painter.drawLine(dial().center, onDial(*m_probe, 1.0));
    std::vector<ReadoutRow> rows;
    const QStringList texts = readout(*m_probe);
    for (std::size_t i = 0; i < m_curves.size(); ++i) {
        rows.push_back({m_curves[i].look, texts[static_cast<int>(i)]});
        painter.setPen(QPen(QColor(tokens::kWell), 1.5));
        painter.setBrush(plotColor(m_curves[i].look));
        painter.drawEllipse(position(*m_probe, plotPoint(m_curves[i].points, *m_probe).y()), 3.5,
                            3.5);
    }
    if (m_hovered)
        paintReadout(painter, QRectF(rect()).adjusted(2, 2, -2, -2), onDial(*m_probe, 0.6),
                     QStringLiteral("θo = %1°").arg(plotNumber(*m_probe)), rows);
}

// --- The hand ------------------------------------------------------------------------------------

void PolarPlot::mousePressEvent(QMouseEvent* event) {
    if (event->button() != Qt::LeftButton || !m_message.isEmpty())
        return;
    m_dragging = true;
    Q_EMIT incidenceDragged(std::abs(angleAt(event->position())));
}

void PolarPlot::mouseMoveEvent(QMouseEvent* event) {
    m_hovered = true;
    if (m_dragging)
        Q_EMIT incidenceDragged(std::abs(angleAt(event->position())));
    else
        Q_EMIT probed(angleAt(event->position()));
}

void PolarPlot::mouseReleaseEvent(QMouseEvent*) {
    m_dragging = false;
    update();
}

void PolarPlot::leaveEvent(QEvent*) {
    m_hovered = false;
    Q_EMIT probed(std::nullopt);
    update();
}

void PolarPlot::keyPressEvent(QKeyEvent* event) {
    const double step = event->modifiers() & Qt::ShiftModifier ? 10.0 : 1.0;
    // The light stands on the left: the left arrow takes it away from the normal.
    if (event->key() == Qt::Key_Left)
        Q_EMIT incidenceDragged(std::min(m_incidence + step, 90.0));
    else if (event->key() == Qt::Key_Right)
        Q_EMIT incidenceDragged(std::max(m_incidence - step, 0.0));
    else
        QWidget::keyPressEvent(event);
}

} // namespace patina::editor
