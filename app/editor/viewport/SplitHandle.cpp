#include "app/editor/viewport/SplitHandle.h"

#include "app/editor/style/Tokens.h"
#include "app/editor/widget/StatusHint.h"

#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>
#include <QPainterPath>
#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>

namespace patina::editor {
namespace {

constexpr double kLineReach = 6.0;      // pixels from the line that still take it
constexpr double kKnob = 11.0;          // radius of the disc that is dragged
constexpr double kRing = 7.0;           // radius of the ring that turns
constexpr double kRingDistance = 64.0;  // from the disc
constexpr double kCaptionDistance = 84; // from the disc, the other way
constexpr double kSnapDeg = 15.0;
constexpr float kDiscMargin = 0.02f; // the disc stays inside

double length(const QPointF& v) {
    return std::hypot(v.x(), v.y());
}

} // namespace

SplitLine::SplitLine(const render::ViewSplit& split, const QSizeF& size)
    : center(static_cast<double>(split.position.x) * size.width(),
             static_cast<double>(split.position.y) * size.height()) {
    const double angle = glm::radians(static_cast<double>(split.angleDeg));
    along = {std::sin(angle), -std::cos(angle)};
    right = {std::cos(angle), std::sin(angle)};
}

QPointF SplitLine::ring() const {
    return center + kRingDistance * along;
}

double SplitLine::distance(const QPointF& point) const {
    return QPointF::dotProduct(point - center, right);
}

SplitHandle::SplitHandle(SplitModel& model, QWidget& viewport)
    : QWidget(&viewport)
    , m_model(model)
    , m_viewport(viewport) {
    setObjectName(QStringLiteral("splitHandle"));
    setAttribute(Qt::WA_TransparentForMouseEvents);
    setAccessibleName(tr("Split line"));
    hide();
    viewport.installEventFilter(this);
    connect(&m_model, &SplitModel::lineChanged, this, &SplitHandle::refresh);
    refresh();
}

void SplitHandle::refresh() {
    setGeometry(m_model.area(m_viewport.size()));
    setVisible(m_model.line().has_value());
    if (!m_model.line()) {
        m_dragged = Part::None;
        hover(Part::None);
    }
    update();
}

// --- Painting --------------------------------------------------------------------------------

void SplitHandle::paintCaption(QPainter& painter, const SplitLine& line, const QString& name,
                               double side) const {
    const QSizeF half(0.5 * fontMetrics().horizontalAdvance(name) + 8,
                      0.5 * fontMetrics().height() + 3);
    // Beside the line, below the disc, wherever the line is turned to.
    const double reach =
        half.width() * std::abs(line.right.x()) + half.height() * std::abs(line.right.y()) + 8;
    QPointF at = line.center - kCaptionDistance * line.along + side * reach * line.right;
    at.setX(std::clamp(at.x(), half.width() + 4,
                       std::max(half.width() + 4, width() - half.width() - 4)));
    at.setY(std::clamp(at.y(), half.height() + 4,
                       std::max(half.height() + 4, height() - half.height() - 4)));
    const QRectF box(at.x() - half.width(), at.y() - half.height(), 2 * half.width(),
                     2 * half.height());
    painter.setPen(Qt::NoPen);
    QColor ground(tokens::kWell);
    ground.setAlphaF(0.86f);
    painter.setBrush(ground);
    painter.drawRoundedRect(box, tokens::kRadius, tokens::kRadius);
    painter.setPen(QColor(tokens::kText));
    painter.drawText(box, Qt::AlignCenter, name);
}

void SplitHandle::paintEvent(QPaintEvent*) {
    const auto split = m_model.line();
    if (!split)
        return;
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    const SplitLine line(*split, size());
    const double far = width() + height();
    const QLineF limit(line.center - far * line.along, line.center + far * line.along);
    const auto color = [this](Part part) {
        return QColor(m_hovered == part || m_dragged == part ? tokens::kAccent : tokens::kText);
    };
    // A dark seam keeps the line visible on any picture.
    painter.setPen(QPen(QColor(0, 0, 0, 150), 4));
    painter.drawLine(limit);
    painter.setPen(QPen(color(Part::Line), 1.5));
    painter.drawLine(limit);

    painter.setBrush(QColor(tokens::kWell));
    painter.setPen(QPen(color(Part::Line), 1.5));
    painter.drawEllipse(line.center, kKnob, kKnob);
    for (const double side : {-1.0, 1.0}) { // ‹ ›
        QPainterPath arrow;
        arrow.moveTo(line.center + side * 3.5 * line.right + 3.5 * line.along);
        arrow.lineTo(line.center + side * 7.0 * line.right);
        arrow.lineTo(line.center + side * 3.5 * line.right - 3.5 * line.along);
        painter.strokePath(arrow, QPen(color(Part::Line), 1.5));
    }
    painter.setPen(QPen(color(Part::Ring), 1.5));
    painter.drawEllipse(line.ring(), kRing, kRing);
    painter.setBrush(color(Part::Ring));
    painter.drawEllipse(line.ring(), 1.5, 1.5);

    paintCaption(painter, line, m_model.leftName(), -1.0);
    paintCaption(painter, line, m_model.rightName(), 1.0);
}

// --- Mouse and keys --------------------------------------------------------------------------

SplitHandle::Part SplitHandle::partAt(const QPointF& point) const {
    const auto split = m_model.line();
    if (!split)
        return Part::None;
    const SplitLine line(*split, size());
    if (length(point - line.ring()) <= kRing + 4)
        return Part::Ring;
    if (length(point - line.center) <= kKnob + 2 || std::abs(line.distance(point)) <= kLineReach)
        return Part::Line;
    return Part::None;
}

void SplitHandle::hover(Part part) {
    if (part == m_hovered)
        return;
    m_hovered = part;
    update();
    if (part == Part::None)
        m_viewport.unsetCursor();
    else
        m_viewport.setCursor(part == Part::Ring ? Qt::PointingHandCursor : Qt::SizeAllCursor);
    showHint(m_viewport, part == Part::None ? QString()
                         : part == Part::Ring
                             ? tr("Drag to rotate the split; Shift: in steps of 15°")
                             : tr("Drag to move the split; Esc removes it"));
}

bool SplitHandle::press(const QPointF& point) {
    m_dragged = partAt(point);
    m_otherDrag = m_dragged == Part::None;
    if (m_otherDrag)
        return false;
    m_beforeDrag = *m_model.line();
    m_grab = SplitLine(m_beforeDrag, size()).center - point;
    hover(m_dragged);
    return true;
}

void SplitHandle::drag(const QPointF& point, bool inSteps) {
    if (!m_model.line())
        return;
    render::ViewSplit split = *m_model.line();
    if (m_dragged == Part::Ring) {
        const QPointF from = point - SplitLine(split, size()).center;
        if (length(from) < 1.0)
            return;
        double angle = glm::degrees(std::atan2(from.x(), -from.y()));
        if (inSteps)
            angle = kSnapDeg * std::round(angle / kSnapDeg);
        split.angleDeg = static_cast<float>(angle);
    } else {
        const QPointF center = point + m_grab;
        const auto inside = [](double at, int extent) {
            return std::clamp(static_cast<float>(at / std::max(extent, 1)), kDiscMargin,
                              1 - kDiscMargin);
        };
        split.position = {inside(center.x(), width()), inside(center.y(), height())};
    }
    m_model.moveLine(split);
}

bool SplitHandle::escape() {
    if (m_otherDrag)
        return false;
    if (m_dragged != Part::None) {
        m_dragged = Part::None;
        m_model.moveLine(m_beforeDrag);
    } else {
        m_model.removeLine();
    }
    return true;
}

bool SplitHandle::eventFilter(QObject*, QEvent* event) {
    if (event->type() == QEvent::Resize)
        setGeometry(m_model.area(m_viewport.size()));
    if (!isVisible())
        return false;
    switch (event->type()) {
    case QEvent::MouseButtonPress:
    case QEvent::MouseButtonDblClick: {
        const auto& mouse = *static_cast<QMouseEvent*>(event);
        if (m_dragged != Part::None)
            return true; // a second button changes nothing
        if (mouse.button() != Qt::LeftButton || mouse.modifiers() != Qt::NoModifier) {
            m_otherDrag = true;
            return false;
        }
        return press(mouse.position() - pos());
    }
    case QEvent::MouseMove: {
        const auto& mouse = *static_cast<QMouseEvent*>(event);
        if (m_dragged != Part::None) {
            drag(mouse.position() - pos(), mouse.modifiers() & Qt::ShiftModifier);
            return true;
        }
        if (!m_otherDrag)
            hover(partAt(mouse.position() - pos()));
        return m_hovered != Part::None;
    }
    case QEvent::MouseButtonRelease: {
        const bool ours = m_dragged != Part::None;
        m_dragged = Part::None;
        m_otherDrag = false;
        update();
        return ours;
    }
    case QEvent::Leave:
        hover(Part::None);
        return false;
    case QEvent::KeyPress:
        return static_cast<QKeyEvent*>(event)->key() == Qt::Key_Escape && escape();
    default:
        return false;
    }
}

} // namespace patina::editor
