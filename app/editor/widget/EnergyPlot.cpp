#include "app/editor/widget/EnergyPlot.h"

#include "app/editor/style/Tokens.h"

#include <QPainter>

namespace patina::editor {

EnergyPlot::EnergyPlot(const QString& title, const PlotAxis& x, QWidget* parent)
    : CurvePlot(title, parent, Press::Follows) {
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
    setAxes(x, {tr("returned"), QStringLiteral(" %")}, 100.0);
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

void EnergyPlot::paintValues(QPainter& painter) const {
    CurvePlot::paintValues(painter);
    painter.setPen(Qt::NoPen);
    const QRectF plot = area();
    const double full = pointOf({0.0, 100.0}).y();
    if (full > plot.top() + 8.0) { // the axis goes beyond 100 %
        QColor made(tokens::kDanger);
        made.setAlpha(46);
        painter.setBrush(made);
        painter.drawRect(QRectF(plot.topLeft(), QPointF(plot.right(), full)));
    }
    if (m_high > m_low) {
        QColor band(tokens::kText);
        band.setAlpha(22);
        painter.setBrush(band);
        painter.drawRect(QRectF(QPointF(pointOf({m_low, 0.0}).x(), plot.top()),
                                QPointF(pointOf({m_high, 0.0}).x(), plot.bottom())));
    }
    painter.setPen(QPen(QColor(tokens::kWell), 1.5));
    painter.setBrush(QColor(tokens::kText));
    painter.drawEllipse(pointOf(m_dot), 4.0, 4.0);
}

bool EnergyPlot::pick(const QPointF& place, Qt::KeyboardModifiers) {
    Q_EMIT picked(place.x());
    return true;
}

} // namespace patina::editor
