#include "app/editor/widget/Fader.h"

#include "app/editor/style/FocusRing.h"
#include "app/editor/style/Tokens.h"

#include <QMouseEvent>
#include <QPainter>
#include <algorithm>
#include <cmath>

namespace patina::editor {
namespace {

constexpr int kUnitsPerEv = 20; // of QAbstractSlider, which counts whole numbers
constexpr int kStep = 2, kPage = 20;
constexpr double kTop = 9, kBottom = 9; // free for half of the handle
constexpr double kHandleHeight = 14, kHandleWidth = 26;
constexpr double kTrackX = 34, kMeterX = 54, kMeterWidth = 6;

int units(double ev) {
    return static_cast<int>(std::lround(ev * kUnitsPerEv));
}

} // namespace

Fader::Fader(QWidget* parent)
    : QAbstractSlider(parent) {
    setOrientation(Qt::Vertical);
    setRange(units(-kMaxEv), units(kMaxEv));
    setSingleStep(kStep);
    setPageStep(kPage);
    setFocusPolicy(Qt::StrongFocus);
    setSizePolicy(QSizePolicy::Fixed, QSizePolicy::Expanding);
}

void Fader::setEv(double ev) {
    m_ev = ev;
    const QSignalBlocker silent(this); // the slider's own value is for accessibility
    setValue(units(ev));
    update();
}

void Fader::setLevel(double share) {
    m_level = std::clamp(share, 0.0, 1.0);
    update();
}

QSize Fader::sizeHint() const {
    return {66, 130};
}
QSize Fader::minimumSizeHint() const {
    return {66, 84};
}

double Fader::position(double ev) const {
    const double t = 0.5 - std::clamp(ev, -kMaxEv, kMaxEv) / (2 * kMaxEv);
    return kTop + t * (height() - kTop - kBottom);
}

QPoint Fader::handle() const {
    return {qRound(kTrackX), qRound(position(m_ev))};
}

void Fader::dragTo(double y) {
    const double span = std::max(1.0, height() - kTop - kBottom);
    const double ev = kMaxEv * (1.0 - 2.0 * (y - kTop) / span);
    const double rounded = std::round(ev * kUnitsPerEv) / kUnitsPerEv;
    setEv(std::clamp(rounded, -kMaxEv, kMaxEv));
    Q_EMIT dragged(m_ev);
}

void Fader::stepBy(int count) {
    const int now = units(std::clamp(m_ev, -kMaxEv, kMaxEv));
    const double ev =
        static_cast<double>(std::clamp(now + count, minimum(), maximum())) / kUnitsPerEv;
    // Beyond the scale's end there is no step further out.
    if ((count > 0) == (ev > m_ev))
        Q_EMIT stepped(ev);
}

void Fader::paintEvent(QPaintEvent*) {
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    QFont small = font();
    small.setPixelSize(10);
    painter.setFont(small);
    const double top = position(kMaxEv), bottom = position(-kMaxEv);

    // The scale: every EV a line, every second one with its number where there is room.
    const double step = (bottom - top) / (2 * kMaxEv);
    const int every = step >= 7 ? 2 : step >= 4.5 ? 3 : 6;
    for (int ev = static_cast<int>(-kMaxEv); ev <= static_cast<int>(kMaxEv); ++ev) {
        const double y = position(ev);
        const bool named = ev % every == 0;
        painter.setPen(QColor(ev == 0 ? tokens::kTextDim : tokens::kLine));
        painter.drawLine(QPointF(kTrackX - (named ? 12 : 8), y), QPointF(kTrackX + 12, y));
        if (named) {
            painter.setPen(QColor(tokens::kTextDim));
            painter.drawText(QRectF(0, y - 7, kTrackX - 15, 14), Qt::AlignRight | Qt::AlignVCenter,
                             ev > 0 ? QStringLiteral("+%1").arg(ev)
                                    : QString::number(ev).replace(u'-', QChar(0x2212)));
        }
    }

    painter.setPen(Qt::NoPen);
    painter.setBrush(QColor(tokens::kWell));
    painter.drawRoundedRect(QRectF(kTrackX - 2, top, 4, bottom - top), 2, 2);
    painter.drawRoundedRect(QRectF(kMeterX, top, kMeterWidth, bottom - top), 2, 2);
    if (m_level > 0.0) {
        const double height = m_level * (bottom - top);
        painter.setBrush(QColor(tokens::kAccent));
        painter.drawRoundedRect(QRectF(kMeterX, bottom - height, kMeterWidth, height), 2, 2);
    }

    const QRectF grip(kTrackX - kHandleWidth / 2, position(m_ev) - kHandleHeight / 2, kHandleWidth,
                      kHandleHeight);
    painter.setPen(QPen(QColor(hasFocus() ? tokens::kFocus : tokens::kWindow), hasFocus() ? 2 : 1));
    painter.setBrush(QColor(underMouse() || isSliderDown() ? tokens::kTextDim : tokens::kTextOff));
    painter.drawRoundedRect(grip, 3, 3);
    painter.setPen(QPen(QColor(tokens::kWell), 2));
    painter.drawLine(QPointF(grip.left() + 4, grip.center().y()),
                     QPointF(grip.right() - 4, grip.center().y()));
}

void Fader::mousePressEvent(QMouseEvent* event) {
    if (event->button() != Qt::LeftButton)
        return;
    setSliderDown(true);
    m_pressY = event->position().y();
    m_startEv = m_ev;
    const double offset = position(m_ev) - m_pressY;
    const bool onHandle = std::abs(offset) <= kHandleHeight / 2 + 1;
    m_grab = onHandle ? offset : 0.0;
    Q_EMIT dragStarted();
    if (!onHandle) {
        dragTo(m_pressY);
        m_pressY = -1e9; // a jump has no way back by the hand
    }
}

void Fader::mouseMoveEvent(QMouseEvent* event) {
    if (!isSliderDown())
        return;
    if (std::abs(event->position().y() - m_pressY) < 0.5) {
        setEv(m_startEv); // back where it was taken: exactly that value
        Q_EMIT dragged(m_startEv);
    } else {
        dragTo(event->position().y() + m_grab);
    }
}

void Fader::mouseReleaseEvent(QMouseEvent* event) {
    if (event->button() != Qt::LeftButton || !isSliderDown())
        return;
    setSliderDown(false);
    Q_EMIT dragFinished();
    update();
}

void Fader::abandonEdit() {
    setSliderDown(false);
    update();
}

void Fader::mouseDoubleClickEvent(QMouseEvent* event) {
    if (event->button() == Qt::LeftButton)
        Q_EMIT edited(0.0);
}

void Fader::keyPressEvent(QKeyEvent* event) {
    switch (event->key()) {
    case Qt::Key_Up:
    case Qt::Key_Right:
        return stepBy(kStep);
    case Qt::Key_Down:
    case Qt::Key_Left:
        return stepBy(-kStep);
    case Qt::Key_PageUp:
        return stepBy(kPage);
    case Qt::Key_PageDown:
        return stepBy(-kPage);
    case Qt::Key_Home:
        Q_EMIT edited(0.0);
        return;
    default:
        QAbstractSlider::keyPressEvent(event);
    }
}

// As for the numbers of the panels: the wheel scrolls the desk unless the fader has the focus.
void Fader::wheelEvent(QWheelEvent* event) {
    if (!hasFocus() || event->angleDelta().y() == 0) {
        event->ignore();
        return;
    }
    stepBy(event->angleDelta().y() > 0 ? kStep : -kStep);
    event->accept();
}

void Fader::enterEvent(QEnterEvent*) {
    update();
}
void Fader::leaveEvent(QEvent*) {
    update();
}

} // namespace patina::editor
