#include "app/editor/widget/PolarPlot.h"

#include "app/editor/style/Tokens.h"

#include <QPainterPath>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace patina::editor {
namespace {

constexpr double kPolarPad = 6.0;
constexpr double kNumberGap = 9.0; // between the rim and the numbers of angles

double radians(double degrees) {
    return degrees * std::numbers::pi / 180.0;
}

PlotAxis viewerAxis() {
    return {QStringLiteral("θₒ"), QStringLiteral("°"), -90.0, 90.0, 30.0};
}

} // namespace

PolarPlot::PolarPlot(const QString& title, QWidget* parent)
    : CurvePlot(title, parent, Press::Drags) {
    setAxes(viewerAxis(), {});
    setHelp(tr("Which way light goes. Drag to turn the light about the point, or use Alt with the "
               "arrow keys."));
}

void PolarPlot::setCurves(std::vector<PlotCurve> curves, double peak, bool logarithmic,
                          double decades) {
    m_peak = peak;
    m_logarithmic = logarithmic;
    m_decades = decades;
    CurvePlot::setCurves(std::move(curves));
}

void PolarPlot::setQuantity(const QString& name, const QString& unit) {
    setAxes(viewerAxis(), {name, unit});
}

void PolarPlot::setIncidence(double degrees) {
    m_incidence = degrees;
    update();
}

PolarPlot::Dial PolarPlot::dial() const {
    const QFontMetricsF metrics(plotFont(font()));
    const double number = metrics.horizontalAdvance(QStringLiteral("60°"));
    const double top = plotTitleHeight(font()) + metrics.height() + 2.0;
    const double bottom = metrics.height() + kPolarPad; // numbers along the surface
    // Beside the rim stand the numbers of 60°; those of 90° stand below its ends.
    const double wide =
        std::min((width() / 2.0 - kPolarPad - number) / std::sin(radians(60.0)) - kNumberGap,
                 width() / 2.0 - kPolarPad - number / 2.0);
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

QPointF PolarPlot::pointOf(const QPointF& place) const {
    return onDial(place.x(), radiusOf(place.y()));
}

std::optional<QPointF> PolarPlot::placeAt(const QPointF& point) const {
    const QPointF way = point - dial().center;
    const double degrees = std::atan2(way.x(), std::max(-way.y(), 0.0)) * 180.0 / std::numbers::pi;
    return QPointF(axes()[0].rounded(degrees), 0.0);
}

QRectF PolarPlot::area() const {
    const Dial d = dial();
    return {d.center.x() - d.radius, d.center.y() - d.radius, 2.0 * d.radius, d.radius};
}

QPointF PolarPlot::readoutPoint(const QPointF& place) const {
    return onDial(place.x(), 0.6);
}

QPointF PolarPlot::startPlace() const {
    return {axes()[0].rounded(m_incidence), 0.0}; // the mirror direction
}

QPointF PolarPlot::lightPosition() const {
    return onDial(-m_incidence, 1.0);
}

// --- The light -----------------------------------------------------------------------------------

bool PolarPlot::pick(const QPointF& place, Qt::KeyboardModifiers) {
    Q_EMIT incidenceDragged(std::abs(place.x()));
    return true;
}

// The light stands on the left: the left arrow takes it away from the normal.
bool PolarPlot::moveHandle(const QPointF& way) {
    if (way.x() != 0.0)
        Q_EMIT incidenceDragged(std::clamp(m_incidence - way.x(), 0.0, 90.0));
    return way.x() != 0.0;
}

// --- Painting ------------------------------------------------------------------------------------

void PolarPlot::paintValues(QPainter& painter) const {
    paintDial(painter);
    for (auto curve = curves().rbegin(); curve != curves().rend(); ++curve)
        paintCurve(painter, *curve);
    paintLight(painter);
}

void PolarPlot::paintCurve(QPainter& painter, const PlotCurve& curve) const {
    QPainterPath path(dial().center);
    path.connectPath(pathOf(curve));
    path.closeSubpath();
    QColor fill = plotColor(curve.look);
    fill.setAlpha(curve.look == 0 ? 46 : 18);
    painter.fillPath(path, fill);
    painter.setPen(plotPen(curve.look));
    painter.setBrush(Qt::NoBrush);
    painter.drawPath(path);
}

// At round values.
std::vector<double> PolarPlot::rings() const {
    std::vector<double> rings;
    if (m_logarithmic) {
        for (double v = std::pow(10.0, std::floor(std::log10(std::max(m_peak, 1e-30))));
             radiusOf(v) > 0.02; v /= 10.0)
            rings.push_back(v);
        return rings;
    }
    for (const double v : roundSteps(0.0, m_peak, 3))
        if (v > 0.0)
            rings.push_back(v);
    std::reverse(rings.begin(), rings.end());
    return rings;
}

void PolarPlot::paintDial(QPainter& painter) const {
    const Dial d = dial();
    const QFontMetricsF metrics(painter.font());
    const QColor line(tokens::kLine), text(tokens::kTextDim);

    painter.setBrush(Qt::NoBrush);
    const auto arc = [&](double radius) {
        const double r = d.radius * radius;
        painter.drawArc(QRectF(d.center.x() - r, d.center.y() - r, 2 * r, 2 * r), 0, 180 * 16);
    };
    painter.setPen(QPen(line, 1.4));
    arc(1.0);
    // The angles' own numbers stand at the ends of the surface.
    double taken = d.center.x() + d.radius - metrics.horizontalAdvance(QStringLiteral("90°")) / 2.0;
    // Numbers of rings stand along the surface where they do not touch.
    for (const double value : rings()) {
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
}

void PolarPlot::paintLight(QPainter& painter) const {
    const Dial d = dial();
    painter.setPen(QPen(QColor(tokens::kTextOff), 1.0, Qt::DashLine));
    painter.drawLine(d.center, onDial(m_incidence, 1.0));
    const QColor sun(kPlotSun);
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

void PolarPlot::paintProbe(QPainter& painter, const QPointF& place) const {
    if (std::abs(place.x()) > 90.0)
        return;
    QColor line(tokens::kText);
    line.setAlpha(110);
    painter.setPen(QPen(line, 1.0));
    painter.drawLine(dial().center, onDial(place.x(), 1.0));
    for (const PlotCurve& curve : curves()) {
        painter.setPen(QPen(QColor(tokens::kWell), 1.5));
        painter.setBrush(plotColor(curve.look));
        painter.drawEllipse(pointOf(plotPoint(curve.points, place.x())), 3.5, 3.5);
    }
}

} // namespace patina::editor
