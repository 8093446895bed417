#include "app/editor/widget/BandBars.h"

#include "app/editor/style/Tokens.h"

#include <algorithm>
#include <cmath>

namespace patina::editor {
namespace {

constexpr QRgb kNegativeBar = 0xffd966c0;

int bandOf(int coefficient) {
    return static_cast<int>(std::sqrt(static_cast<double>(coefficient) + 0.5));
}

int orderOf(int coefficient) { // m
    const int l = bandOf(coefficient);
    return coefficient - l * (l + 1);
}

} // namespace

BandBars::BandBars(QWidget* parent)
    : PlotFrame(tr("Coefficients by band"), Cursor::Across, Press::Once, parent) {
    setObjectName(QStringLiteral("bandBars"));
    setAccessibleName(tr("Coefficients of the transfer"));
    setStatusTip(tr("Click a band, or press Space on it, to mute it; with Shift to have it alone"));
}

void BandBars::setCoefficients(std::vector<float> coefficients, QStringList shares) {
    m_coefficients = std::move(coefficients);
    m_shares = std::move(shares);
    m_order = static_cast<int>(std::lround(std::sqrt(static_cast<double>(m_coefficients.size()))));
    m_largest = 1e-6f;
    for (const float c : m_coefficients)
        m_largest = std::max(m_largest, std::abs(c));
    setAxes({{tr("l, m"), {}, 0.0, std::max(m_order * m_order - 1.0, 0.0), 1.0, false, true},
             {tr("transfer"), {}, -double{m_largest}, double{m_largest}}});
    setDescription(m_shares.join(QStringLiteral(", ")));
}

// --- Places --------------------------------------------------------------------------------------

QRectF BandBars::area() const {
    return QRectF(rect()).adjusted(6, plotTitleHeight(font()) + 2, -6, -4);
}

// Wide bands have more bars, but all numbers need their place: half of the width is shared evenly.
QRectF BandBars::bandArea(int l) const {
    const QRectF all = area();
    const double even = m_order, whole = m_order * (m_order + even);
    const double begin = l * (l + even), wide = 2.0 * l + 1.0 + even;
    return {all.left() + all.width() * begin / whole, all.top(), all.width() * wide / whole,
            all.height()};
}

QRectF BandBars::barsArea(int l) const {
    const double line = QFontMetricsF(plotFont(font())).height();
    return bandArea(l).adjusted(5, line + 2, -5, -line - 2);
}

QRectF BandBars::bar(int l, int m) const {
    const QRectF bars = barsArea(l);
    const double step = bars.width() / (2 * l + 1), thick = std::min(step * 0.7, 22.0);
    const double value = double{m_coefficients[static_cast<std::size_t>(l * (l + 1) + m)]};
    return QRectF(bars.left() + (m + l + 0.5) * step - thick / 2.0, bars.center().y(), thick,
                  -value / double{m_largest} * bars.height() / 2.0)
        .normalized();
}

QPointF BandBars::pointOf(const QPointF& place) const {
    const int i = static_cast<int>(place.x());
    return bar(bandOf(i), orderOf(i)).center();
}

std::optional<QPointF> BandBars::placeAt(const QPointF& point) const {
    for (int l = 0; l < m_order; ++l) {
        if (!bandArea(l).contains(point))
            continue;
        const QRectF bars = barsArea(l);
        const double share = (point.x() - bars.left()) / bars.width();
        return QPointF(l * l + std::clamp(static_cast<int>(share * (2 * l + 1)), 0, 2 * l), 0.0);
    }
    return std::nullopt;
}

QString BandBars::placeText(const QPointF& place) const {
    const int i = static_cast<int>(place.x());
    return QStringLiteral("T(%1, %2)").arg(bandOf(i)).arg(orderOf(i));
}

std::vector<PlotValue> BandBars::valuesAt(const QPointF& place) const {
    const auto i = static_cast<std::size_t>(place.x());
    if (i >= m_coefficients.size())
        return {};
    const int l = bandOf(static_cast<int>(i));
    std::vector<PlotValue> values{{{}, {double{m_coefficients[i]}}}};
    if (l < m_shares.size())
        values.push_back({tr("light by band %1:").arg(l), {}, -1, m_shares[l]});
    return values;
}

bool BandBars::pick(const QPointF& place, Qt::KeyboardModifiers modifiers) {
    const unsigned bit = 1u << static_cast<unsigned>(bandOf(static_cast<int>(place.x())));
    const unsigned shown = (1u << static_cast<unsigned>(m_order)) - 1u;
    if (modifiers.testFlag(Qt::ShiftModifier))
        m_on = (m_on & shown) == bit ? ~0u : bit;
    else
        m_on ^= bit;
    update();
    Q_EMIT bandsChanged();
    return true;
}

// --- Painting ------------------------------------------------------------------------------------

void BandBars::paintValues(QPainter& painter) const {
    const QFontMetricsF metrics(painter.font());
    for (int l = 0; l < m_order; ++l) {
        const QRectF band = bandArea(l).adjusted(2, 0, -2, 0), bars = barsArea(l);
        const bool on = (m_on >> static_cast<unsigned>(l) & 1u) != 0;
        painter.fillRect(band, QColor(on ? tokens::kRaised : tokens::kWell));
        painter.setPen(QColor(tokens::kLine));
        painter.drawLine(QPointF(bars.left(), bars.center().y()),
                         QPointF(bars.right(), bars.center().y()));
        for (int m = -l; m <= l; ++m) {
            const bool negative = m_coefficients[static_cast<std::size_t>(l * (l + 1) + m)] < 0.0f;
            painter.fillRect(bar(l, m), QColor(!on        ? tokens::kTextOff
                                               : negative ? kNegativeBar
                                                          : tokens::kAccent));
        }
        painter.setPen(QColor(on ? tokens::kText : tokens::kTextOff));
        painter.drawText(band.adjusted(0, 1, 0, 0), Qt::AlignHCenter | Qt::AlignTop,
                         on ? QString::number(l) : tr("%1 off").arg(l));
        painter.setPen(QColor(on ? tokens::kTextDim : tokens::kTextOff));
        const QString share = m_shares.value(l);
        if (metrics.horizontalAdvance(share) <= band.width() + 2.0)
            painter.drawText(band.adjusted(-2, 0, 2, -1), Qt::AlignHCenter | Qt::AlignBottom,
                             share);
    }
}

// The band that a press mutes, and the bar that is read.
void BandBars::paintProbe(QPainter& painter, const QPointF& place) const {
    const int i = static_cast<int>(place.x()), l = bandOf(i);
    if (l >= m_order)
        return;
    painter.setBrush(Qt::NoBrush);
    painter.setPen(QColor(tokens::kTextDim));
    painter.drawRect(bandArea(l).adjusted(2.5, 0.5, -2.5, -0.5));
    painter.setPen(QColor(tokens::kText));
    painter.drawRect(bar(l, orderOf(i)).adjusted(-1.5, -1.5, 1.5, 1.5));
}

} // namespace patina::editor
