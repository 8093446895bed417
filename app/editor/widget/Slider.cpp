#include "app/editor/widget/Slider.h"

#include "app/editor/style/Tokens.h"

#include <QMouseEvent>
#include <QPainter>
#include <algorithm>
#include <cmath>

namespace patina::editor {
namespace {
constexpr double kHandle = 6; // radius
constexpr double kTrack = 4;  // height
} // namespace

Slider::Slider(double min, double max, double origin, QWidget* parent)
    : QWidget(parent)
    , m_min(min)
    , m_max(max)
    , m_origin(std::clamp(origin, min, max))
    , m_value(m_origin) {
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
}

void Slider::setValue(double value) {
    m_value = value;
    update();
}

void Slider::setEnds(double min, double max) {
    m_min = m_origin = min;
    m_max = max;
    update();
}

QSize Slider::sizeHint() const {
    return {110, tokens::kRowHeight - 2};
}
QSize Slider::minimumSizeHint() const {
    return {48, tokens::kRowHeight - 2};
}

double Slider::position(double value) const {
    const double t = (std::clamp(value, m_min, m_max) - m_min) / (m_max - m_min);
    return kHandle + 1 + t * (width() - 2 * (kHandle + 1));
}

int Slider::handleX() const {
    return qRound(position(m_value));
}

void Slider::moveTo(double x) {
    const double t = (x - kHandle - 1) / std::max(1.0, width() - 2 * (kHandle + 1));
    // Steps that a pixel can tell apart, as a round number.
    const double range = m_max - m_min;
    const double quantum = std::pow(10.0, std::floor(std::log10(range / 200)));
    const double value = std::round((m_min + t * range) / quantum) * quantum;
    setValue(std::clamp(value, m_min, m_max));
    Q_EMIT dragged(m_value);
}

void Slider::paintEvent(QPaintEvent*) {
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(Qt::NoPen);
    const double y = height() / 2.0;
    const auto bar = [&](double x0, double x1, QRgb color) {
        painter.setBrush(QColor(color));
        painter.drawRoundedRect(QRectF(std::min(x0, x1), y - kTrack / 2, std::abs(x1 - x0), kTrack),
                                kTrack / 2, kTrack / 2);
    };
    bar(1, width() - 1, tokens::kWell);
    const bool on = isEnabled();
    bar(m_origin == m_min ? 1 : position(m_origin), position(m_value),
        on ? tokens::kAccentDeep : tokens::kLine);
    const bool lit = on && (underMouse() || m_dragging);
    painter.setBrush(QColor(!on ? tokens::kLine : lit ? tokens::kText : tokens::kTextDim));
    painter.drawEllipse(QPointF(position(m_value), y), kHandle - 1, kHandle - 1);
}

void Slider::mousePressEvent(QMouseEvent* event) {
    if (event->button() != Qt::LeftButton)
        return;
    m_dragging = true;
    m_pressX = event->position().x();
    m_startValue = m_value;
    const double offset = position(m_value) - m_pressX;
    const bool onHandle = std::abs(offset) <= kHandle + 1;
    m_grab = onHandle ? offset : 0;
    Q_EMIT dragStarted();
    if (!onHandle) {
        moveTo(m_pressX);
        m_pressX = -1e9; // a jump has no way back by the hand
    }
    update();
}

void Slider::mouseMoveEvent(QMouseEvent* event) {
    if (!m_dragging)
        return;
    if (std::abs(event->position().x() - m_pressX) < 0.5) {
        setValue(m_startValue); // back where it was taken: exactly that value
        Q_EMIT dragged(m_startValue);
    } else {
        moveTo(event->position().x() + m_grab);
    }
}

void Slider::mouseReleaseEvent(QMouseEvent* event) {
    if (event->button() != Qt::LeftButton || !m_dragging)
        return;
    m_dragging = false;
    Q_EMIT dragFinished();
    update();
}

void Slider::abandonEdit() {
    m_dragging = false;
    update();
}

void Slider::enterEvent(QEnterEvent*) {
    update();
}
void Slider::leaveEvent(QEvent*) {
    update();
}

} // namespace patina::editor
