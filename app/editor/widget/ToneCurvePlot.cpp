#include "app/editor/widget/ToneCurvePlot.h"

#include "app/editor/style/Tokens.h"

#include <QHelpEvent>
#include <QPainter>
#include <QPainterPath>
#include <QToolTip>
#include <algorithm>
#include <cmath>

namespace patina::editor {
namespace {

constexpr int kHeight = 152;
constexpr double kPad = 6.0;

QString signedNumber(double value, int decimals = 0) {
    const QString digits = QString::number(std::abs(value), 'f', decimals);
    return value < 0 ? QStringLiteral("−") + digits : QStringLiteral("+") + digits;
}

QString percentText(int percent) {
    return QStringLiteral("%1 %").arg(percent);
}

QFont smallFont(const QFont& font) {
    QFont small = font;
    small.setPointSizeF(font.pointSizeF() * 0.85);
    return small;
}

} // namespace

ToneCurvePlot::ToneCurvePlot(QWidget* parent)
    : QWidget(parent)
    , m_values{0.0f, 1.0f} {
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
    setAccessibleName(tr("Tone curve"));
    setAccessibleDescription(
        tr("What the display is sent for light from 8 stops below to 8 above middle grey."));
    setStatusTip(accessibleDescription());
}

void ToneCurvePlot::setCurve(std::vector<float> values) {
    if (values == m_values || values.size() < 2)
        return;
    m_values = std::move(values);
    update();
}

void ToneCurvePlot::setAverage(std::optional<double> stops) {
    if (stops == m_average)
        return;
    m_average = stops;
    update();
}

double ToneCurvePlot::valueAt(double stops) const {
    const double x = std::clamp((stops + kStops) / (2.0 * kStops), 0.0, 1.0) *
                     static_cast<double>(m_values.size() - 1);
    const auto i = std::min(static_cast<std::size_t>(x), m_values.size() - 2);
    const double t = x - static_cast<double>(i);
    return (1.0 - t) * static_cast<double>(m_values[i]) + t * static_cast<double>(m_values[i + 1]);
}

QSize ToneCurvePlot::sizeHint() const {
    return {240, kHeight};
}
QSize ToneCurvePlot::minimumSizeHint() const {
    return {160, kHeight};
}

QRectF ToneCurvePlot::plotArea() const {
    const QFontMetricsF metrics(smallFont(font()));
    const double left = kPad + metrics.horizontalAdvance(percentText(100)) + kPad;
    const double bottom = kPad + metrics.height() + 2.0;
    return QRectF(left, kPad + 4.0, width() - left - 2.0 * kPad, height() - bottom - kPad - 4.0);
}

QPointF ToneCurvePlot::position(double stops, double value) const {
    const QRectF area = plotArea();
    return {area.left() + area.width() * (stops + kStops) / (2.0 * kStops),
            area.bottom() - area.height() * value};
}

void ToneCurvePlot::paintEvent(QPaintEvent*) {
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(Qt::NoPen);
    painter.setBrush(QColor(tokens::kWell));
    painter.drawRoundedRect(rect(), tokens::kRadius, tokens::kRadius);
    paintGrid(painter);
    paintCurve(painter);
    paintAverage(painter);
}

void ToneCurvePlot::paintGrid(QPainter& painter) const {
    const QRectF area = plotArea();
    painter.setFont(smallFont(font()));
    const QFontMetricsF metrics(painter.font());
    const QColor line(tokens::kLine), text(tokens::kTextDim);

    // Every second stop has a line, every fourth a number.
    for (int stops = -kStops; stops <= kStops; stops += 2) {
        const double x = std::round(position(stops, 0).x()) + 0.5;
        painter.setPen(QPen(line, stops == 0 ? 1.6 : 1.0));
        painter.drawLine(QPointF(x, area.top()), QPointF(x, area.bottom()));
        if (stops % 4 != 0)
            continue;
        const QString label = stops == 0 ? tr("0 EV") : signedNumber(stops);
        const double w = metrics.horizontalAdvance(label);
        painter.setPen(text);
        painter.drawText(QPointF(std::clamp(x - w / 2, 0.0, width() - w - 2.0),
                                 area.bottom() + 2.0 + metrics.ascent()),
                         label);
    }
    for (const int percent : {0, 25, 50, 75, 100}) {
        const double y = std::round(position(0, percent / 100.0).y()) + 0.5;
        painter.setPen(QPen(line, 1.0));
        painter.drawLine(QPointF(area.left(), y), QPointF(area.right(), y));
        if (percent % 50 != 0)
            continue;
        const QString label = percentText(percent);
        painter.setPen(text);
        painter.drawText(QPointF(area.left() - kPad - metrics.horizontalAdvance(label),
                                 y + metrics.ascent() / 2 - 1.0),
                         label);
    }
}

void ToneCurvePlot::paintCurve(QPainter& painter) const {
    const QRectF area = plotArea();
    QPainterPath path;
    const int steps = std::max(2, static_cast<int>(area.width() * devicePixelRatioF()));
    for (int i = 0; i <= steps; ++i) {
        const double stops = kStops * (2.0 * i / steps - 1.0);
        const QPointF point = position(stops, valueAt(stops));
        if (i == 0)
            path.moveTo(point);
        else
            path.lineTo(point);
    }
    QPainterPath filled = path;
    filled.lineTo(area.bottomRight());
    filled.lineTo(area.bottomLeft());
    filled.closeSubpath();
    QColor under(tokens::kAccentDeep);
    under.setAlpha(90);
    painter.fillPath(filled, under);
    painter.setBrush(Qt::NoBrush);
    painter.setPen(QPen(QColor(tokens::kAccent), 1.8, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
    painter.drawPath(path);
}

void ToneCurvePlot::paintAverage(QPainter& painter) const {
    if (!m_average)
        return;
    const QRectF area = plotArea();
    const double stops = std::clamp(*m_average, -double{kStops}, double{kStops});
    const QPointF point = position(stops, valueAt(stops));
    const QColor color(tokens::kCopper);
    painter.setPen(QPen(color, 1.0, Qt::DashLine));
    painter.drawLine(QPointF(point.x(), area.bottom()), point);
    painter.setPen(QPen(QColor(tokens::kWell), 1.5));
    painter.setBrush(color);
    painter.drawEllipse(point, 4.5, 4.5);

    // Beside the point, where there is room.
    painter.setFont(smallFont(font()));
    const QFontMetricsF metrics(painter.font());
    const QString label = tr("average");
    const double w = metrics.horizontalAdvance(label);
    const double x = point.x() + 9.0 + w < area.right() ? point.x() + 9.0 : point.x() - 9.0 - w;
    const double y = std::min(point.y() + metrics.ascent() + 5.0, area.bottom() - 4.0);
    painter.setPen(color);
    painter.drawText(QPointF(x, y), label);
}

bool ToneCurvePlot::event(QEvent* event) {
    if (event->type() != QEvent::ToolTip)
        return QWidget::event(event);
    const auto* help = static_cast<QHelpEvent*>(event);
    const QRectF area = plotArea();
    const double stops =
        std::clamp((help->pos().x() - area.left()) / area.width(), 0.0, 1.0) * 2.0 * kStops -
        kStops;
    QToolTip::showText(help->globalPos(),
                       tr("Light %1 EV from middle grey is shown as %2 % of the display's range.")
                           .arg(signedNumber(stops, 1))
                           .arg(100.0 * valueAt(stops), 0, 'f', 1),
                       this);
    return true;
}

} // namespace patina::editor
