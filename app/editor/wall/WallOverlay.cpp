#include "app/editor/wall/WallOverlay.h"

#include "app/editor/document/DocumentController.h"
#include "app/editor/document/QtText.h"
#include "app/editor/style/Tokens.h"
#include "app/editor/trace/TracedTexts.h"
#include "app/editor/wall/OwnValueControls.h"
#include "app/editor/wall/TracedCells.h"
#include "app/editor/wall/WallComparison.h"
#include "app/editor/wall/WallState.h"
#include "core/document/Document.h"
#include "core/image/ColorMap.h"

#include <QHelpEvent>
#include <QKeyEvent>
#include <QPainter>
#include <QPainterPath>
#include <QPolygonF>
#include <QStringList>
#include <QToolTip>
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <vector>

namespace patina::editor {
namespace {

constexpr int kCellFrame = 2;
constexpr int kLegendWidth = 160, kLegendHeight = 10;
constexpr double kMark = 8.0; // radius

// The part of the area on the right of the line: where the other picture is.
QPolygonF rightOf(const render::ViewSplit& line, const QRectF& area) {
    const double angle = glm::radians(static_cast<double>(line.angleDeg));
    const QPointF normal(std::cos(angle), std::sin(angle)); // y points down
    const QPointF through(area.left() + static_cast<double>(line.position.x) * area.width(),
                          area.top() + static_cast<double>(line.position.y) * area.height());
    const auto side = [&](const QPointF& p) { return QPointF::dotProduct(normal, p - through); };
    const std::array corners{area.topLeft(), area.topRight(), area.bottomRight(),
                             area.bottomLeft()};
    QPolygonF inside; // Sutherland and Hodgman, 1974
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const QPointF &from = corners[i], &to = corners[(i + 1) % corners.size()];
        const double a = side(from), b = side(to);
        if (a >= 0.0)
            inside << from;
        if ((a < 0.0) != (b < 0.0))
            inside << from + (to - from) * (a / (a - b));
    }
    return inside;
}

} // namespace

WallOverlay::WallOverlay(WallState& wall, WallComparison& comparison, const TracedCells& traced,
                         QWidget& viewport)
    : QWidget(&viewport)
    , m_wall(wall)
    , m_comparison(comparison)
    , m_traced(traced)
    , m_viewport(viewport) {
    setObjectName(QStringLiteral("wallOverlay"));
    setAttribute(Qt::WA_TransparentForMouseEvents);
    hide();
    viewport.installEventFilter(this);
    connect(&wall, &WallState::changed, this, &WallOverlay::follow);
    connect(&wall, &WallState::cellsChosen, this, &WallOverlay::follow);
    connect(&wall, &WallState::textsChanged, this, qOverload<>(&QWidget::update));
    connect(&wall, &WallState::ownChanged, this, qOverload<>(&QWidget::update));
    connect(&traced, &TracedCells::chosen, this, qOverload<>(&QWidget::update));
    connect(&traced, &TracedCells::changed, this, qOverload<>(&QWidget::update));
    connect(&comparison, &WallComparison::changed, this, qOverload<>(&QWidget::update));
    connect(&comparison, &WallComparison::measuredChanged, this, qOverload<>(&QWidget::update));
}

void WallOverlay::follow() {
    setVisible(m_wall.isOn());
    setGeometry(m_viewport.rect());
    m_layout = WallLayout::of(m_wall, size(), m_viewport.fontMetrics());
    QStringList captions;
    for (const WallLayout::Caption& caption : m_layout.captions)
        captions << caption.text;
    setAccessibleName(tr("Wall"));
    setAccessibleDescription(m_wall.problem().isEmpty() ? captions.join(QStringLiteral(", "))
                                                        : m_wall.problem());
    update();
}

bool WallOverlay::eventFilter(QObject*, QEvent* event) {
    if (event->type() == QEvent::Resize)
        follow();
    if (!m_wall.isOn())
        return false;
    if (event->type() == QEvent::ToolTip) {
        const auto* help = static_cast<QHelpEvent*>(event);
        showHelp(help->pos(), help->globalPos());
        return true;
    }
    if (event->type() == QEvent::FocusOut)
        m_comparison.setPeeking(false);
    if (event->type() == QEvent::KeyRelease || event->type() == QEvent::KeyPress) {
        const auto* key = static_cast<QKeyEvent*>(event);
        if (key->key() == Qt::Key_Space && m_comparison.isOn()) {
            if (!key->isAutoRepeat())
                m_comparison.setPeeking(event->type() == QEvent::KeyPress);
            return true;
        }
        if (event->type() == QEvent::KeyRelease)
            return false;
        const bool plain = (key->modifiers() & ~Qt::KeypadModifier) == Qt::NoModifier;
        return plain && pressKey(key->key());
    }
    return false;
}

