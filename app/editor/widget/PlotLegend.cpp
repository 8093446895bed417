#include "app/editor/widget/PlotLegend.h"

#include "app/editor/style/Tokens.h"

#include <QPainter>

namespace patina::editor {
namespace {
constexpr int kSample = 18; // a line's length
constexpr int kLegendGap = 5;
} // namespace

PlotLegend::PlotLegend(QWidget* parent)
    : QWidget(parent) {
    setSizePolicy(QSizePolicy::Fixed, QSizePolicy::Fixed);
    setFont(plotFont(font()));
}

void PlotLegend::setCurves(std::vector<PlotCurve> curves) {
    m_curves = std::move(curves);
    QStringList names;
    for (const PlotCurve& curve : m_curves)
        names << curve.name;
    setAccessibleName(names.join(QStringLiteral(", ")));
    updateGeometry();
    update();
}

QSize PlotLegend::sizeHint() const {
    int width = 0;
    for (const PlotCurve& curve : m_curves)
        width +=
            kSample + kLegendGap + fontMetrics().horizontalAdvance(curve.name) + 2 * kLegendGap;
    return {width, tokens::kRowHeight};
}

void PlotLegend::paintEvent(QPaintEvent*) {
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    int x = 0;
    for (const PlotCurve& curve : m_curves) {
        painter.setPen(curvePen(curve.shape, curve.look));
        const double y = height() / 2.0;
        painter.drawLine(QPointF(x, y), QPointF(x + kSample, y));
        x += kSample + kLegendGap;
        painter.setPen(QColor(tokens::kTextDim));
        painter.drawText(QRect(x, 0, width() - x, height()), Qt::AlignLeft | Qt::AlignVCenter,
                         curve.name);
        x += fontMetrics().horizontalAdvance(curve.name) + 2 * kLegendGap;
    }
}

} // namespace patina::editor
