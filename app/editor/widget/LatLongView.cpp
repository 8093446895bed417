#include "app/editor/widget/LatLongView.h"

#include "app/editor/style/FocusRing.h"
#include "app/editor/style/Tokens.h"
#include "core/light/LatLongGrid.h"
#include "core/scene/ImageProblem.h"

#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>
#include <algorithm>
#include <cmath>

namespace patina::editor {
namespace {

constexpr double kSunRadius = 7, kSunReach = 13;
constexpr double kDragDistance = 3; // a click that trembles moves nothing
constexpr double kFine = 0.1;       // with Shift

Qt::CursorShape cursorOf(SoftboxHandle handle) {
    switch (handle) {
    case SoftboxHandle::Left:
    case SoftboxHandle::Right:
        return Qt::SizeHorCursor;
    case SoftboxHandle::Top:
    case SoftboxHandle::Bottom:
        return Qt::SizeVerCursor;
    case SoftboxHandle::TopLeft:
    case SoftboxHandle::BottomRight:
        return Qt::SizeFDiagCursor;
    case SoftboxHandle::TopRight:
    case SoftboxHandle::BottomLeft:
        return Qt::SizeBDiagCursor;
    case SoftboxHandle::Roll:
        return Qt::PointingHandCursor;
    case SoftboxHandle::Body:
        return Qt::SizeAllCursor;
    case SoftboxHandle::None:
        break;
    }
    return Qt::ArrowCursor;
}

// Moved to the right by a share of its width, what leaves coming in again: drawn in two parts a
// line would show between them.
QImage rolled(const QImage& picture, double share) {
    const int width = picture.width(),
              offset = static_cast<int>(std::lround(share * width)) % width;
    QImage result(picture.size(), QImage::Format_RGB32);
    for (int y = 0; y < picture.height(); ++y) {
        const auto* from = reinterpret_cast<const QRgb*>(picture.constScanLine(y));
        auto* to = reinterpret_cast<QRgb*>(result.scanLine(y));
        std::rotate_copy(from, from + (width - offset) % width, from + width, to);
    }
    return result;
}

} // namespace

LatLongView::LatLongView(QWidget* parent)
    : QWidget(parent) {
    setObjectName(QStringLiteral("environment"));
    setAccessibleName(tr("Environment"));
    setFocusPolicy(Qt::StrongFocus);
    setMouseTracking(true);
    setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Fixed);
    updateHelp();
}

void LatLongView::setEnvironment(const Environment& environment) {
    const bool otherKind = environment.kind != m_environment.kind;
    m_environment = environment;
    m_environment.image = m_environment.fileImage = nullptr;
    if (!m_environment.softboxes.empty() && !selectedSoftbox())
        m_selected = 0;
    if (otherKind) {
        endDrag(false);
        updateHelp();
    }
    update();
}

void LatLongView::setPicture(const QImage& picture) {
    m_picture = picture;
    update();
}

void LatLongView::setSelected(Id softbox) {
    m_selected = softbox;
    update();
}

void LatLongView::updateHelp() {
    QString help;
    switch (m_environment.kind) {
    case EnvironmentKind::Image:
        help = tr("Drag to rotate the environment. Shift is fine, Esc cancels, arrow keys rotate.");
        break;
    case EnvironmentKind::Sky:
        help = tr("Drag the sun, or click to set it. Shift is fine, Esc cancels, arrow keys move.");
        break;
    case EnvironmentKind::Softboxes:
        help = tr("Double-click to add a softbox, drag it or its handles; Shift keeps its shape. "
                  "Arrow keys move, Delete removes, Esc cancels.");
        break;
    }
    setToolTip(help);
    setStatusTip(help);
    setAccessibleDescription(help);
}

LatLongMap LatLongView::map() const {
    return {QRectF(rect()).adjusted(1, 1, -1, -1), m_environment.rotationDeg,
            m_environment.kind == EnvironmentKind::Image ? 180.0 : 0.0};
}

QSize LatLongView::sizeHint() const {
    return {288, 144};
}
QSize LatLongView::minimumSizeHint() const {
    return {160, 80};
}