bool WallOverlay::pressKey(int key) {
    switch (key) {
    case Qt::Key_Left:
        m_wall.moveCurrent(-1, 0);
        return true;
    case Qt::Key_Right:
        m_wall.moveCurrent(1, 0);
        return true;
    case Qt::Key_Up:
        m_wall.moveCurrent(0, -1);
        return true;
    case Qt::Key_Down:
        m_wall.moveCurrent(0, 1);
        return true;
    case Qt::Key_Return:
    case Qt::Key_Enter:
        m_wall.enlarge(m_wall.enlarged() ? std::nullopt : m_wall.current());
        return true;
    default:
        return false;
    }
}

// In the place of both pictures, with what its colours stand for and where it is largest.
void WallOverlay::paintDifference(QPainter& painter, const QRect& area) const {
    const auto& measured = m_comparison.measured();
    if (!measured || measured->map.isNull())
        return;
    painter.drawImage(area, measured->map);
    const auto number = [](float value) { return QString::number(value, 'g', 3); };
    const QFontMetrics metrics = fontMetrics();
    const QRect box(area.left() + tokens::kMargin,
                    area.bottom() - tokens::kMargin - kLegendHeight - metrics.height(),
                    kLegendWidth, kLegendHeight + metrics.height());
    painter.fillRect(box.adjusted(-tokens::kGap, -tokens::kGap / 2, tokens::kGap, tokens::kGap / 2),
                     QColor(tokens::kWell));
    for (int x = 0; x < box.width(); ++x) {
        const glm::vec3 color =
            mapColor(measured->colors, static_cast<float>(x) / static_cast<float>(box.width() - 1));
        painter.fillRect(box.left() + x, box.top(), 1, kLegendHeight,
                         QColor::fromRgbF(color.r, color.g, color.b));
    }
    painter.setPen(QColor(tokens::kText));
    const QRect scale = box.adjusted(0, kLegendHeight, 0, 0);
    painter.drawText(scale, Qt::AlignLeft | Qt::AlignVCenter, number(measured->from));
    painter.drawText(scale, Qt::AlignRight | Qt::AlignVCenter, number(measured->to));
    // FLIP's largest value: what a viewer would notice first.
    if (measured->flip.max <= 0.0)
        return;
    const double x = (measured->flip.maxPosition.x + 0.5) / measured->map.width();
    const double y = (measured->flip.maxPosition.y + 0.5) / measured->map.height();
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(QPen(QColor(tokens::kAccent), 1.5));
    painter.drawEllipse(QPointF(area.left() + x * area.width(), area.top() + y * area.height()),
                        kMark, kMark);
}

// A picture from a file as the other one of two, over the cell that it is compared with.
void WallOverlay::paintFile(QPainter& painter, const QRect& area) const {
    const WallComparison::Shown shown = m_comparison.shown();
    if (!shown.any || m_comparison.filePicture().isNull())
        return;
    painter.save();
    painter.setRenderHint(QPainter::SmoothPixmapTransform);
    if (shown.split) {
        QPainterPath part;
        part.addPolygon(rightOf(*shown.split, area));
        painter.setClipPath(part);
    }
    painter.setOpacity(static_cast<double>(shown.opacity));
    painter.drawImage(area, m_comparison.filePicture());
    painter.restore();
}

// At the lower edge of cells that have values of their own: which, in one colour for all cells
// that have the same.
void WallOverlay::paintOwnValues(QPainter& painter) const {
    constexpr std::array<QRgb, 4> kColors{tokens::kAccent, tokens::kCopper, 0xff7aa7e0, 0xffc58fd9};
    std::vector<const WallCell*> seen;
    for (std::size_t i = 0; i < std::min(m_layout.cells.size(), m_wall.cells().size()); ++i) {
        const WallCell& own = m_wall.cells()[i];
        const QRect& cell = m_layout.cells[i];
        if (own.own.isEmpty() || cell.isNull())
            continue;
        const auto known = std::ranges::find_if(
            seen, [&](const WallCell* other) { return other->own == own.own; });
        const auto group = static_cast<std::size_t>(known - seen.begin());
        if (known == seen.end())
            seen.push_back(&own);
        QStringList texts;
        const Document& document = m_wall.controller().document();
        for (const CellElement element : kCellElements) {
            const Id id = own.own.element(element);
            if (id == 0)
                continue;
            const QString name = elementName(document, element, id);
            texts << (name.isEmpty() ? tr("%1 removed").arg(elementLabel(element)) : name);
        }
        for (const CellEdit& edit : own.own.values)
            texts << ownValueText(edit);
        const QString text =
            fontMetrics().elidedText(texts.join(QStringLiteral(" · ")), Qt::ElideRight,
                                     std::max(cell.width() - 3 * tokens::kGap, 0));
        QRect label = fontMetrics().boundingRect(text).adjusted(-tokens::kGap / 2, 0,
                                                                tokens::kGap / 2, tokens::kGap / 4);
        if (m_wall.compared() == i) // in the place of the other one
            label.moveBottomRight(cell.bottomRight() - QPoint(tokens::kGap / 2, tokens::kGap / 2));
        else
            label.moveBottomLeft(cell.bottomLeft() + QPoint(tokens::kGap / 2, -tokens::kGap / 2));
        painter.fillRect(label, QColor(tokens::kWell));
        painter.fillRect(QRect(label.left(), label.top(), kCellFrame, label.height()),
                         QColor(kColors[group % kColors.size()]));
        painter.setPen(QColor(tokens::kText));
        painter.drawText(label, Qt::AlignCenter, text);
    }
}

