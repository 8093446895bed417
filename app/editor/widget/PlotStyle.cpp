#include "app/editor/widget/PlotStyle.h"

#include "app/editor/style/Tokens.h"

#include <QFontMetricsF>
#include <algorithm>
#include <array>
#include <cmath>

namespace patina::editor {
namespace {

constexpr std::array<QRgb, kPlotLooks> kLookColors{0xff56b4e9, 0xffe69f00, 0xffcc79a7, 0xfff0e442};
constexpr std::array<Qt::PenStyle, kPlotLooks> kDashes{Qt::SolidLine, Qt::DashLine, Qt::DotLine,
                                                       Qt::DashDotLine};

QString superscript(int exponent) {
    static const QString kDigits = QStringLiteral("⁰¹²³⁴⁵⁶⁷⁸⁹");
    QString text = exponent < 0 ? QStringLiteral("⁻") : QString();
    for (const QChar digit : QString::number(std::abs(exponent)))
        text += kDigits[digit.digitValue()];
    return text;
}

} // namespace

QColor plotColor(int look) {
    return kLookColors[static_cast<std::size_t>(look % kPlotLooks)];
}

Qt::PenStyle plotDash(int look) {
    return kDashes[static_cast<std::size_t>(look % kPlotLooks)];
}

QPen plotPen(int look, double width) {
    QPen pen(plotColor(look), width, plotDash(look), Qt::RoundCap, Qt::RoundJoin);
    if (plotDash(look) != Qt::SolidLine)
        pen.setCapStyle(Qt::FlatCap);
    return pen;
}

QFont plotFont(const QFont& font) {
    QFont small = font;
    small.setPointSizeF(font.pointSizeF() * 0.85);
    return small;
}

QPointF plotPoint(const std::vector<QPointF>& curve, double x) {
    if (curve.empty())
        return {};
    const auto after = std::lower_bound(curve.begin(), curve.end(), x,
                                        [](const QPointF& p, double at) { return p.x() < at; });
    if (after == curve.begin())
        return curve.front();
    if (after == curve.end())
        return curve.back();
    if (after->x() == x)
        return *after; // whatever is before it, which may be no number
    const QPointF a = *(after - 1), b = *after;
    const double t = b.x() > a.x() ? (x - a.x()) / (b.x() - a.x()) : 0.0;
    return {x, a.y() + t * (b.y() - a.y())};
}

std::vector<double> roundSteps(double min, double max, int count) {
    if (!(max > min) || count < 1)
        return {min};
    const double rough = (max - min) / count;
    const double power = std::pow(10.0, std::floor(std::log10(rough)));
    double step = 10.0 * power;
    for (const double factor : {1.0, 2.0, 5.0})
        if (factor * power >= rough * 0.999) {
            step = factor * power;
            break;
        }
    std::vector<double> steps;
    for (double i = std::ceil(min / step - 1e-9); i * step <= max + 1e-9 * step; i += 1.0)
        steps.push_back(i * step);
    return steps;
}

QString plotNumber(double value, int digits) {
    if (std::isnan(value))
        return QStringLiteral("–");
    if (std::isinf(value))
        return value < 0.0 ? QStringLiteral("−∞") : QStringLiteral("∞");
    if (value == 0.0)
        return QStringLiteral("0");
    const double size = std::abs(value);
    const QString sign = value < 0 ? QStringLiteral("−") : QString();
    int exponent = static_cast<int>(std::floor(std::log10(size)));
    if (exponent >= -3 && exponent < 5) {
        QString text = QString::number(size, 'f', std::clamp(digits - 1 - exponent, 0, 5));
        if (text.contains(QLatin1Char('.'))) {
            while (text.endsWith(QLatin1Char('0')))
                text.chop(1);
            if (text.endsWith(QLatin1Char('.')))
                text.chop(1);
        }
        return sign + text;
    }
    QString mantissa = QString::number(size / std::pow(10.0, exponent), 'f', 1);
    if (mantissa == QStringLiteral("10.0")) {
        mantissa = QStringLiteral("1.0");
        ++exponent;
    }
    if (mantissa.endsWith(QStringLiteral(".0")))
        mantissa.chop(2);
    if (mantissa == QStringLiteral("1"))
        return sign + QStringLiteral("10") + superscript(exponent);
    return sign + mantissa + QStringLiteral("·10") + superscript(exponent);
}

void paintReadout(QPainter& painter, const QRectF& area, const QPointF& at, const QString& title,
                  const std::vector<ReadoutRow>& rows) {
    constexpr double kPad = 6.0, kSample = 22.0;
    const QFontMetricsF metrics(painter.font());
    double width = metrics.horizontalAdvance(title);
    for (const ReadoutRow& row : rows)
        width =
            std::max(width, metrics.horizontalAdvance(row.text) + (row.look >= 0 ? kSample : 0.0));
    width = std::min(width, area.width() - 2.0 * kPad - 1.0);
    const double line = std::ceil(metrics.height());
    const QSizeF size(std::ceil(width) + 2 * kPad,
                      line * static_cast<double>(rows.size() + 1) + 2 * kPad);
    QPointF corner(at.x() + 14.0, at.y() - size.height() - 6.0);
    if (corner.x() + size.width() > area.right())
        corner.setX(at.x() - 14.0 - size.width());
    corner.setX(std::max(std::min(corner.x(), area.right() - size.width()), area.left()));
    corner.setY(std::max(std::min(corner.y(), area.bottom() - size.height()), area.top()));
    const QRectF box(corner, size);
    QColor back(tokens::kRaised);
    back.setAlpha(238);
    painter.setPen(QColor(tokens::kHover));
    painter.setBrush(back);
    painter.drawRoundedRect(box, tokens::kRadius, tokens::kRadius);
    double y = box.top() + kPad + metrics.ascent();
    painter.setPen(QColor(tokens::kTextDim));
    painter.drawText(QPointF(box.left() + kPad, y),
                     metrics.elidedText(title, Qt::ElideRight, std::ceil(width) + 1.0));
    for (const ReadoutRow& row : rows) {
        y += line;
        double x = box.left() + kPad;
        if (row.look >= 0) {
            painter.setPen(plotPen(row.look, 2.0));
            painter.drawLine(QPointF(x, y - metrics.ascent() * 0.35),
                             QPointF(x + kSample - 6.0, y - metrics.ascent() * 0.35));
            x += kSample;
        }
        painter.setPen(QColor(tokens::kText));
        // A number is never cut in two.
        const QString value = row.text.mid(row.name);
        const double room = box.right() - kPad - x - metrics.horizontalAdvance(value) + 1.0;
        painter.drawText(QPointF(x, y), metrics.elidedText(row.text.left(row.name), Qt::ElideRight,
                                                           std::max(room, 0.0)) +
                                            value);
    }
}

double plotTitleHeight(const QFont& font) {
    return std::ceil(QFontMetricsF(font).height()) + 8.0;
}

void paintPlotWell(QPainter& painter, const QRectF& rect, const QString& title) {
    painter.setPen(Qt::NoPen);
    painter.setBrush(QColor(tokens::kWell));
    painter.drawRoundedRect(rect, tokens::kRadius, tokens::kRadius);
    const QFontMetricsF metrics(painter.font());
    painter.setPen(QColor(tokens::kText));
    painter.drawText(QPointF(rect.left() + 8.0, rect.top() + 5.0 + metrics.ascent()),
                     metrics.elidedText(title, Qt::ElideRight, rect.width() - 16.0));
}

void paintPlotMessage(QPainter& painter, const QRectF& rect, const QString& message) {
    painter.setPen(QColor(tokens::kTextDim));
    painter.drawText(rect.adjusted(12, 4, -12, -4), Qt::AlignCenter | Qt::TextWordWrap, message);
}

std::vector<QRectF> plotCells(const QRectF& area, int count, double gap) {
    std::vector<QRectF> cells;
    if (count < 1)
        return cells;
    int columns = 1;
    double best = 0.0;
    for (int c = 1; c <= count; ++c) {
        const int rows = (count + c - 1) / c;
        const double side =
            std::min((area.width() - gap * (c - 1)) / c, (area.height() - gap * (rows - 1)) / rows);
        if (side > best) {
            best = side;
            columns = c;
        }
    }
    const int rows = (count + columns - 1) / columns;
    const QSizeF size((area.width() - gap * (columns - 1)) / columns,
                      (area.height() - gap * (rows - 1)) / rows);
    for (int i = 0; i < count; ++i)
        cells.emplace_back(QPointF(area.left() + (i % columns) * (size.width() + gap),
                                   area.top() + (i / columns) * (size.height() + gap)),
                           size);
    return cells;
}

} // namespace patina::editor
