#include "app/editor/widget/EnergyMap.h"

#include "app/editor/style/Tokens.h"
#include "app/editor/widget/PlotStyle.h"
#include "core/image/ColorMap.h"

#include <QHelpEvent>
#include <QMouseEvent>
#include <QToolTip>
#include <algorithm>
#include <cmath>

namespace patina::editor {
namespace {

constexpr double kPad = 6.0;
constexpr double kScaleWidth = 8.0;

QColor colorOf(double value, double min, double max) {
    if (value > 1.005) // light out of nothing
        return QColor(tokens::kDanger);
    const glm::vec3 c =
        mapColor(ColorMap::Sequential, static_cast<float>((value - min) / (max - min)));
    return QColor::fromRgbF(c.x, c.y, c.z);
}

} // namespace

EnergyMap::EnergyMap(QWidget* parent)
    : QWidget(parent) {
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
    setAccessibleName(tr("Energy by roughness and angle"));
    setStatusTip(tr("Energy returned by roughness and angle; press to look at an angle"));
    setCursor(Qt::CrossCursor);
}

QSize EnergyMap::sizeHint() const {
    return {220, 176};
}
QSize EnergyMap::minimumSizeHint() const {
    return {150, 120};
}

void EnergyMap::setValues(std::vector<double> values, int size) {
    m_values = std::move(values);
    m_size = size;
    // Round ends, at least a tenth apart.
    const auto [low, high] = std::minmax_element(m_values.begin(), m_values.end());
    m_min = std::clamp(std::floor(*low * 20.0) / 20.0, 0.0, 0.9);
    m_max = std::clamp(std::ceil(*high * 20.0 - 1e-6) / 20.0, m_min + 0.1, 1.0);
    m_image = QImage(size, size, QImage::Format_RGB32);
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x)
            m_image.setPixelColor(
                x, size - 1 - y,
                colorOf(m_values[static_cast<std::size_t>(y) * size + x], m_min, m_max));
    update();
}

void EnergyMap::setPlace(double lowRoughness, double meanRoughness, double highRoughness,
                         double angleDeg) {
    m_low = lowRoughness;
    m_mean = meanRoughness;
    m_high = highRoughness;
    m_angle = angleDeg;
    update();
}

double EnergyMap::valueAt(double roughness, double angleDeg) const {
    if (m_size == 0)
        return 0.0;
    const double x = std::clamp(roughness * m_size - 0.5, 0.0, m_size - 1.0);
    const double y = std::clamp(angleDeg / 90.0 * m_size - 0.5, 0.0, m_size - 1.0);
    const int x0 = std::min(static_cast<int>(x), m_size - 2);
    const int y0 = std::min(static_cast<int>(y), m_size - 2);
    const auto at = [&](int column, int row) {
        return m_values[static_cast<std::size_t>(row) * m_size + column];
    };
    return std::lerp(std::lerp(at(x0, y0), at(x0 + 1, y0), x - x0),
                     std::lerp(at(x0, y0 + 1), at(x0 + 1, y0 + 1), x - x0), y - y0);
}

QRectF EnergyMap::area() const {
    const QFontMetricsF metrics(plotFont(font()));
    const double left = kPad + metrics.horizontalAdvance(QStringLiteral("90°")) + kPad;
    const double right =
        kPad + kScaleWidth + 3.0 + metrics.horizontalAdvance(QStringLiteral("100 %")) + kPad;
    const double top = plotTitleHeight(font()) + 4.0;
    return {left, top, std::max(width() - left - right, 10.0),
            std::max(height() - top - metrics.height() - kPad - 3.0, 10.0)};
}

QPointF EnergyMap::position(double roughness, double angleDeg) const {
    const QRectF plot = area();
    return {plot.left() + roughness * plot.width(),
            plot.bottom() - angleDeg / 90.0 * plot.height()};
}

