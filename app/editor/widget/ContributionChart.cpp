#include "app/editor/widget/ContributionChart.h"

#include "app/editor/style/Tokens.h"
#include "core/math/Shading.h"

#include <algorithm>
#include <cmath>

namespace patina::editor {
namespace {

constexpr int kChartPad = 8;
constexpr QRgb kChannelColors[3] = {0xffd9635f, 0xff5fb370, 0xff5f8fd9};

// In the colour of the light itself, as bright as a bar must be to be seen.
QColor barColor(const glm::vec3& radiance) {
    const float peak = std::max({radiance.x, radiance.y, radiance.z});
    if (!(peak > 0.0f) || !std::isfinite(peak))
        return QColor(tokens::kTextOff);
    const glm::vec3 encoded = shading::srgbEncode(radiance / peak);
    return QColor::fromRgbF(0.12f + 0.83f * encoded.x, 0.12f + 0.83f * encoded.y,
                            0.12f + 0.83f * encoded.z);
}

float positive(float x) {
    return x > 0.0f && std::isfinite(x) ? x : 0.0f;
}

} // namespace

ContributionChart::ContributionChart(QWidget* parent)
    : PlotFrame({}, Cursor::Up, Press::Once, parent) {
    setObjectName(QStringLiteral("contributions"));
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
    setAccessibleName(tr("Contributions"));
    setStatusTip(tr("What the light of this pixel is made of; click a bar to see its formula"));
    setContributions({});
}

void ContributionChart::setContributions(std::vector<render::Contribution> parts) {
    const bool grows = parts.size() != m_parts.size();
    m_parts = std::move(parts);
    m_sum = glm::vec3(0.0f);
    QStringList sentence;
    for (const render::Contribution& part : m_parts) {
        if (part.on)
            m_sum += part.radiance;
        sentence << QString::fromStdString(part.label) + QLatin1Char(' ') +
                        QString::fromStdString(
                            render::numberText(shading::luminance(part.radiance)));
    }
    setAxes({{tr("radiance"), tr(" cd/m²"), 0.0, std::max(double{largest()}, 1e-9)},
             {tr("contribution"), {}, static_cast<double>(m_parts.size()), 0.0, 1.0, false, true}});
    setDescription(sentence.join(QStringLiteral(", ")));
    if (grows)
        updateGeometry();
}

void ContributionChart::setChannels(bool channels) {
    m_channels = channels;
    update();
}

int ContributionChart::rowHeight() const {
    return fontMetrics().height() + 6;
}

QSize ContributionChart::sizeHint() const {
    return {300, rowHeight() * static_cast<int>(m_parts.size() + 1) + 2 * kChartPad};
}

QSize ContributionChart::minimumSizeHint() const {
    return {220, sizeHint().height()};
}

void ContributionChart::changeEvent(QEvent* event) {
    if (event->type() == QEvent::FontChange)
        updateGeometry();
    QWidget::changeEvent(event);
}

QRectF ContributionChart::area() const {
    const QFontMetricsF metrics(font());
    double label = metrics.horizontalAdvance(tr("Sum"));
    for (const render::Contribution& part : m_parts)
        label = std::max(label, metrics.horizontalAdvance(QString::fromStdString(part.label)));
    label = std::min(label, 0.42 * width());
    const double number = metrics.horizontalAdvance(QStringLiteral("0.0000  100 %"));
    const double left = kChartPad + label + kChartPad,
                 right = width() - kChartPad - number - kChartPad;
    return {left, double{kChartPad}, std::max(right - left, 10.0),
            double(rowHeight()) * static_cast<double>(m_parts.size() + 1)};
}

int ContributionChart::rowAt(const QPoint& position) const {
    const int row = (position.y() - kChartPad) / rowHeight();
    return position.y() >= kChartPad && row <= static_cast<int>(m_parts.size()) ? row : -1;
}

std::optional<QPointF> ContributionChart::placeAt(const QPointF& point) const {
    const int index = rowAt(point.toPoint());
    return index < 0 ? std::nullopt : std::optional(QPointF(0.0, index));
}

float ContributionChart::largest() const {
    if (!m_channels)
        return positive(shading::luminance(m_sum));
    return std::max({positive(m_sum.x), positive(m_sum.y), positive(m_sum.z)});
}

QString ContributionChart::shareText(const glm::vec3& radiance) const {
    const float whole = positive(shading::luminance(m_sum));
    const float part = positive(shading::luminance(radiance));
    return tr("%1  %2 %")
        .arg(QString::fromStdString(render::numberText(shading::luminance(radiance))))
        .arg(whole > 0.0f ? qRound(100.0f * part / whole) : 0, 3);
}

render::Contribution ContributionChart::row(int index) const {
    if (index >= 0 && index < static_cast<int>(m_parts.size()))
        return m_parts[static_cast<std::size_t>(index)];
    return {"sum", tr("Sum").toStdString(), m_sum, glm::vec3(0.0f), true};
}

QString ContributionChart::placeText(const QPointF& place) const {
    return QString::fromStdString(row(static_cast<int>(place.y())).label);
}

std::vector<PlotValue> ContributionChart::valuesAt(const QPointF& place) const {
    const render::Contribution part = row(static_cast<int>(place.y()));
    const auto numbers = [](const glm::vec3& c) {
        return std::vector{double{c.x}, double{c.y}, double{c.z}};
    };
    std::vector<PlotValue> values{{{}, numbers(part.radiance)}};
    if (part.specular != glm::vec3(0.0f))
        values.push_back({tr("of it specular"), numbers(part.specular)});
    if (!part.on)
        values.push_back({tr("switched off"), {}});
    return values;
}

bool ContributionChart::pick(const QPointF& place, Qt::KeyboardModifiers) {
    Q_EMIT chosen(QString::fromStdString(row(static_cast<int>(place.y())).key));
    return true;
}

// --- Painting ------------------------------------------------------------------------------------

void ContributionChart::paintRow(QPainter& painter, int index, const glm::vec3& begin) const {
    const render::Contribution part = row(index);
    const QRectF bars = area();
    const double top = kChartPad + double(index) * rowHeight(), height = rowHeight();
    const QFontMetricsF metrics(painter.font());
    const double wide = bars.left() - 2 * kChartPad;
    painter.setPen(part.on ? QColor(tokens::kText) : QColor(tokens::kTextOff));
    painter.drawText(QRectF(kChartPad, top, wide, height), Qt::AlignLeft | Qt::AlignVCenter,
                     metrics.elidedText(QString::fromStdString(part.label), Qt::ElideRight, wide));
    painter.drawText(
        QRectF(bars.right() + kChartPad, top, width() - bars.right() - 2 * kChartPad, height),
        Qt::AlignRight | Qt::AlignVCenter, part.on ? shareText(part.radiance) : tr("off"));

    const float whole = largest();
    if (!part.on || whole <= 0.0f)
        return;
    const auto bar = [&](double y, double thickness, float from, float length, const QColor& color,
                         bool hatched) {
        const double scale = bars.width() / static_cast<double>(whole);
        const double x = bars.left() + scale * static_cast<double>(positive(from));
        const double w = scale * static_cast<double>(positive(length));
        // Whatever there is can be seen.
        const QRectF shape(x, y, w > 0.0 ? std::max(w, 1.0) : 0.0, thickness);
        painter.fillRect(shape, color);
        if (hatched)
            painter.fillRect(shape, QBrush(QColor(255, 255, 255, 90), Qt::BDiagPattern));
    };
    // The highlight of a light lies at the end of its bar, hatched.
    const glm::vec3 diffuse = part.radiance - part.specular;
    if (!m_channels) {
        const float from = shading::luminance(begin), first = shading::luminance(diffuse);
        const QColor color = barColor(part.radiance);
        bar(top + 4, height - 8, from, first, color, false);
        bar(top + 4, height - 8, from + first, shading::luminance(part.specular), color, true);
        return;
    }
    const double thin = (height - 6.0) / 3.0;
    for (int c = 0; c < 3; ++c) {
        const double y = top + 3.0 + c * thin;
        bar(y, thin - 1.0, begin[c], diffuse[c], QColor(kChannelColors[c]), false);
        bar(y, thin - 1.0, begin[c] + diffuse[c], part.specular[c], QColor(kChannelColors[c]),
            true);
    }
}

void ContributionChart::paintValues(QPainter& painter) const {
    painter.setRenderHint(QPainter::Antialiasing, false);
    painter.setFont(font());
    const QRectF bars = area();
    const auto count = static_cast<int>(m_parts.size());
    painter.setPen(QColor(tokens::kLine));
    painter.drawLine(bars.topLeft(), bars.bottomLeft());
    const double sumTop = kChartPad + double(count) * rowHeight();
    painter.drawLine(QPointF(kChartPad, sumTop), QPointF(width() - kChartPad, sumTop));
    glm::vec3 begin(0.0f);
    for (int index = 0; index < count; ++index) {
        const render::Contribution& part = m_parts[static_cast<std::size_t>(index)];
        paintRow(painter, index, begin);
        if (part.on)
            begin += part.radiance;
    }
    paintRow(painter, count, glm::vec3(0.0f));
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setFont(plotFont(font()));
}

void ContributionChart::paintProbe(QPainter& painter, const QPointF& place) const {
    QColor band(tokens::kText);
    band.setAlpha(22);
    painter.fillRect(QRectF(kChartPad / 2.0, kChartPad + place.y() * rowHeight(),
                            width() - kChartPad, rowHeight()),
                     band);
}

} // namespace patina::editor
