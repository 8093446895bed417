#include "app/editor/widget/EnergyMap.h"

#include "app/editor/style/Tokens.h"
#include "core/image/ColorMap.h"

#include <algorithm>
#include <cmath>

namespace patina::editor {
namespace {

QColor colorOf(double value, double min, double max) {
    if (value > 1.005) // light out of nothing
        return QColor(tokens::kDanger);
    const glm::vec3 c =
        mapColor(ColorMap::Sequential, static_cast<float>((value - min) / (max - min)));
    return QColor::fromRgbF(c.x, c.y, c.z);
}

} // namespace

EnergyMap::EnergyMap(QWidget* parent)
    : PlotFrame(tr("Roughness × angle"), Cursor::Both, Press::Follows, parent) {
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
    setAccessibleName(tr("Energy by roughness and angle"));
    setHelp(tr("Energy returned by roughness and angle; press to look at an angle"));
    setCursor(Qt::CrossCursor);
    setAxes({{tr("roughness"), {}, 0.0, 1.0, 0.5},
             {tr("angle"), QStringLiteral("°"), 0.0, 90.0, 45.0},
             {tr("returned"), QStringLiteral(" %")}});
}

void EnergyMap::setValues(std::vector<double> values, int size) {
    m_values = std::move(values);
    m_size = size;
    m_image = QImage(size, size, QImage::Format_RGB32);
    update();
    if (m_values.empty())
        return;
    // Round ends, at least a tenth apart.
    const auto [low, high] = std::minmax_element(m_values.begin(), m_values.end());
    PlotAxis& scale = m_axes[2];
    scale.min = std::clamp(std::floor(*low * 20.0) * 5.0, 0.0, 90.0);
    scale.max = std::clamp(std::ceil(*high * 20.0 - 1e-6) * 5.0, scale.min + 10.0, 100.0);
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x)
            m_image.setPixelColor(x, size - 1 - y,
                                  colorOf(m_values[static_cast<std::size_t>(y) * size + x],
                                          scale.min / 100.0, scale.max / 100.0));
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

QPointF EnergyMap::startPlace() const {
    return {m_axes[0].rounded(m_mean), m_axes[1].rounded(m_angle)};
}

bool EnergyMap::pick(const QPointF& place, Qt::KeyboardModifiers) {
    Q_EMIT anglePicked(std::round(place.y()));
    return true;
}

void EnergyMap::paintValues(QPainter& painter) const {
    const QRectF plot = area();
    painter.drawImage(plot, m_image);
    const double low = m_axes[2].min / 100.0, high = m_axes[2].max / 100.0;
    paintScale(painter, [&](double t) { return colorOf(std::lerp(low, high, t), low, high); });
    paintAxes(painter);

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
    painter.setClipping(false);
}

} // namespace patina::editor
