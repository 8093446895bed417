#include "app/editor/viewport/ViewThumb.h"

#include "app/editor/ViewActions.h"
#include "app/editor/style/FocusRing.h"
#include "app/editor/style/Tokens.h"

#include <QMouseEvent>
#include <QPainter>

namespace patina::editor {
namespace {
constexpr int kFrame = 2;   // around the picture
constexpr int kNameGap = 1; // above the name
constexpr double kMutedOpacity = 0.22;
} // namespace

ViewThumb::ViewThumb(ViewKind kind, QWidget* parent)
    : QAbstractButton(parent)
    , m_kind(kind) {
    const ViewInfo& info = viewInfo(kind);
    const auto text = [](std::string_view utf8) {
        return QString::fromUtf8(utf8.data(), static_cast<qsizetype>(utf8.size()));
    };
    setObjectName(QStringLiteral("thumb.") + text(info.id));
    setText(text(info.label));
    setAccessibleName(text(info.label));
    setAccessibleDescription(text(info.help));
    setFocusPolicy(Qt::TabFocus);
    setWhyEmpty({});
}

QSize ViewThumb::sizeHint() const {
    const int name = m_size == kPicture ? kNameGap + fontMetrics().height() : 0;
    return m_size + QSize(2 * kFrame, 2 * kFrame + name);
}

void ViewThumb::setPicture(const QImage& picture) {
    m_picture = picture;
    update();
}

void ViewThumb::setCurrent(bool shown, bool other) {
    if (shown == m_shown && other == m_other)
        return;
    m_shown = shown;
    m_other = other;
    update();
}

void ViewThumb::setWhyEmpty(const QString& why) {
    if (why == m_why && !toolTip().isEmpty())
        return;
    m_why = why;
    const QString key = ViewActions::keyOf(m_kind);
    const QString name = key.isEmpty() ? text() : tr("%1 (%2)").arg(text(), key);
    const std::string_view help = viewInfo(m_kind).help;
    setToolTip(name + QLatin1Char('\n') +
               (why.isEmpty() ? QString::fromUtf8(help.data(), static_cast<qsizetype>(help.size()))
                              : why));
    update();
}

void ViewThumb::setMuted(bool muted) {
    m_muted = muted;
    update();
}

void ViewThumb::makeSmall() {
    m_size = kSmallPicture;
    updateGeometry();
}

void ViewThumb::paintPicture(QPainter& painter, const QRect& place) const {
    painter.fillRect(place, QColor(tokens::kWell));
    if (m_why.isEmpty()) {
        painter.setOpacity(m_muted ? kMutedOpacity : 1.0);
        if (!m_picture.isNull())
            painter.drawImage(place, m_picture);
        painter.setOpacity(1.0);
        return;
    }
    painter.setPen(QColor(tokens::kTextOff));
    painter.drawText(place.adjusted(6, 4, -6, -4), Qt::AlignCenter | Qt::TextWordWrap,
                     tr("Does not apply"));
}

void ViewThumb::paintEvent(QPaintEvent*) {
    QPainter painter(this);
    const QRect place(QPoint(kFrame, kFrame), m_size);
    paintPicture(painter, place);
    const QRect frame = place.adjusted(-1, -1, 0, 0);
    const bool current = m_shown || m_other;
    if (current || underMouse()) {
        const QRgb color = current ? tokens::kAccent : tokens::kHover;
        QPen pen{QColor(color), 2.0};
        if (m_other && !m_shown)
            pen.setStyle(Qt::DashLine);
        pen.setJoinStyle(Qt::MiterJoin);
        painter.setPen(pen);
        painter.drawRect(frame);
    }
    if (hasFocus()) { // inside the mark of the view that is shown: both may be here
        painter.setPen(QPen{QColor(tokens::kWell), 4.0});
        painter.drawRect(place.adjusted(2, 2, -2, -2));
        painter.setPen(QPen{QColor(tokens::kFocus), 2.0});
        painter.drawRect(place.adjusted(2, 2, -2, -2));
    }
    if (m_size != kPicture)
        return;
    painter.setPen(QColor(current ? tokens::kText : tokens::kTextDim));
    const QRect line(kFrame, place.bottom() + 1 + kFrame + kNameGap, m_size.width(),
                     fontMetrics().height());
    painter.drawText(line, Qt::AlignHCenter | Qt::AlignVCenter,
                     fontMetrics().elidedText(text(), Qt::ElideRight, line.width()));
}

void ViewThumb::mouseDoubleClickEvent(QMouseEvent* event) {
    if (event->button() == Qt::LeftButton)
        Q_EMIT doubleClicked();
}

void ViewThumb::enterEvent(QEnterEvent*) {
    update();
}

void ViewThumb::leaveEvent(QEvent*) {
    update();
}

} // namespace patina::editor