const Softbox* LatLongView::selectedSoftbox() const {
    const auto found = std::ranges::find(m_environment.softboxes, m_selected, &Softbox::id);
    return found == m_environment.softboxes.end() ? nullptr : &*found;
}

// The selected one first, then whichever is drawn last.
const Softbox* LatLongView::softboxAt(const QPointF& point) const {
    const glm::dvec3 direction = map().direction(point);
    const auto contains = [&](const Softbox& softbox) {
        const SoftboxShape shape(softbox);
        const auto local = shape.local(direction);
        return local && std::abs(local->x) <= shape.half().x &&
               std::abs(local->y) <= shape.half().y;
    };
    if (const Softbox* selected = selectedSoftbox(); selected && contains(*selected))
        return selected;
    const auto& softboxes = m_environment.softboxes;
    const auto last = std::find_if(softboxes.rbegin(), softboxes.rend(), contains);
    return last == softboxes.rend() ? nullptr : &*last;
}

QPointF LatLongView::sunPoint() const {
    return map().point(
        directionFromAngles(m_environment.sky.sunAzimuthDeg, m_environment.sky.sunElevationDeg));
}

// --- Mouse ---------------------------------------------------------------------------------------

void LatLongView::hover(const QPointF& point) {
    const Id before = m_hovered;
    const bool sunBefore = m_overSun;
    m_hovered = 0;
    m_overSun = false;
    switch (m_environment.kind) {
    case EnvironmentKind::Image:
        setCursor(Qt::SizeHorCursor);
        break;
    case EnvironmentKind::Sky: {
        const QPointF way = sunPoint() - point;
        m_overSun = std::hypot(way.x(), way.y()) < kSunReach;
        setCursor(m_overSun ? Qt::SizeAllCursor : Qt::CrossCursor);
        break;
    }
    case EnvironmentKind::Softboxes: {
        SoftboxHandle handle = SoftboxHandle::None;
        if (const Softbox* selected = selectedSoftbox())
            handle = handleAt(*selected, map(), point);
        if (const Softbox* softbox = softboxAt(point)) {
            m_hovered = softbox->id;
            if (handle == SoftboxHandle::None)
                handle = SoftboxHandle::Body;
        }
        setCursor(cursorOf(handle));
        break;
    }
    }
    if (before != m_hovered || sunBefore != m_overSun)
        update();
}

void LatLongView::mousePressEvent(QMouseEvent* event) {
    if (event->button() != Qt::LeftButton || m_pressed)
        return;
    const QPointF point = event->position();
    m_handle = SoftboxHandle::None;
    if (m_environment.kind == EnvironmentKind::Softboxes) {
        if (const Softbox* selected = selectedSoftbox())
            m_handle = handleAt(*selected, map(), point);
        if (m_handle == SoftboxHandle::None) {
            const Softbox* softbox = softboxAt(point);
            const Id id = softbox ? softbox->id : 0;
            if (id != m_selected) {
                m_selected = id;
                update();
                Q_EMIT softboxSelected(id);
            }
            if (id == 0)
                return;
            m_handle = SoftboxHandle::Body;
        }
    }
    m_pressed = true;
    m_dragging = false;
    m_from = m_at = m_mouse = point;
    m_start = m_environment;
    m_startMap = map();
    if (m_environment.kind == EnvironmentKind::Sky) {
        // A press beside the sun brings it there; a press on it takes it as it is.
        const QPointF way = sunPoint() - point;
        if (std::hypot(way.x(), way.y()) >= kSunReach) {
            m_dragging = true;
            Q_EMIT dragStarted();
            const glm::dvec2 angles = m_startMap.angles(point);
            m_start.sky.sunAzimuthDeg = static_cast<float>(angles.x);
            m_start.sky.sunElevationDeg = static_cast<float>(std::max(0.0, angles.y));
            follow();
        }
    }
}