// At the upper edge of its cell, of the other one of two at the right.
WallOverlay::Badge WallOverlay::badgeOf(std::size_t cell) const {
    const std::optional<TracedBy> tracer = m_traced.tracer(cell);
    if (!tracer || cell >= m_layout.cells.size() || m_layout.cells[cell].isNull())
        return {};
    const QRect& area = m_layout.cells[cell];
    const TraceProgress progress = m_traced.progress(cell);
    const int room = area.width() - 2 * tokens::kGap;
    Badge badge;
    if (m_traced.isRefused(cell)) {
        badge.text = tr("Not traced: too large");
        badge.help = tr("All traced cells together may have %1 million pixels. Make the window "
                        "smaller, or trace fewer cells.")
                         .arg(TracedCells::kMostPixels >> 20);
    } else {
        const QString whole = tracedText(*tracer, progress, TracedRoom::Cell);
        badge.text = fontMetrics().horizontalAdvance(whole) <= room
                         ? whole
                         : tracedText(*tracer, progress, TracedRoom::Small);
        badge.help = whole + QStringLiteral("\n\n") + tracedHelp(*tracer, progress);
    }
    badge.text = fontMetrics().elidedText(badge.text, Qt::ElideRight, std::max(room, 0));
    badge.place = fontMetrics()
                      .boundingRect(badge.text)
                      .adjusted(-tokens::kGap / 2, 0, tokens::kGap / 2, tokens::kGap / 4);
    const QPoint inset(tokens::kGap / 2, tokens::kGap / 2);
    if (m_wall.compared() == cell)
        badge.place.moveTopRight(area.topRight() + QPoint(-inset.x(), inset.y()));
    else
        badge.place.moveTopLeft(area.topLeft() + inset);
    return badge;
}

void WallOverlay::paintBadges(QPainter& painter) const {
    for (std::size_t i = 0; i < m_layout.cells.size(); ++i) {
        const Badge badge = badgeOf(i);
        if (badge.text.isEmpty())
            continue;
        painter.fillRect(badge.place, QColor(tokens::kWell));
        painter.setPen(QColor(tokens::kText));
        painter.drawText(badge.place, Qt::AlignCenter, badge.text);
    }
}

void WallOverlay::showHelp(const QPoint& position, const QPoint& onScreen) const {
    for (std::size_t i = 0; i < m_layout.cells.size(); ++i)
        if (const Badge badge = badgeOf(i); badge.place.contains(position)) {
            QToolTip::showText(onScreen, badge.help, &m_viewport, badge.place);
            return;
        }
    QToolTip::hideText();
}

void WallOverlay::paintEvent(QPaintEvent*) {
    QPainter painter(this);
    const auto say = [&](const QRect& place, const QString& text) {
        painter.fillRect(place, QColor(tokens::kWell));
        painter.setPen(QColor(tokens::kTextDim));
        painter.drawText(place.adjusted(tokens::kGap, 0, -tokens::kGap, 0),
                         Qt::AlignCenter | Qt::TextWordWrap, text);
    };
    if (m_layout.cells.empty())
        say(rect(), m_wall.problem());
    for (const WallLayout::Caption& caption : m_layout.captions) {
        const QString text =
            m_wall.enlarged() && m_comparison.hasFile()
                ? QStringLiteral("A  %1      B  %2").arg(caption.text, m_comparison.fileName())
                : caption.text;
        painter.setPen(QColor(tokens::kText));
        painter.drawText(caption.place, static_cast<int>(caption.alignment),
                         fontMetrics().elidedText(text, Qt::ElideMiddle, caption.place.width()));
    }
    for (std::size_t i = 0; i < m_layout.cells.size(); ++i)
        if (const QString text = m_wall.text(i); !text.isEmpty() && !m_layout.cells[i].isNull())
            say(m_layout.cells[i], text);
    paintOwnValues(painter);
    if (!m_comparison.showsDifference())
        paintBadges(painter);
    if (m_comparison.hasFile() && m_wall.enlarged())
        paintFile(painter, m_layout.cells[*m_wall.enlarged()]);
    if (m_comparison.showsDifference() && m_wall.enlarged())
        paintDifference(painter, m_layout.cells[*m_wall.enlarged()]);
    const auto current = m_wall.current();
    if (current && *current < m_layout.cells.size() && !m_wall.enlarged()) {
        painter.setPen(QPen(QColor(tokens::kAccent), kCellFrame));
        painter.drawRect(m_layout.cells[*current].adjusted(1, 1, -1, -1));
    }
}

} // namespace patina::editor
