#include "app/editor/widget/ColorButton.h"

#include "app/editor/style/FocusRing.h"
#include "app/editor/style/Tokens.h"
#include "app/editor/widget/ColorConversion.h"
#include "app/editor/widget/ColorPicker.h"

#include <QPainter>
#include <QScreen>
#include <algorithm>

namespace patina::editor {

ColorButton::ColorButton(QWidget* parent)
    : QAbstractButton(parent)
    , m_picker(new ColorPicker(this)) {
    setFixedHeight(tokens::kRowHeight - 2);
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
    setCursor(Qt::PointingHandCursor);
    setFocusPolicy(Qt::StrongFocus);
    connect(this, &QAbstractButton::clicked, this, &ColorButton::openPicker);
    connect(m_picker, &ColorPicker::dragStarted, this, &ColorButton::dragStarted);
    connect(m_picker, &ColorPicker::dragged, this, &ColorButton::dragged);
    connect(m_picker, &ColorPicker::dragFinished, this, &ColorButton::dragFinished);
    connect(m_picker, &ColorPicker::edited, this, &ColorButton::edited);
}

void ColorButton::setColor(const glm::vec3& linear) {
    m_linear = linear;
    m_picker->setColor(linear);
    update();
}

QSize ColorButton::sizeHint() const {
    return {120, tokens::kRowHeight - 2};
}

void ColorButton::openPicker() {
    m_picker->adjustSize();
    // Below the button, but inside the screen.
    QPoint at = mapToGlobal(QPoint(0, height() + 2));
    const QRect space = screen()->availableGeometry();
    at.setX(std::clamp(at.x(), space.left(),
                       std::max(space.left(), space.right() - m_picker->width())));
    if (at.y() + m_picker->height() > space.bottom())
        at.setY(mapToGlobal(QPoint(0, 0)).y() - m_picker->height() - 2);
    m_picker->move(at);
    m_picker->show();
}

void ColorButton::paintEvent(QPaintEvent*) {
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    const QRectF frame = QRectF(rect()).adjusted(0.5, 0.5, -0.5, -0.5);
    painter.setPen(QColor(hasFocus()     ? tokens::kFocus
                          : underMouse() ? tokens::kTextOff
                                         : tokens::kLine));
    painter.setBrush(toDisplay(m_linear));
    painter.drawRoundedRect(frame, tokens::kRadius, tokens::kRadius);
    // The number in black or white, whichever reads better.
    const QColor color = toDisplay(m_linear);
    painter.setPen(qGray(color.rgb()) > 128 ? QColor(0, 0, 0, 190) : QColor(255, 255, 255, 200));
    painter.drawText(rect(), Qt::AlignCenter, hexOf(m_linear));
}

} // namespace patina::editor