void LatLongView::mouseMoveEvent(QMouseEvent* event) {
    if (!m_pressed) {
        if (event->buttons() == Qt::NoButton)
            hover(event->position());
        return;
    }
    m_shift = event->modifiers().testFlag(Qt::ShiftModifier);
    const bool slow =
        m_shift && (m_handle == SoftboxHandle::None || m_handle == SoftboxHandle::Body);
    m_at += (event->position() - m_mouse) * (slow ? kFine : 1.0);
    m_mouse = event->position();
    if (!m_dragging) {
        const QPointF way = m_at - m_from;
        if (std::hypot(way.x(), way.y()) < kDragDistance * (slow ? kFine : 1.0))
            return;
        m_dragging = true;
        Q_EMIT dragStarted();
    }
    follow();
}

void LatLongView::follow() {
    const glm::dvec2 way = m_startMap.anglesOfWay(m_at - m_from);
    switch (m_start.kind) {
    case EnvironmentKind::Image:
        // The picture goes with the mouse, to the right that is clockwise.
        Q_EMIT turned(wrapDeg(m_start.rotationDeg + way.x));
        break;
    case EnvironmentKind::Sky:
        Q_EMIT sunMoved(wrapDeg(m_start.sky.sunAzimuthDeg + way.x),
                        std::clamp(m_start.sky.sunElevationDeg + way.y, 0.0, 90.0));
        break;
    case EnvironmentKind::Softboxes: {
        const auto start = std::ranges::find(m_start.softboxes, m_selected, &Softbox::id);
        if (start != m_start.softboxes.end())
            Q_EMIT softboxShaped(
                draggedSoftbox(*start, m_handle, m_startMap, m_from, m_at, m_shift));
        break;
    }
    }
}

void LatLongView::mouseReleaseEvent(QMouseEvent* event) {
    if (event->button() != Qt::LeftButton || !m_pressed)
        return;
    endDrag(false);
    hover(event->position());
}

void LatLongView::endDrag(bool cancel) {
    const bool dragging = m_dragging;
    m_pressed = m_dragging = false;
    if (!dragging)
        return;
    if (cancel)
        Q_EMIT dragCancelled();
    else
        Q_EMIT dragFinished();
}

void LatLongView::mouseDoubleClickEvent(QMouseEvent* event) {
    if (event->button() != Qt::LeftButton || m_environment.kind != EnvironmentKind::Softboxes ||
        softboxAt(event->position())) {
        mousePressEvent(event);
        return;
    }
    const glm::dvec2 angles = map().angles(event->position());
    Q_EMIT addRequested(angles.x, angles.y);
}

void LatLongView::leaveEvent(QEvent*) {
    m_hovered = 0;
    m_overSun = false;
    update();
}

// --- Keyboard ------------------------------------------------------------------------------------

bool LatLongView::event(QEvent* event) {
    // These keys are for the view while it has the focus, whatever the window uses them for.
    if (event->type() == QEvent::ShortcutOverride) {
        const int key = static_cast<QKeyEvent*>(event)->key();
        const bool arrow = key >= Qt::Key_Left && key <= Qt::Key_Down;
        if (arrow || key == Qt::Key_Delete || key == Qt::Key_Backspace ||
            (key == Qt::Key_Escape && m_pressed)) {
            event->accept();
            return true;
        }
    }
    return QWidget::event(event);
}

void LatLongView::keyPressEvent(QKeyEvent* event) {
    const double step = event->modifiers().testFlag(Qt::ShiftModifier)     ? 0.1
                        : event->modifiers().testFlag(Qt::ControlModifier) ? 10.0
                                                                           : 1.0;
    bool done = true;
    switch (event->key()) {
    case Qt::Key_Left:
        done = nudge({step, 0}); // azimuth grows to the left
        break;
    case Qt::Key_Right:
        done = nudge({-step, 0});
        break;
    case Qt::Key_Up:
        done = nudge({0, step});
        break;
    case Qt::Key_Down:
        done = nudge({0, -step});
        break;
    case Qt::Key_Delete:
    case Qt::Key_Backspace:
        done = !m_pressed && m_environment.kind == EnvironmentKind::Softboxes && selectedSoftbox();
        if (done)
            Q_EMIT removeRequested(m_selected);
        break;
    case Qt::Key_Escape:
        done = m_pressed;
        endDrag(true);
        break;
    default:
        done = false;
    }
    if (!done)
        QWidget::keyPressEvent(event);
}

