#include "app/editor/widget/FurnacePlot.h"

#include "app/editor/style/Tokens.h"
#include "core/light/DfgTable.h"

#include <QPainter>
#include <QPainterPath>
#include <algorithm>

namespace patina::editor {

namespace {

constexpr int kTableSize = 48;
constexpr int kPlotHeight = 92;

// Eavg = 2 ∫ E(mu) mu dmu of each row of the model's table; E is cut at 1 as in the shader.
std::vector<float> averageAlbedos(const ShadingModel& model) {
    const Image table =
        computeDfgTable(kTableSize, model.distribution, iblVisibility(model.visibility));
    std::vector<float> albedos;
    for (int y = 0; y < kTableSize; ++y) {
        float sum = 0.0f, weights = 0.0f;
        for (int x = 0; x < kTableSize; ++x) {
            const float mu = (static_cast<float>(x) + 0.5f) / kTableSize;
            const float E = table.sample(x, y, 0) + table.sample(x, y, 1);
            sum += mu * (model.multiScatter ? 1.0f : std::min(E, 1.0f));
            weights += mu;
        }
        albedos.push_back(sum / weights);
    }
    return albedos;
}

} // namespace

FurnacePlot::FurnacePlot(QWidget* parent)
    : QWidget(parent)
    , m_returned(averageAlbedos(m_model)) {
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
    setToolTip(tr("How much of the light around it a white metal gives back, by roughness. "
                  "Anything below 100 % is light that the model loses."));
    setAccessibleName(tr("White furnace"));
    describe();
}

QSize FurnacePlot::sizeHint() const {
    return {220, kPlotHeight + fontMetrics().height() + 8};
}

void FurnacePlot::setModel(const ShadingModel& model) {
    const bool same = model.distribution == m_model.distribution &&
                      model.visibility == m_model.visibility &&
                      model.multiScatter == m_model.multiScatter;
    m_model = model;
    if (same)
        return;
    m_returned = averageAlbedos(model);
    describe();
    update();
}

void FurnacePlot::setRoughness(float perceptualRoughness) {
    if (perceptualRoughness == m_roughness)
        return;
    m_roughness = perceptualRoughness;
    describe();
    update();
}

float FurnacePlot::returned(float perceptualRoughness) const {
    const float at = std::clamp(perceptualRoughness * kTableSize - 0.5f, 0.0f,
                                static_cast<float>(kTableSize - 1));
    const auto i = std::min(static_cast<std::size_t>(at), m_returned.size() - 2);
    const float t = at - static_cast<float>(i);
    return (1.0f - t) * m_returned[i] + t * m_returned[i + 1];
}

QString FurnacePlot::text() const {
    return tr("White metal, roughness %1: %2 % returned")
        .arg(static_cast<double>(m_roughness), 0, 'f', 2)
        .arg(100.0 * static_cast<double>(returned(m_roughness)), 0, 'f', 1);
}

void FurnacePlot::describe() {
    setAccessibleDescription(text());
}

void FurnacePlot::paintEvent(QPaintEvent*) {
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    const int textHeight = fontMetrics().height();
    const QRectF plot = QRectF(rect()).adjusted(0.5, 0.5, -0.5, -textHeight - 8.0);
    painter.setPen(QColor(tokens::kLine));
    painter.setBrush(QColor(tokens::kWell));
    painter.drawRoundedRect(plot, tokens::kRadius, tokens::kRadius);

    // All light is near the top, so that a line at 100 % is seen.
    const QRectF inner = plot.adjusted(8.0, 10.0, -8.0, -6.0);
    const auto point = [&](float roughness) {
        return QPointF(inner.left() + static_cast<double>(roughness) * inner.width(),
                       inner.bottom() - static_cast<double>(returned(roughness)) * inner.height());
    };
    painter.setPen(QPen(QColor(tokens::kLine), 1.0, Qt::DashLine));
    for (const double share : {0.5, 1.0}) {
        const double y = inner.bottom() - share * inner.height();
        painter.drawLine(QPointF(inner.left(), y), QPointF(inner.right(), y));
    }
    QPainterPath curve(point(0.0f));
    for (int i = 1; i <= kTableSize; ++i)
        curve.lineTo(point(static_cast<float>(i) / kTableSize));
    QPainterPath area = curve;
    area.lineTo(inner.bottomRight());
    area.lineTo(inner.bottomLeft());
    QColor fill(tokens::kAccent);
    fill.setAlpha(40);
    painter.fillPath(area, fill);
    painter.setBrush(Qt::NoBrush);
    painter.setPen(QPen(QColor(tokens::kAccent), 1.6));
    painter.drawPath(curve);

    const QPointF marker = point(m_roughness);
    painter.setPen(QPen(QColor(tokens::kTextDim), 1.0));
    painter.drawLine(QPointF(marker.x(), inner.bottom()), marker);
    painter.setPen(Qt::NoPen);
    painter.setBrush(QColor(tokens::kText));
    painter.drawEllipse(marker, 3.5, 3.5);

    painter.setPen(QColor(tokens::kTextDim));
    painter.drawText(QRectF(0, plot.bottom() + 6.0, width(), textHeight), Qt::AlignLeft, text());
}

} // namespace patina::editor
