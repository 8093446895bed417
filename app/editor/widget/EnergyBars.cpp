#include "app/editor/widget/EnergyBars.h"

#include "app/editor/style/Tokens.h"

#include <QPainter>
#include <algorithm>

namespace patina::editor {
namespace {

constexpr int kBar = 14;    // height
constexpr int kBetween = 4; // rows
constexpr int kSwatch = 10;
// Highlight, diffuse, colour, lost. Light that is seen is light; what is lost has the warning's
// colour.
constexpr std::array<QRgb, 4> kColors{0xffcfe9e3, tokens::kAccent, tokens::kRaised,
                                      tokens::kCopper};

std::array<double, 4> parts(const EnergyShares& shares) {
    // Light that is made (below 0 lost) leaves no room: the bar is full.
    return {std::max(shares.specular, 0.0), std::max(shares.diffuse, 0.0),
            std::max(shares.absorbed, 0.0), std::max(shares.lost, 0.0)};
}

} // namespace

EnergyBars::EnergyBars(QWidget* parent)
    : QWidget(parent) {
    QSizePolicy policy(QSizePolicy::Expanding, QSizePolicy::Fixed);
    policy.setHeightForWidth(true);
    setSizePolicy(policy);
    setAccessibleName(tr("Where the light goes"));
    setToolTip(tr("All light that arrives, seen from all sides on average: what the highlight and "
                  "the body return, what the colour keeps, and what the model loses between "
                  "facets."));
}

void EnergyBars::setShares(const EnergyShares& without, const EnergyShares& with,
                           bool compensated) {
    m_without = without;
    m_with = with;
    m_compensated = compensated;
    QStringList words;
    for (const Entry& entry : legend())
        words << entry.text;
    setAccessibleDescription(words.join(QStringLiteral(", ")));
    updateGeometry();
    update();
}

std::array<EnergyBars::Entry, 4> EnergyBars::legend() const {
    const std::array<double, 4> now = parts(m_compensated ? m_with : m_without);
    const std::array<QString, 4> names{tr("Highlight"), tr("Diffuse"), tr("Kept by colour"),
                                       tr("Lost")};
    std::array<Entry, 4> entries;
    for (int i = 0; i < 4; ++i)
        entries[i] = {tr("%1 %2 %").arg(names[i]).arg(100.0 * now[i], 0, 'f', 1), i};
    return entries;
}

template <class Place>
int EnergyBars::layOutLegend(int width, Place place) const {
    const int row = fontMetrics().height() + 2;
    int x = 0, y = 0;
    for (const Entry& entry : legend()) {
        const int w = kSwatch + 5 + fontMetrics().horizontalAdvance(entry.text);
        if (x > 0 && x + w > width) {
            x = 0;
            y += row;
        }
        place(entry, x, y);
        x += w + 12;
    }
    return y + row;
}

int EnergyBars::heightForWidth(int width) const {
    return 2 * (kBar + kBetween) + 2 + layOutLegend(width, [](const Entry&, int, int) {});
}
QSize EnergyBars::sizeHint() const {
    return {260, heightForWidth(260)};
}
QSize EnergyBars::minimumSizeHint() const {
    return {160, 2 * (kBar + kBetween) + fontMetrics().height()};
}

void EnergyBars::paintEvent(QPaintEvent*) {
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    const std::array<QString, 2> names{tr("Without"), tr("With")};
    const int label = std::max(fontMetrics().horizontalAdvance(names[0]),
                               fontMetrics().horizontalAdvance(names[1])) +
                      8;
    int y = 0;
    for (int i = 0; i < 2; ++i) {
        const bool shown = m_compensated == (i == 1);
        painter.setPen(QColor(shown ? tokens::kText : tokens::kTextDim));
        painter.drawText(QRect(0, y, label, kBar), Qt::AlignLeft | Qt::AlignVCenter, names[i]);
        const QRectF bar(label, y, std::max(width() - label, 10), kBar);
        painter.setPen(Qt::NoPen);
        painter.setOpacity(shown ? 1.0 : 0.6);
        double x = bar.left();
        const std::array<double, 4> shares = parts(i == 0 ? m_without : m_with);
        for (int part = 0; part < 4; ++part) {
            const double w = std::min(shares[part] * bar.width(), bar.right() - x);
            painter.fillRect(QRectF(x, bar.top(), w, bar.height()), QColor(kColors[part]));
            x += w;
        }
        painter.setOpacity(1.0);
        if (shown) {
            painter.setPen(QPen(QColor(tokens::kText), 1.0));
            painter.setBrush(Qt::NoBrush);
            painter.drawRect(bar.adjusted(0.5, 0.5, -0.5, -0.5));
        }
        y += kBar + kBetween;
    }
    const int top = y + 2;
    layOutLegend(width(), [&](const Entry& entry, int left, int down) {
        const int height = fontMetrics().height();
        painter.setPen(QPen(QColor(tokens::kLine), 1.0));
        painter.setBrush(QColor(kColors[entry.part]));
        painter.drawRect(
            QRectF(left + 0.5, top + down + (height - kSwatch) / 2 + 0.5, kSwatch, kSwatch));
        painter.setPen(QColor(tokens::kTextDim));
        painter.drawText(left + kSwatch + 5, top + down + fontMetrics().ascent(), entry.text);
    });
}

} // namespace patina::editor
