#include "app/editor/widget/BusyIndicator.h"

#include "app/editor/style/Tokens.h"

#include <QHBoxLayout>
#include <QLabel>
#include <QMouseEvent>
#include <QPainter>
#include <algorithm>
#include <utility>

namespace patina::editor {
namespace {
constexpr int kArc = 14; // pixels
constexpr int kShortestStepMs = 50, kLongestStepMs = 1000;
constexpr double kBusyShare = 0.05; // of the time, for showing it
constexpr int kLargestStepDeg = 90; // a slow arc still turns one way
} // namespace

BusyIndicator::BusyIndicator(QWidget* parent)
    : QWidget(parent)
    , m_text(new QLabel) {
    auto* layout = new QHBoxLayout(this);
    layout->setContentsMargins(kArc + tokens::kGap, 0, 0, 0);
    layout->addWidget(m_text);
    m_timer.setInterval(kShortestStepMs);
    connect(&m_timer, &QTimer::timeout, this, &BusyIndicator::turn);
    hide();
}

int BusyIndicator::stepMs(double frameMs) {
    return static_cast<int>(std::clamp(frameMs / kBusyShare, static_cast<double>(kShortestStepMs),
                                       static_cast<double>(kLongestStepMs)));
}

void BusyIndicator::turn() {
    m_angleDeg = (m_angleDeg + std::min(360 * m_timer.interval() / 1000, kLargestStepDeg)) % 360;
    m_turned = true;
    update(0, 0, kArc + tokens::kGap, height());
}

void BusyIndicator::shown() {
    m_timer.setInterval(stepMs(static_cast<double>(m_frame.nsecsElapsed()) * 1e-6));
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
    else if (!m_timer.isActive())
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
    if (std::exchange(m_turned, false)) {
        m_frame.start();
        QTimer::singleShot(0, this, &BusyIndicator::shown); // once the window has been put together
    }
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(QPen(QColor(tokens::kAccent), 2, Qt::SolidLine, Qt::RoundCap));
    painter.drawArc(QRectF(2, (height() - kArc) / 2.0 + 1, kArc - 2, kArc - 2), -m_angleDeg * 16,
                    250 * 16);
}

} // namespace patina::editor
