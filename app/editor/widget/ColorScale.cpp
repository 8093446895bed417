#include "app/editor/widget/ColorScale.h"

#include "app/editor/style/Tokens.h"
#include "core/base/Check.h"

#include <QMouseEvent>
#include <QPainter>
#include <algorithm>
#include <cmath>

namespace patina::editor {
namespace {

constexpr int kScaleBar = 12;      // height
constexpr int kTick = 3;           // length of a mark below it
constexpr int kInset = 8;          // room for half a number at the ends
constexpr int kTicks = 6;          // at most
constexpr double kSmallest = 1e-9; // range, relative to its size: floats end there

double roundStep(double span, int most) {
    const double power = std::pow(10.0, std::floor(std::log10(span / most)));
    for (const double digit : {1.0, 2.0, 5.0})
        if (span / (digit * power) <= most - 1)
            return digit * power;
    return 10.0 * power;
}

std::vector<double> evenTicks(double min, double max, int most) {
    const double step = roundStep(max - min, most);
    std::vector<double> ticks;
    const double slack = 1e-6 * step;
    for (double k = std::ceil((min - slack) / step); k * step <= max + slack; k += 1.0)
        ticks.push_back(k * step);
    return ticks;
}

} // namespace

std::vector<double> scaleTicks(double min, double max, bool logarithmic, int most) {
    CHECK(min < max && most >= 2);
    if (!logarithmic)
        return evenTicks(min, max, most);
    CHECK(min > 0);
    const double first = std::ceil(std::log10(min) - 1e-6);
    const double last = std::floor(std::log10(max) + 1e-6);
    if (last - first < 1.0)
        return evenTicks(min, max, most);
    const double step = std::max(1.0, std::ceil((last - first) / (most - 1)));
    std::vector<double> ticks;
    for (double exponent = first; exponent <= last; exponent += step)
        ticks.push_back(std::pow(10.0, exponent));
    return ticks;
}

QString tickText(double value) {
    const double size = std::abs(value);
    if (size < 1e-12)
        return QStringLiteral("0");
    if (size >= 1e-3 * (1 - 1e-9) && size < 1e4 * (1 - 1e-9)) {
        const QString text = QString::number(value, 'g', 4);
        return text.contains(QLatin1Char('e')) ? QString::number(value, 'f', 4) : text;
    }
    int exponent = static_cast<int>(std::floor(std::log10(size) + 1e-9));
    const double mantissa = value / std::pow(10.0, exponent);
    const QString digits = QString::number(mantissa, 'g', 3);
    QString power;
    for (const QChar digit : QString::number(exponent)) {
        static const QString kSuperscripts = QStringLiteral("⁰¹²³⁴⁵⁶⁷⁸⁹");
        power += digit == QLatin1Char('-') ? QChar(u'⁻') : kSuperscripts[digit.digitValue()];
    }
    const QString ten = QStringLiteral("10") + power;
    if (digits == QLatin1String("1"))
        return ten;
    return digits == QLatin1String("-1") ? QLatin1Char('-') + ten
                                         : digits + QStringLiteral("·") + ten;
}

ColorScale::ColorScale(ColorMap map, bool logarithmic, QWidget* parent)
    : QWidget(parent)
    , m_map(map)
    , m_logarithmic(logarithmic) {
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
    setCursor(Qt::SizeHorCursor);
    if (logarithmic)
        m_min = 0.1;
}

void ColorScale::setRange(double min, double max) {
    CHECK(min < max && (!m_logarithmic || min > 0));
    m_min = min;
    m_max = max;
    update();
}

QSize ColorScale::sizeHint() const {
    return {200, kScaleBar + kTick + fontMetrics().height()};
}

double ColorScale::even(double value) const {
    return m_logarithmic ? std::log10(value) : value;
}

double ColorScale::value(double even) const {
    return m_logarithmic ? std::pow(10.0, even) : even;
}

void ColorScale::paintEvent(QPaintEvent*) {
    QPainter painter(this);
    const QRectF bar(kInset, 0, width() - 2 * kInset, kScaleBar);
    const double ratio = devicePixelRatioF();
    const int pixels = std::max(1, qRound(bar.width() * ratio));
    QImage colors(pixels, 1, QImage::Format_RGB32);
    auto* line = reinterpret_cast<QRgb*>(colors.scanLine(0));
    for (int x = 0; x < pixels; ++x) {
        const double t = (x + 0.5) / pixels;
        const glm::vec3 color = 255.0f * mapColor(m_map, static_cast<float>(t)) + 0.5f;
        line[x] =
            qRgb(static_cast<int>(color.r), static_cast<int>(color.g), static_cast<int>(color.b));
    }
    painter.drawImage(bar, colors);
    painter.setPen(QColor(tokens::kHover));
    painter.drawRect(bar.adjusted(-0.5, 0, -0.5, -0.5));
    paintTicks(painter, bar);
}

void ColorScale::paintTicks(QPainter& painter, const QRectF& bar) const {
    const double from = even(m_min), to = even(m_max);
    double free = -1e9; // where the last number ends
    for (const double tick : scaleTicks(m_min, m_max, m_logarithmic, kTicks)) {
        const double x = bar.left() + bar.width() * (even(tick) - from) / (to - from);
        painter.setPen(QColor(tokens::kTextDim));
        painter.drawLine(QPointF(x, bar.bottom()), QPointF(x, bar.bottom() + kTick));
        const QString text = tickText(tick);
        const double half = 0.5 * fontMetrics().horizontalAdvance(text);
        const double left = std::clamp(x - half, 0.0, std::max(0.0, width() - 2 * half));
        if (left < free)
            continue;
        free = left + 2 * half + 6;
        painter.setPen(QColor(tokens::kText));
        painter.drawText(QPointF(left, bar.bottom() + kTick + fontMetrics().ascent()), text);
    }
}

// --- Mouse -----------------------------------------------------------------------------------

void ColorScale::mousePressEvent(QMouseEvent* event) {
    if (event->button() != Qt::LeftButton)
        return;
    m_pressX = event->position().x();
    m_part = 1 + std::clamp(static_cast<int>(3 * m_pressX / std::max(1, width())), 0, 2);
    m_pressMin = even(m_min);
    m_pressMax = even(m_max);
}

void ColorScale::mouseMoveEvent(QMouseEvent* event) {
    if (m_part == 0)
        return;
    // The colour follows the pointer: what lay under the press lies under it now.
    const double span = m_pressMax - m_pressMin;
    const double inner = std::max(1, width() - 2 * kInset);
    const double grabbed = (m_pressX - kInset) / inner;
    const double at = (event->position().x() - kInset) / inner;
    double min = m_pressMin, max = m_pressMax;
    if (m_part == 2) {
        min -= (at - grabbed) * span;
        max -= (at - grabbed) * span;
    } else if (m_part == 1) {
        // The right end stays: 1 - at is to 1 - grabbed as the old span to the new one.
        min = max - span * (1.0 - grabbed) / std::max(1.0 - at, 0.02);
    } else {
        max = min + span * grabbed / std::max(at, 0.02);
    }
    if (value(max) - value(min) < kSmallest * std::max(std::abs(value(max)), 1e-6) ||
        !std::isfinite(value(max)) || (m_logarithmic && value(min) <= 0))
        return;
    setRange(value(min), value(max));
    Q_EMIT dragged(m_min, m_max);
}

void ColorScale::mouseReleaseEvent(QMouseEvent*) {
    m_part = 0;
}

void ColorScale::mouseDoubleClickEvent(QMouseEvent*) {
    m_part = 0;
    Q_EMIT resetRequested();
}

} // namespace patina::editor
