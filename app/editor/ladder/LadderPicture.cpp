#include "app/editor/ladder/LadderPicture.h"

#include "app/editor/style/Tokens.h"

#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>
#include <algorithm>
#include <cmath>

namespace patina::editor {
namespace {

constexpr double kLineStep = 0.05; // of a key
constexpr double kLineDisc = 7.0;  // radius

} // namespace

LadderPicture::LadderPicture(QWidget* parent)
    : QWidget(parent) {
    setAccessibleName(tr("Two methods side by side"));
    setToolTip(tr("The chosen method on the left of the line, what it is compared with on its "
                  "right: drag the line, or move it by the arrow keys; double-click centres it"));
    setStatusTip(toolTip());
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
    setFocusPolicy(Qt::StrongFocus);
    setCursor(Qt::SplitHCursor);
}

void LadderPicture::setSides(const Side& left, const Side& right) {
    if (left == m_left && right == m_right)
        return;
    m_left = left;
    m_right = right;
    update();
}

void LadderPicture::setLine(double line) {
    line = std::clamp(line, 0.0, 1.0);
    if (line == m_line)
        return;
    m_line = line;
    update();
}

QRect LadderPicture::area() const {
    const QSize of = !m_left.picture.isNull()    ? m_left.picture.size()
                     : !m_right.picture.isNull() ? m_right.picture.size()
                                                 : QSize(16, 9);
    const QSize size = of.scaled(rect().size(), Qt::KeepAspectRatio);
    return {QPoint((width() - size.width()) / 2, (height() - size.height()) / 2), size};
}

void LadderPicture::paintSide(QPainter& painter, const Side& side, const QRect& clip,
                              bool left) const {
    const QRect place = area();
    painter.setClipRect(clip);
    painter.fillRect(place, QColor(tokens::kWell));
    if (!side.picture.isNull()) {
        painter.drawImage(place, side.picture);
    } else if (!side.note.isEmpty()) {
        painter.setPen(QColor(tokens::kTextDim));
        painter.drawText(clip.adjusted(tokens::kGap, 0, -tokens::kGap, 0),
                         Qt::AlignCenter | Qt::TextWordWrap, side.note);
    }
    // Its name on a plate, as captions in the viewport have it.
    const int room = clip.width() - 2 * tokens::kGap;
    const QString name = fontMetrics().elidedText(side.name, Qt::ElideRight, room);
    if (name.size() < 2)
        return;
    const QSize text(fontMetrics().horizontalAdvance(name) + tokens::kGap,
                     fontMetrics().height() + tokens::kGap / 2);
    const QRect plate(left ? QPoint(place.left() + tokens::kGap / 2, place.top() + tokens::kGap / 2)
                           : QPoint(place.right() - text.width() - tokens::kGap / 2,
                                    place.top() + tokens::kGap / 2),
                      text);
    QColor dark(tokens::kWell);
    dark.setAlphaF(0.8f);
    painter.fillRect(plate, dark);
    painter.setPen(QColor(tokens::kText));
    painter.drawText(plate, Qt::AlignCenter, name);
}

void LadderPicture::paintEvent(QPaintEvent*) {
    QPainter painter(this);
    painter.setRenderHint(QPainter::SmoothPixmapTransform);
    painter.setRenderHint(QPainter::Antialiasing);
    const QRect place = area();
    const int x = place.left() + static_cast<int>(std::lround(m_line * place.width()));
    paintSide(painter, m_left, {place.topLeft(), QPoint(x - 1, place.bottom())}, true);
    paintSide(painter, m_right, {QPoint(x, place.top()), place.bottomRight()}, false);
    painter.setClipping(false);
    painter.setPen(QPen(QColor(tokens::kWell), 3.0));
    painter.drawLine(QPointF(x, place.top()), QPointF(x, place.bottom()));
    const QColor color(hasFocus() ? tokens::kAccent : tokens::kText);
    painter.setPen(QPen(color, 1.5));
    painter.drawLine(QPointF(x, place.top()), QPointF(x, place.bottom()));
    painter.setBrush(QColor(tokens::kWell));
    painter.drawEllipse(QPointF(x, place.center().y()), kLineDisc, kLineDisc);
}

void LadderPicture::mousePressEvent(QMouseEvent* event) {
    if (event->button() == Qt::LeftButton)
        mouseMoveEvent(event);
}

void LadderPicture::mouseMoveEvent(QMouseEvent* event) {
    if (!(event->buttons() & Qt::LeftButton))
        return;
    const QRect place = area();
    setLine((event->position().x() - place.left()) / std::max(1, place.width()));
}

void LadderPicture::mouseDoubleClickEvent(QMouseEvent*) {
    setLine(0.5);
}

void LadderPicture::keyPressEvent(QKeyEvent* event) {
    switch (event->key()) {
    case Qt::Key_Left:
        setLine(m_line - kLineStep);
        break;
    case Qt::Key_Right:
        setLine(m_line + kLineStep);
        break;
    default:
        QWidget::keyPressEvent(event);
    }
}

} // namespace patina::editor
