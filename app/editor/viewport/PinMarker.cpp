#include "app/editor/viewport/PinMarker.h"

#include "app/editor/style/Tokens.h"

#include <QEvent>
#include <QPainter>

namespace patina::editor {
namespace {

constexpr double kRadius = 8.0;
constexpr double kMarkReach = 16.0; // of the whole mark
constexpr double kPointGap = 3.0;   // around the point itself, which is what is looked at

} // namespace

PinMarker::PinMarker(QWidget& viewport)
    : QWidget(&viewport) {
    setObjectName(QStringLiteral("pinMarker"));
    setAttribute(Qt::WA_TransparentForMouseEvents);
    setAttribute(Qt::WA_NoSystemBackground);
    setAccessibleName(tr("Pinned point"));
    setGeometry(viewport.rect());
    viewport.installEventFilter(this);
    hide();
}

bool PinMarker::eventFilter(QObject*, QEvent* event) {
    if (event->type() == QEvent::Resize)
        setGeometry(parentWidget()->rect());
    return false;
}

void PinMarker::updateMark() {
    if (m_place)
        update(QRectF(*m_place - QPointF(kMarkReach, kMarkReach),
                      QSizeF(2 * kMarkReach, 2 * kMarkReach))
                   .toAlignedRect()
                   .adjusted(-1, -1, 1, 1));
}

void PinMarker::setPlace(std::optional<QPointF> place) {
    if (place == m_place)
        return;
    updateMark();
    m_place = place;
    updateMark();
    setVisible(m_place.has_value());
}

void PinMarker::setBroken(bool broken) {
    if (broken == m_broken)
        return;
    m_broken = broken;
    updateMark();
}

void PinMarker::paintEvent(QPaintEvent*) {
    if (!m_place)
        return;
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setBrush(Qt::NoBrush);
    // Dark below light: it is seen on every picture.
    for (const auto& [color, width] :
         {std::pair(QColor(tokens::kWell), 3.5), std::pair(QColor(tokens::kAccent), 1.6)}) {
        QPen pen(color, width);
        if (m_broken)
            pen.setDashPattern({2.2 * 1.6 / width, 2.2 * 1.6 / width});
        painter.setPen(pen);
        painter.drawEllipse(*m_place, kRadius, kRadius);
        for (const QPointF& way : {QPointF(1, 0), QPointF(-1, 0), QPointF(0, 1), QPointF(0, -1)})
            painter.drawLine(*m_place + kPointGap * way, *m_place + (kMarkReach - 2.0) * way);
    }
}

} // namespace patina::editor
