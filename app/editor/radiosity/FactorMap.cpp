#include "app/editor/radiosity/FactorMap.h"

#include "core/image/ColorMap.h"

#include <algorithm>
#include <cmath>

namespace patina::editor {
namespace {

constexpr double kLeast = 1e-4, kMost = 1.0; // of the colours

QColor colorOfShare(double share) {
    const glm::vec3 c = mapColor(ColorMap::Magma, static_cast<float>(share));
    return QColor::fromRgbF(c.x, c.y, c.z);
}

} // namespace

FactorMap::FactorMap(QWidget* parent)
    : PlotFrame({}, Cursor::Both, Press::Once, parent) {
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
    setCursor(Qt::CrossCursor);
    setAccessibleName(tr("Matrix of the elements"));
    setHelp(tr("A row for each element that receives, a column for each that sends; press to "
               "choose the element of a row"));
}

void FactorMap::setValues(std::vector<float> values, int size, int group, const QString& what) {
    m_values = std::move(values);
    m_size = size;
    m_group = group;
    setTitle(group > 1 ? tr("%1, in groups of %2 elements").arg(what).arg(group) : QString());
    const double end = std::max(size - 1, 1);
    setAxes({{tr("from element"), {}, 0.0, end, 0.0, false, true},
             {tr("to element"), {}, end, 0.0, 0.0, false, true},
             {what, {}, kLeast, kMost, 0.0, true, false}});
    m_image = QImage(std::max(cells(), 1), std::max(cells(), 1), QImage::Format_RGB32);
    for (int row = 0; row < cells(); ++row)
        for (int column = 0; column < cells(); ++column) {
            const double value =
                std::abs(static_cast<double>(valueAt(row * group, column * group)));
            m_image.setPixelColor(column, row,
                                  value > 0.0
                                      ? colorOfShare(std::clamp(m_axes[2].share(value), 0.0, 1.0))
                                      : QColor(Qt::black));
        }
    update();
}

std::vector<PlotValue> FactorMap::valuesAt(const QPointF& place) const {
    const int row = std::clamp(static_cast<int>(std::lround(place.y())), 0, m_size - 1);
    const int column = std::clamp(static_cast<int>(std::lround(place.x())), 0, m_size - 1);
    return {{{}, {static_cast<double>(valueAt(row, column))}}};
}

QString FactorMap::placeText(const QPointF& place) const {
    const auto elements = [this](double element) {
        const int first = static_cast<int>(std::lround(element)) / m_group * m_group;
        const int last = std::min(first + m_group, m_size) - 1;
        return last > first ? tr("%1–%2").arg(first).arg(last) : QString::number(first);
    };
    return tr("from %1 to %2").arg(elements(place.x()), elements(place.y()));
}

QPointF FactorMap::allowed(const QPointF& place) const {
    return {std::round(place.x()), std::round(place.y())};
}

bool FactorMap::pick(const QPointF& place, Qt::KeyboardModifiers) {
    Q_EMIT elementPicked(static_cast<int>(std::lround(place.y())));
    return true;
}

void FactorMap::paintValues(QPainter& painter) const {
    // The last group may be smaller than the others.
    const double part = static_cast<double>(m_size) / m_group;
    painter.drawImage(area(), m_image, QRectF(0.0, 0.0, part, part));
    paintScale(painter, colorOfShare);
    paintAxes(painter);
}

} // namespace patina::editor