bool LatLongView::nudge(const QPointF& degrees) {
    if (m_pressed)
        return true; // the mouse has it
    switch (m_environment.kind) {
    case EnvironmentKind::Image:
        if (degrees.x() == 0)
            return false;
        Q_EMIT turned(wrapDeg(m_environment.rotationDeg + degrees.x()));
        return true;
    case EnvironmentKind::Sky:
        Q_EMIT sunMoved(wrapDeg(m_environment.sky.sunAzimuthDeg + degrees.x()),
                        std::clamp(m_environment.sky.sunElevationDeg + degrees.y(), 0.0, 90.0));
        return true;
    case EnvironmentKind::Softboxes:
        break;
    }
    const Softbox* selected = selectedSoftbox();
    if (!selected)
        return false;
    Softbox moved = *selected;
    moved.azimuthDeg = static_cast<float>(wrapDeg(selected->azimuthDeg + degrees.x()));
    moved.elevationDeg =
        static_cast<float>(std::clamp(selected->elevationDeg + degrees.y(), -90.0, 90.0));
    Q_EMIT softboxShaped(moved);
    return true;
}

void LatLongView::focusInEvent(QFocusEvent*) {
    update();
}
void LatLongView::focusOutEvent(QFocusEvent*) {
    update();
}
// Twice as wide as high in a dock of any width. Not by heightForWidth(): a scroll area does not ask
// for it. A scroll bar that comes with the height and goes with it must not make it swing.
void LatLongView::resizeEvent(QResizeEvent*) {
    constexpr int kSlack = 8;
    const int wanted = width() / 2;
    if (wanted > height() || wanted < height() - kSlack)
        setFixedHeight(wanted);
    Q_EMIT resized();
}

// --- Painting ------------------------------------------------------------------------------------

void LatLongView::paintEvent(QPaintEvent*) {
    QPainter painter(this);
    painter.setRenderHints(QPainter::Antialiasing | QPainter::SmoothPixmapTransform);
    const LatLongMap shown = map();
    const QRectF area = shown.area();
    QPainterPath frame;
    frame.addRoundedRect(area, tokens::kRadius, tokens::kRadius);
    painter.save();
    painter.setClipPath(frame);
    painter.fillRect(area, QColor(tokens::kWell));
    const QString problem = QString::fromStdString(environmentProblem(m_environment));
    if (!problem.isEmpty())
        paintHint(painter, tr("%1; a neutral grey stands in").arg(problem));
    else if (!m_picture.isNull())
        painter.drawImage(area, rolled(m_picture, shown.shift() / area.width()));
    paintCompass(painter);
    if (m_environment.kind == EnvironmentKind::Sky)
        paintSun(painter);
    if (m_environment.kind == EnvironmentKind::Softboxes) {
        paintSoftboxes(painter);
        if (m_environment.softboxes.empty())
            paintHint(painter, tr("Double-click to add a softbox"));
    }
    painter.restore();
    painter.setPen(QPen(QColor(hasFocus() ? tokens::kFocus : tokens::kLine), 1));
    painter.setBrush(Qt::NoBrush);
    painter.drawPath(frame);
}

