#include "app/editor/widget/EnergyPlot.h"

#include "app/editor/style/Tokens.h"

#include <QMouseEvent>
#include <QPainter>
#include <algorithm>

namespace patina::editor {

EnergyPlot::EnergyPlot(const QString& title, double xMax, QWidget* parent)
    : CurvePlot(title, parent)
    , m_xMax(xMax) {
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
    // The pointer reads out the plot it is in.
    connect(this, &CurvePlot::probed, this, &CurvePlot::setProbe);
}

void EnergyPlot::setBand(double low, double high) {
    m_low = low;
    m_high = high;
    update();
}

void EnergyPlot::setDot(double x, double y) {
    m_dot = {x, y};
    update();
}

void EnergyPlot::paintEvent(QPaintEvent* event) {
    CurvePlot::paintEvent(event);
    if (!message().isEmpty())
        return;
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(Qt::NoPen);
    const QPointF origin = position(0.0, 0.0), full = position(m_xMax, 100.0);
    const double top = plotTitleHeight(font()) + 4.0;
    if (full.y() > top + 8.0) { // the axis goes beyond 100 %
        QColor made(tokens::kDanger);
        made.setAlpha(46);
        painter.setBrush(made);
        painter.drawRect(QRectF(QPointF(origin.x(), top), QPointF(full.x(), full.y())));
    }
    if (m_high > m_low) {
        QColor band(tokens::kText);
        band.setAlpha(22);
        painter.setBrush(band);
        painter.drawRect(QRectF(QPointF(position(m_low, 0.0).x(), top),
                                QPointF(position(m_high, 0.0).x(), origin.y())));
    }
    painter.setPen(QPen(QColor(tokens::kWell), 1.5));
    painter.setBrush(QColor(tokens::kText));
    painter.drawEllipse(position(m_dot.x(), m_dot.y()), 4.0, 4.0);
}

void EnergyPlot::pick(const QPointF& at) {
    const double left = position(0.0, 0.0).x(), right = position(m_xMax, 0.0).x();
    Q_EMIT picked(m_xMax * std::clamp((at.x() - left) / (right - left), 0.0, 1.0));
}

void EnergyPlot::mousePressEvent(QMouseEvent* event) {
    if (event->button() == Qt::LeftButton)
        pick(event->position());
}

void EnergyPlot::mouseMoveEvent(QMouseEvent* event) {
    CurvePlot::mouseMoveEvent(event);
    if (event->buttons() & Qt::LeftButton)
        pick(event->position());
}

} // namespace patina::editor
