#include "app/editor/widget/BandBars.h"

#include "app/editor/style/FocusRing.h"
#include "app/editor/style/Tokens.h"
#include "app/editor/widget/PlotStyle.h"

#include <QHelpEvent>
#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QToolTip>
#include <algorithm>
#include <cmath>

namespace patina::editor {
namespace {

constexpr QRgb kNegativeBar = 0xffd966c0;

} // namespace

BandBars::BandBars(QWidget* parent)
    : QWidget(parent) {
    setObjectName(QStringLiteral("bandBars"));
    setFocusPolicy(Qt::StrongFocus);
    setAccessibleName(tr("Coefficients of the transfer"));
    setStatusTip(tr("Click a band, or press Space on it, to mute it; with Shift to have it alone"));
}

void BandBars::setCoefficients(std::vector<float> coefficients, QStringList shares) {
    m_coefficients = std::move(coefficients);
    m_shares = std::move(shares);
    m_order = static_cast<int>(std::lround(std::sqrt(static_cast<double>(m_coefficients.size()))));
    setAccessibleDescription(m_shares.join(QStringLiteral(", ")));
    update();
}

// Wide bands have more bars, but all numbers need their place: half of the width is shared evenly.
QRectF BandBars::bandArea(int l) const {
    const QRectF area = QRectF(rect()).adjusted(6, plotTitleHeight(font()) + 2, -6, -4);
    const double even = m_order;
    const double all = m_order * (m_order + even);
    const double begin = l * (l + even), wide = 2.0 * l + 1.0 + even;
    return {area.left() + area.width() * begin / all, area.top(), area.width() * wide / all,
            area.height()};
}

int BandBars::bandAt(const QPointF& position) const {
    for (int l = 0; l < m_order; ++l)
        if (bandArea(l).contains(position))
            return l;
    return -1;
}

void BandBars::toggle(int band, bool solo) {
    if (band < 0 || band >= m_order)
        return;
    const unsigned bit = 1u << static_cast<unsigned>(band);
    const unsigned shown = (1u << static_cast<unsigned>(m_order)) - 1u;
    if (solo)
        m_on = (m_on & shown) == bit ? ~0u : bit;
    else
        m_on ^= bit;
    update();
    Q_EMIT bandsChanged();
}

void BandBars::mousePressEvent(QMouseEvent* event) {
    if (event->button() == Qt::LeftButton)
        toggle(bandAt(event->position()), event->modifiers() & Qt::ShiftModifier);
}

void BandBars::keyPressEvent(QKeyEvent* event) {
    switch (event->key()) {
    case Qt::Key_Left:
        m_current = std::max(0, m_current - 1);
        break;
    case Qt::Key_Right:
        m_current = std::min(std::max(0, m_order - 1), m_current + 1);
        break;
    case Qt::Key_Space:
        toggle(m_current, event->modifiers() & Qt::ShiftModifier);
        break;
    default:
        QWidget::keyPressEvent(event);
        return;
    }
    update();
}

bool BandBars::event(QEvent* event) {
    if (event->type() == QEvent::ToolTip) {
        const auto* help = static_cast<QHelpEvent*>(event);
        const int band = bandAt(help->pos());
        QString text = m_shares.isEmpty() || band < 0
                           ? QString()
                           : tr("Light by band %1: %2\n").arg(band).arg(m_shares.value(band));
        for (int m = -band; band >= 0 && m <= band; ++m)
            text +=
                tr("T(%1, %2) = %3\n")
                    .arg(band)
                    .arg(m)
                    .arg(double{m_coefficients[static_cast<std::size_t>(band * (band + 1) + m)]}, 0,
                         'f', 5);
        QToolTip::showText(help->globalPos(), text.trimmed(), this);
        return true;
    }
    return QWidget::event(event);
}

void BandBars::paintEvent(QPaintEvent*) {
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    paintPlotWell(painter, rect(), tr("Coefficients by band"));
    if (m_order == 0)
        return;
    painter.setFont(plotFont(font()));
    const double line = QFontMetricsF(painter.font()).height();
    float largest = 1e-6f;
    for (const float c : m_coefficients)
        largest = std::max(largest, std::abs(c));
    for (int l = 0; l < m_order; ++l) {
        const QRectF area = bandArea(l).adjusted(2, 0, -2, 0);
        const bool on = (m_on >> static_cast<unsigned>(l) & 1u) != 0;
        painter.fillRect(area, QColor(on ? tokens::kRaised : tokens::kWell));
        if (hasFocus() && l == m_current) {
            painter.setPen(QColor(tokens::kFocus));
            painter.drawRect(area);
        }
        const QRectF bars = area.adjusted(3, line + 2, -3, -line - 2);
        const double middle = bars.center().y(), half = bars.height() / 2.0;
        painter.setPen(QColor(tokens::kLine));
        painter.drawLine(QPointF(bars.left(), middle), QPointF(bars.right(), middle));
        const double step = bars.width() / (2 * l + 1), thick = std::min(step * 0.7, 22.0);
        for (int m = -l; m <= l; ++m) {
            const double value =
                double{m_coefficients[static_cast<std::size_t>(l * (l + 1) + m)]} / largest;
            const double x = bars.left() + (m + l + 0.5) * step - thick / 2.0;
            const QColor color = !on           ? QColor(tokens::kTextOff)
                                 : value < 0.0 ? QColor(kNegativeBar)
                                               : QColor(tokens::kAccent);
            painter.fillRect(QRectF(x, middle, thick, -value * half).normalized(), color);
        }
        painter.setPen(QColor(on ? tokens::kText : tokens::kTextOff));
        painter.drawText(area.adjusted(0, 1, 0, 0), Qt::AlignHCenter | Qt::AlignTop,
                         on ? QString::number(l) : tr("%1 off").arg(l));
        painter.setPen(QColor(on ? tokens::kTextDim : tokens::kTextOff));
        const QString share = m_shares.value(l);
        if (QFontMetricsF(painter.font()).horizontalAdvance(share) <= area.width() + 2.0)
            painter.drawText(area.adjusted(-2, 0, 2, -1), Qt::AlignHCenter | Qt::AlignBottom,
                             share);
    }
}

} // namespace patina::editor
