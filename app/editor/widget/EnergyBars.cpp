#include "app/editor/widget/EnergyBars.h"

#include "app/editor/style/Tokens.h"

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

std::array<QString, 4> partNames() {
    return {EnergyBars::tr("Highlight"), EnergyBars::tr("Diffuse"),
            EnergyBars::tr("Kept by colour"), EnergyBars::tr("Lost")};
}

std::array<QString, 2> rowNames() {
    return {EnergyBars::tr("Without"), EnergyBars::tr("With")};
}

} // namespace

EnergyBars::EnergyBars(QWidget* parent)
    : PlotFrame({}, Cursor::Both, Press::Nothing, parent) {
    QSizePolicy policy(QSizePolicy::Expanding, QSizePolicy::Fixed);
    policy.setHeightForWidth(true);
    setSizePolicy(policy);
    setAccessibleName(tr("Where the light goes"));
    setStatusTip(
        tr("All light that arrives, seen from all sides on average: what the highlight and the "
           "body return, what the colour keeps, and what the model loses between facets."));
    setAxes({{tr("part"), {}, 0.0, 3.0, 1.0, false, true},
             {tr("compensation"), {}, 1.0, 0.0, 1.0, false, true},
             {tr("share"), QStringLiteral(" %"), 0.0, 100.0}});
}

void EnergyBars::setShares(const EnergyShares& without, const EnergyShares& with,
                           bool compensated) {
    m_without = without;
    m_with = with;
    m_compensated = compensated;
    m_known = true;
    QStringList words;
    for (const Entry& entry : legend())
        words << entry.text;
    setDescription(words.join(QStringLiteral(", ")));
    updateGeometry();
    update();
}

std::array<EnergyBars::Entry, 4> EnergyBars::legend() const {
    const std::array<double, 4> now = parts(m_compensated ? m_with : m_without);
    const std::array<QString, 4> names = partNames();
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

// --- Places --------------------------------------------------------------------------------------

QRectF EnergyBars::bar(int row) const {
    const std::array<QString, 2> names = rowNames();
    const int label = std::max(fontMetrics().horizontalAdvance(names[0]),
                               fontMetrics().horizontalAdvance(names[1])) +
                      8;
    return QRect(label, row * (kBar + kBetween), std::max(width() - label, 10), kBar);
}

QRectF EnergyBars::segment(int row, int part) const {
    const QRectF whole = bar(row);
    const std::array<double, 4> shares = parts(row == 0 ? m_without : m_with);
    double x = whole.left();
    for (int before = 0; before < part; ++before)
        x += std::min(shares[before] * whole.width(), whole.right() - x);
    return {x, whole.top(), std::min(shares[part] * whole.width(), whole.right() - x),
            whole.height()};
}

QPointF EnergyBars::pointOf(const QPointF& place) const {
    return segment(static_cast<int>(place.y()), static_cast<int>(place.x())).center();
}

std::optional<QPointF> EnergyBars::placeAt(const QPointF& point) const {
    for (int row = 0; row < 2; ++row)
        for (int part = 0; part < 4; ++part)
            if (segment(row, part).contains(point))
                return QPointF(part, row);
    return std::nullopt;
}

QString EnergyBars::placeText(const QPointF& place) const {
    return (place.y() > 0.5 ? tr("%1, with compensation") : tr("%1, without compensation"))
        .arg(partNames()[static_cast<std::size_t>(place.x())]);
}

std::vector<PlotValue> EnergyBars::valuesAt(const QPointF& place) const {
    const std::array<double, 4> shares = parts(place.y() > 0.5 ? m_with : m_without);
    return {{{}, {100.0 * shares[static_cast<std::size_t>(place.x())]}}};
}

// --- Painting ------------------------------------------------------------------------------------

void EnergyBars::paintValues(QPainter& painter) const {
    painter.setFont(font());
    for (int row = 0; row < 2; ++row) {
        const bool shown = m_compensated == (row == 1);
        const QRectF whole = bar(row);
        painter.setPen(QColor(shown ? tokens::kText : tokens::kTextDim));
        painter.drawText(QRectF(0, whole.top(), whole.left(), kBar),
                         Qt::AlignLeft | Qt::AlignVCenter,
                         rowNames()[static_cast<std::size_t>(row)]);
        painter.setOpacity(shown ? 1.0 : 0.6);
        for (int part = 0; part < 4; ++part)
            painter.fillRect(segment(row, part), QColor(kColors[static_cast<std::size_t>(part)]));
        painter.setOpacity(1.0);
        if (!shown)
            continue;
        painter.setPen(QPen(QColor(tokens::kText), 1.0));
        painter.setBrush(Qt::NoBrush);
        painter.drawRect(whole.adjusted(0.5, 0.5, -0.5, -0.5));
    }
    const int top = 2 * (kBar + kBetween) + 2;
    layOutLegend(width(), [&](const Entry& entry, int left, int down) {
        const int height = fontMetrics().height();
        painter.setPen(QPen(QColor(tokens::kLine), 1.0));
        painter.setBrush(QColor(kColors[entry.part]));
        painter.drawRect(
            QRectF(left + 0.5, top + down + (height - kSwatch) / 2 + 0.5, kSwatch, kSwatch));
        painter.setPen(QColor(tokens::kTextDim));
        painter.drawText(left + kSwatch + 5, top + down + fontMetrics().ascent(), entry.text);
    });
    painter.setFont(plotFont(font()));
}

void EnergyBars::paintProbe(QPainter& painter, const QPointF& place) const {
    painter.setPen(QPen(QColor(tokens::kWell), 2.0));
    painter.setBrush(Qt::NoBrush);
    painter.drawRect(segment(static_cast<int>(place.y()), static_cast<int>(place.x()))
                         .adjusted(1.0, 1.0, -1.0, -1.0));
}

} // namespace patina::editor
