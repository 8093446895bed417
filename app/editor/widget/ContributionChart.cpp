#include "app/editor/widget/ContributionChart.h"

#include "app/editor/style/Tokens.h"
#include "core/math/Shading.h"

#include <QFontDatabase>
#include <QHelpEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QToolTip>
#include <algorithm>
#include <cmath>

namespace patina::editor {
namespace {

constexpr int kPad = 8;
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

QString numbers(const glm::vec3& c) {
    return QStringLiteral("%1  %2  %3")
        .arg(QString::fromStdString(render::numberText(c.x)),
             QString::fromStdString(render::numberText(c.y)),
             QString::fromStdString(render::numberText(c.z)));
}

float positive(float x) {
    return x > 0.0f && std::isfinite(x) ? x : 0.0f;
}

} // namespace

ContributionChart::ContributionChart(QWidget* parent)
    : QWidget(parent) {
    setObjectName(QStringLiteral("contributions"));
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
    setAccessibleName(tr("Contributions"));
    setStatusTip(tr("What the light of this pixel is made of; click a bar to see its formula"));
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
    setAccessibleDescription(sentence.join(QStringLiteral(", ")));
    if (grows)
        updateGeometry();
    update();
}

void ContributionChart::setChannels(bool channels) {
    m_channels = channels;
    update();
}

int ContributionChart::rowHeight() const {
    return fontMetrics().height() + 6;
}

QSize ContributionChart::sizeHint() const {
    return {300, rowHeight() * static_cast<int>(m_parts.size() + 1) + 2 * kPad};
}

QSize ContributionChart::minimumSizeHint() const {
    return {220, sizeHint().height()};
}

void ContributionChart::changeEvent(QEvent* event) {
    if (event->type() == QEvent::FontChange)
        updateGeometry();
    QWidget::changeEvent(event);
}

QRectF ContributionChart::barArea() const {
    const QFontMetricsF metrics(font());
    double label = metrics.horizontalAdvance(tr("Sum"));
    for (const render::Contribution& part : m_parts)
        label = std::max(label, metrics.horizontalAdvance(QString::fromStdString(part.label)));
    label = std::min(label, 0.42 * width());
    const double number = metrics.horizontalAdvance(QStringLiteral("0.0000  100 %"));
    const double left = kPad + label + kPad, right = width() - kPad - number - kPad;
    return {left, double{kPad}, std::max(right - left, 10.0),
            double(rowHeight()) * static_cast<double>(m_parts.size() + 1)};
}

int ContributionChart::rowAt(const QPoint& position) const {
    const int row = (position.y() - kPad) / rowHeight();
    return position.y() >= kPad && row <= static_cast<int>(m_parts.size()) ? row : -1;
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

void ContributionChart::paintRow(QPainter& painter, int row, const QString& label,
                                 const glm::vec3& begin, const render::Contribution& part,
                                 const QString& number) const {
    const QRectF area = barArea();
    const double top = kPad + double(row) * rowHeight(), height = rowHeight();
    const QFontMetricsF metrics(painter.font());
    painter.setPen(part.on ? QColor(tokens::kText) : QColor(tokens::kTextOff));
    painter.drawText(QRectF(kPad, top, area.left() - 2 * kPad, height),
                     Qt::AlignLeft | Qt::AlignVCenter,
                     metrics.elidedText(label, Qt::ElideRight, area.left() - 2 * kPad));
    painter.drawText(QRectF(area.right() + kPad, top, width() - area.right() - 2 * kPad, height),
                     Qt::AlignRight | Qt::AlignVCenter, number);

    const float whole = largest();
    if (!part.on || whole <= 0.0f)
        return;
    const auto bar = [&](double y, double thickness, float from, float length, const QColor& color,
                         bool hatched) {
        const double scale = area.width() / static_cast<double>(whole);
        const double x = area.left() + scale * static_cast<double>(positive(from));
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

void ContributionChart::paintEvent(QPaintEvent*) {
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(Qt::NoPen);
    painter.setBrush(QColor(tokens::kWell));
    painter.drawRoundedRect(rect(), tokens::kRadius, tokens::kRadius);
    painter.setRenderHint(QPainter::Antialiasing, false);
    const QRectF area = barArea();
    const auto count = static_cast<int>(m_parts.size());
    painter.setPen(QColor(tokens::kLine));
    painter.drawLine(QPointF(area.left(), area.top()), QPointF(area.left(), area.bottom()));
    const double sumTop = kPad + double(count) * rowHeight();
    painter.drawLine(QPointF(kPad, sumTop), QPointF(width() - kPad, sumTop));

    glm::vec3 begin(0.0f);
    for (int row = 0; row < count; ++row) {
        const render::Contribution& part = m_parts[static_cast<std::size_t>(row)];
        paintRow(painter, row, QString::fromStdString(part.label), begin, part,
                 part.on ? shareText(part.radiance) : tr("off"));
        if (part.on)
            begin += part.radiance;
    }
    paintRow(painter, count, tr("Sum"), glm::vec3(0.0f), {"sum", {}, m_sum, glm::vec3(0.0f), true},
             shareText(m_sum));
}

void ContributionChart::mouseReleaseEvent(QMouseEvent* event) {
    const int row = rowAt(event->pos());
    if (row >= 0 && rect().contains(event->pos()))
        Q_EMIT chosen(row < static_cast<int>(m_parts.size())
                          ? QString::fromStdString(m_parts[static_cast<std::size_t>(row)].key)
                          : QStringLiteral("sum"));
}

bool ContributionChart::event(QEvent* event) {
    if (event->type() != QEvent::ToolTip)
        return QWidget::event(event);
    const auto* help = static_cast<QHelpEvent*>(event);
    const int row = rowAt(help->pos());
    if (row < 0) {
        QToolTip::hideText();
        return true;
    }
    if (row == static_cast<int>(m_parts.size())) {
        QToolTip::showText(help->globalPos(), tr("Sum: %1 cd/m²").arg(numbers(m_sum)), this);
        return true;
    }
    const render::Contribution& part = m_parts[static_cast<std::size_t>(row)];
    QString text = QString::fromStdString(part.label) +
                   QStringLiteral(": %1 cd/m²").arg(numbers(part.radiance));
    if (part.specular != glm::vec3(0.0f))
        text += tr("\nof it specular: %1").arg(numbers(part.specular));
    if (!part.on)
        text += tr("\nswitched off");
    QToolTip::showText(help->globalPos(), text, this);
    return true;
}

} // namespace patina::editor