// The horizon, and the sides as seen from the model.
void LatLongView::paintCompass(QPainter& painter) const {
    const QRectF area = map().area();
    painter.setPen(QPen(QColor(255, 255, 255, 46), 1));
    painter.drawLine(QPointF(area.left(), area.center().y()),
                     QPointF(area.right(), area.center().y()));
    QFont small = font();
    small.setPixelSize(10);
    painter.setFont(small);
    // The letters stay readable on snow.
    QLinearGradient shade(area.bottomLeft() - QPointF(0, 26), area.bottomLeft());
    shade.setColorAt(0, QColor(0, 0, 0, 0));
    shade.setColorAt(1, QColor(0, 0, 0, 150));
    painter.fillRect(QRectF(area.left(), area.bottom() - 26, area.width(), 26), shade);
    const bool frontInTheMiddle = m_environment.kind != EnvironmentKind::Image;
    const QString front = tr("Front"), back = tr("Back"), left = tr("Left"), right = tr("Right");
    const QString names[] = {frontInTheMiddle ? back : front, frontInTheMiddle ? right : left,
                             frontInTheMiddle ? front : back, frontInTheMiddle ? left : right};
    for (int quarter = 0; quarter <= 4; ++quarter) {
        const double x = area.left() + 0.25 * quarter * area.width();
        painter.setPen(QPen(QColor(255, 255, 255, 46), 1));
        if (quarter % 4 != 0)
            painter.drawLine(QPointF(x, area.center().y() - 3), QPointF(x, area.center().y() + 3));
        QRectF box(0, 0, 60, 14);
        box.moveBottom(area.bottom() - 2);
        const bool first = quarter == 0, last = quarter == 4;
        if (first)
            box.moveLeft(area.left() + 5);
        else if (last)
            box.moveRight(area.right() - 5);
        else
            box.moveCenter({x, box.center().y()});
        painter.setPen(QColor(255, 255, 255, 215));
        painter.drawText(box,
                         (first  ? Qt::AlignLeft
                          : last ? Qt::AlignRight
                                 : Qt::AlignHCenter) |
                             Qt::AlignVCenter,
                         names[quarter % 4]);
    }
}

void LatLongView::paintSun(QPainter& painter) const {
    const double width = map().area().width();
    for (const double turn : {-width, 0.0, width}) {
        const QPointF point = sunPoint() + QPointF(turn, 0);
        painter.setBrush(Qt::NoBrush);
        painter.setPen(QPen(QColor(0, 0, 0, 140), 3.5));
        painter.drawEllipse(point, kSunRadius, kSunRadius);
        painter.setPen(
            QPen(QColor(m_overSun || m_dragging ? tokens::kAccent : tokens::kText), 1.6));
        painter.drawEllipse(point, kSunRadius, kSunRadius);
    }
}

void LatLongView::paintSoftboxes(QPainter& painter) const {
    const LatLongMap shown = map();
    const auto paint = [&](const Softbox& softbox) {
        const bool isSelected = softbox.id == m_selected;
        const QPainterPath outline = shown.outline(SoftboxShape(softbox));
        painter.setBrush(Qt::NoBrush);
        painter.setPen(QPen(QColor(0, 0, 0, 130), isSelected ? 4 : 3));
        painter.drawPath(outline);
        QPen pen(QColor(isSelected                ? tokens::kAccent
                        : softbox.id == m_hovered ? tokens::kText
                                                  : tokens::kTextDim),
                 isSelected ? 1.8 : 1.2);
        if (!softbox.enabled)
            pen.setDashPattern({3, 3});
        painter.setPen(pen);
        painter.drawPath(outline);
    };
    for (const Softbox& softbox : m_environment.softboxes)
        if (softbox.id != m_selected)
            paint(softbox);
    const Softbox* selected = selectedSoftbox();
    if (!selected)
        return;
    paint(*selected);

    const std::vector<SoftboxHandlePoint> handles = handlesOf(*selected, shown);
    const QColor fill(tokens::kText), edge(0, 0, 0, 190);
    for (const SoftboxHandlePoint& handle : handles) {
        painter.setPen(QPen(edge, 1));
        painter.setBrush(fill);
        if (handle.handle == SoftboxHandle::Roll) {
            painter.setBrush(QColor(tokens::kAccent));
            painter.drawEllipse(handle.point, 4, 4);
        } else {
            painter.drawRect(QRectF(handle.point - QPointF(3, 3), QSizeF(6, 6)));
        }
    }
}

void LatLongView::paintHint(QPainter& painter, const QString& text) const {
    painter.setFont(font());
    painter.setPen(QColor(tokens::kTextDim));
    painter.drawText(map().area().adjusted(8, 0, -8, -20), Qt::AlignCenter | Qt::TextWordWrap,
                     text);
}

} // namespace patina::editor