void EnergyMap::paintEvent(QPaintEvent*) {
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setRenderHint(QPainter::SmoothPixmapTransform);
    paintPlotWell(painter, rect(), tr("Roughness × angle"));
    const QRectF plot = area();
    painter.setFont(plotFont(font()));
    if (m_image.isNull())
        return;
    painter.drawImage(plot, m_image);
    paintScale(painter, plot);

    const QFontMetricsF metrics(painter.font());
    painter.setPen(QColor(tokens::kTextDim));
    for (const double angle : {0.0, 45.0, 90.0}) {
        const QString label = tr("%1°").arg(angle);
        const double y = position(0, angle).y();
        painter.drawText(QPointF(plot.left() - kPad - metrics.horizontalAdvance(label),
                                 std::min(y + metrics.ascent() / 2 - 1.0, plot.bottom())),
                         label);
    }
    for (const double roughness : {0.0, 0.5, 1.0}) {
        const QString label = plotNumber(roughness);
        const double w = metrics.horizontalAdvance(label);
        painter.drawText(
            QPointF(std::clamp(position(roughness, 0).x() - w / 2, plot.left(), plot.right() - w),
                    plot.bottom() + 2.0 + metrics.ascent()),
            label);
    }

    // Where the material lies: a cross, dark under light so that it shows on every colour.
    painter.setClipRect(plot);
    for (const QPen& pen : {QPen(QColor(0, 0, 0, 150), 2.6), QPen(QColor(Qt::white), 1.2)}) {
        painter.setPen(pen);
        painter.drawLine(position(m_mean, 0), position(m_mean, 90));
        painter.drawLine(position(0, m_angle), position(1, m_angle));
        painter.setBrush(Qt::NoBrush);
        painter.drawEllipse(position(m_mean, m_angle), 4.0, 4.0);
    }
    if (m_high > m_low) {
        painter.setPen(QPen(QColor(255, 255, 255, 160), 1.0, Qt::DotLine));
        painter.drawLine(position(m_low, 0), position(m_low, 90));
        painter.drawLine(position(m_high, 0), position(m_high, 90));
    }
}

void EnergyMap::paintScale(QPainter& painter, const QRectF& plot) const {
    const QRectF bar(plot.right() + kPad, plot.top(), kScaleWidth, plot.height());
    QLinearGradient gradient(bar.bottomLeft(), bar.topLeft());
    for (int i = 0; i <= 16; ++i)
        gradient.setColorAt(i / 16.0, colorOf(m_min + (m_max - m_min) * i / 16.0, m_min, m_max));
    painter.fillRect(bar, gradient);
    const QFontMetricsF metrics(painter.font());
    painter.setPen(QColor(tokens::kTextDim));
    const auto label = [&](double value, double y) {
        painter.drawText(QPointF(bar.right() + 3.0, y), tr("%1 %").arg(qRound(100.0 * value)));
    };
    label(m_max, bar.top() + metrics.ascent() - 1.0);
    label(m_min, bar.bottom());
}

void EnergyMap::pickAngle(const QPointF& position) {
    const QRectF plot = area();
    const double share = std::clamp((plot.bottom() - position.y()) / plot.height(), 0.0, 1.0);
    Q_EMIT anglePicked(std::round(90.0 * share));
}

void EnergyMap::mousePressEvent(QMouseEvent* event) {
    if (event->button() == Qt::LeftButton)
        pickAngle(event->position());
}

void EnergyMap::mouseMoveEvent(QMouseEvent* event) {
    if (event->buttons() & Qt::LeftButton)
        pickAngle(event->position());
}

bool EnergyMap::event(QEvent* event) {
    if (event->type() != QEvent::ToolTip)
        return QWidget::event(event);
    const auto* help = static_cast<QHelpEvent*>(event);
    const QRectF plot = area();
    const double roughness = std::clamp((help->pos().x() - plot.left()) / plot.width(), 0.0, 1.0);
    const double angle =
        90.0 * std::clamp((plot.bottom() - help->pos().y()) / plot.height(), 0.0, 1.0);
    QToolTip::showText(help->globalPos(),
                       tr("Roughness %1, seen at %2°: %3 % returned")
                           .arg(roughness, 0, 'f', 2)
                           .arg(qRound(angle))
                           .arg(100.0 * valueAt(roughness, angle), 0, 'f', 1),
                       this);
    return true;
}

} // namespace patina::editor
