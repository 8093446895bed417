#include "app/editor/trace/WhittedHeatOverlay.h"

#include "app/editor/document/DocumentController.h"
#include "app/editor/document/QtText.h"
#include "app/editor/style/Tokens.h"
#include "app/editor/trace/ViewLines.h"
#include "app/editor/trace/WhittedHeat.h"
#include "app/editor/viewport/ViewportWidget.h"
#include "core/document/Document.h"
#include "core/image/ColorMap.h"

#include <QEvent>
#include <QLocale>
#include <QPainter>
#include <algorithm>
#include <string>

namespace patina::editor {
namespace {

constexpr int kHeatBarHeight = 12;
constexpr int kHeatBoxAlpha = 225; // of 255
constexpr int kLegendColumns = 36; // letters

QString countText(double count) {
    const QLocale locale;
    if (count >= 1e6)
        return WhittedHeatOverlay::tr("%1 million").arg(locale.toString(1e-6 * count, 'f', 1));
    return locale.toString(count, 'f', count < 100.0 ? 1 : 0);
}

} // namespace

WhittedHeatOverlay::WhittedHeatOverlay(WhittedHeat& heat, DocumentController& controller,
                                       ViewportWidget& viewport)
    : QWidget(&viewport)
    , m_heat(heat)
    , m_controller(controller)
    , m_viewport(viewport) {
    setObjectName(QStringLiteral("whittedHeat"));
    setAttribute(Qt::WA_TransparentForMouseEvents);
    setAttribute(Qt::WA_NoSystemBackground);
    setAccessibleName(tr("What the pixels take"));
    setGeometry(viewport.rect());
    hide();
    viewport.installEventFilter(this);
    connect(&heat, &WhittedHeat::changed, this, &WhittedHeatOverlay::follow);
}

void WhittedHeatOverlay::follow() {
    setVisible(m_heat.isOn());
    setAccessibleDescription(lines().join(QLatin1Char('\n')));
    update();
}

bool WhittedHeatOverlay::eventFilter(QObject*, QEvent* event) {
    if (event->type() == QEvent::Resize)
        setGeometry(m_viewport.rect());
    return false;
}

QStringList WhittedHeatOverlay::lines() const {
    const auto counted = m_heat.counted();
    if (!counted)
        return {tr("Counting…")};
    QStringList lines;
    if (m_heat.shown() && m_heat.picture()) {
        const auto info = std::ranges::find(rayCountInfos(), *m_heat.shown(), &RayCountInfo::kind);
        lines << tr("%1 per pixel, mean %2")
                     .arg(toQString(std::string(info->label)), countText(m_heat.picture()->mean));
    }
    if (m_heat.level() && counted->hierarchy)
        lines << tr("Level %1: %2 boxes")
                     .arg(std::min(*m_heat.level(), counted->deepestLevel))
                     .arg(m_heat.boxes().size());
    if (!counted->hierarchy)
        return lines << tr("The scene has no triangles");
    lines << tr("A ray tests %1 boxes and %2 triangles,")
                 .arg(countText(counted->boxTests), countText(counted->triangleTests))
          << tr("and without boxes %L1 triangles").arg(counted->triangles());
    if (counted->coarse)
        lines << tr("Counting finer…");
    return lines;
}

void WhittedHeatOverlay::paintBoxes(QPainter& painter) const {
    const auto counted = m_heat.counted();
    const ViewLines view(m_controller.document().view.camera, size());
    QColor color(tokens::kAccent);
    color.setAlpha(150);
    painter.setPen(QPen(color, 1.0));
    for (const TeachingHierarchy::Box& box : m_heat.boxes()) {
        const auto corner = [&](int i) {
            return counted->scene->toWorld(glm::vec3(i & 1 ? box.high.x : box.low.x,
                                                     i & 2 ? box.high.y : box.low.y,
                                                     i & 4 ? box.high.z : box.low.z));
        };
        for (int i = 0; i < 8; ++i)
            for (const int axis : {1, 2, 4})
                if ((i & axis) == 0)
                    if (const auto line = view.line(corner(i), corner(i | axis)))
                        painter.drawLine(*line);
    }
}

void WhittedHeatOverlay::paintLegend(QPainter& painter) const {
    const QStringList texts = lines();
    const int line = fontMetrics().lineSpacing(), margin = tokens::kMargin;
    const int widest =
        std::min(fontMetrics().horizontalAdvance(QString(kLegendColumns, QLatin1Char('0'))),
                 width() - 4 * margin);
    const bool hasBar = m_heat.picture().has_value();
    const int bar = hasBar ? kHeatBarHeight + line + tokens::kGap : 0;
    const QRect box(width() - widest - 3 * margin, margin, widest + 2 * margin,
                    bar + static_cast<int>(texts.size()) * line + 2 * margin);
    QColor behind(tokens::kPanel);
    behind.setAlpha(kHeatBoxAlpha);
    painter.setPen(Qt::NoPen);
    painter.setBrush(behind);
    painter.drawRoundedRect(box, tokens::kRadius, tokens::kRadius);
    const QRect inner = box.adjusted(margin, margin, -margin, -margin);
    int y = inner.top();
    painter.setPen(QColor(tokens::kText));
    if (hasBar) {
        for (int x = 0; x < inner.width(); ++x) {
            const glm::vec3 color =
                mapColor(ColorMap::Magma, static_cast<float>(x) /
                                              static_cast<float>(std::max(inner.width() - 1, 1)));
            painter.fillRect(inner.left() + x, y, 1, kHeatBarHeight,
                             QColor::fromRgbF(color.r, color.g, color.b));
        }
        y += kHeatBarHeight;
        const QRect scale(inner.left(), y, inner.width(), line);
        painter.drawText(scale, Qt::AlignLeft, QStringLiteral("0"));
        painter.drawText(scale, Qt::AlignRight, countText(m_heat.picture()->most));
        y += line + tokens::kGap;
    }
    for (const QString& text : texts) {
        const QRect row(inner.left(), y, inner.width(), line);
        painter.drawText(row, Qt::AlignLeft | Qt::AlignVCenter,
                         fontMetrics().elidedText(text, Qt::ElideRight, row.width()));
        y += line;
    }
}

void WhittedHeatOverlay::paintEvent(QPaintEvent*) {
    QPainter painter(this);
    if (m_heat.counted() && m_heat.picture())
        painter.drawImage(rect(), m_heat.picture()->image);
    painter.setRenderHint(QPainter::Antialiasing);
    paintBoxes(painter);
    paintLegend(painter);
}

} // namespace patina::editor
