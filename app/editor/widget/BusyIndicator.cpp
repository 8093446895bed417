#include "app/editor/widget/BusyIndicator.h"

#include "app/editor/style/Tokens.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QMouseEvent>
#include <QPainter>

namespace patina::editor {
namespace {
constexpr int kArc = 14; // pixels
constexpr int kFrameMs = 50;
} // namespace

BusyIndicator::BusyIndicator(QWidget* parent)
    : QWidget(parent)
    , m_text(new QLabel) {
    auto* layout = new QHBoxLayout(this);
    layout->setContentsMargins(kArc + tokens::kGap, 0, 0, 0);
    layout->addWidget(m_text);
    m_timer.setInterval(kFrameMs);
    connect(&m_timer, &QTimer::timeout, this, [this] {
        m_angleDeg = (m_angleDeg + 360 * kFrameMs / 1000) % 360;
        update(0, 0, kArc + tokens::kGap, height());
    });
    hide();
}

void BusyIndicator::setActivity(const QString& activity, const QString& action) {
    m_text->setText(activity);
    setAccessibleName(activity);
    setToolTip(action);
    setStatusTip(action);
    setCursor(action.isEmpty() ? Qt::ArrowCursor : Qt::PointingHandCursor);
    setVisible(!activity.isEmpty());
    if (activity.isEmpty())
        m_timer.stop();
    else
        m_timer.start();
}

QString BusyIndicator::activity() const {
    return m_text->text();
}

void BusyIndicator::mouseReleaseEvent(QMouseEvent* event) {
    if (event->button() == Qt::LeftButton && rect().contains(event->pos()))
        Q_EMIT clicked();
}

void BusyIndicator::paintEvent(QPaintEvent*) {
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(QPen(QColor(tokens::kAccent), 2, Qt::SolidLine, Qt::RoundCap));
    painter.drawArc(QRectF(2, (height() - kArc) / 2.0 + 1, kArc - 2, kArc - 2), -m_angleDeg * 16,
                    250 * 16);
}

} // namespace patina::editor
