#include "app/editor/widget/FurnacePlot.h"

#include "core/light/Energy.h"

namespace patina::editor {
namespace {

constexpr int kFurnaceSteps = 48;
constexpr int kFurnaceHeight = 132;

std::vector<QPointF> averageReturn(const ShadingModel& model) {
    std::vector<QPointF> points;
    SurfacePoint white;
    for (int i = 0; i <= kFurnaceSteps; ++i) {
        const double roughness = static_cast<double>(i) / kFurnaceSteps;
        white.perceptualRoughness = static_cast<float>(roughness);
        const Returned average =
            averageReturned([&](float NoV) { return returnedFromEnvironment(model, white, NoV); });
        points.emplace_back(roughness, 100.0 * average.total().y);
    }
    return points;
}

} // namespace

FurnacePlot::FurnacePlot(QWidget* parent)
    : EnergyPlot(tr("White metal"), {tr("roughness"), {}, 0.0, 1.0, 0.5}, parent) {
    setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
    setFixedHeight(kFurnaceHeight);
    setHelp(tr("How much of the light around it a white metal gives back, by roughness. Anything "
               "below 100 % is light that the model loses."));
    setAccessibleName(tr("White furnace"));
    m_curve.points = averageReturn(m_model);
    refresh();
}

void FurnacePlot::setModel(const ShadingModel& model) {
    ShadingModel white = model; // F is 1, there is no body
    white.fresnel = Fresnel::Schlick;
    const bool same = white.distribution == m_model.distribution &&
                      white.visibility == m_model.visibility &&
                      white.multiScatter == m_model.multiScatter;
    m_model = white;
    if (same)
        return;
    m_curve.points = averageReturn(m_model);
    refresh();
}

void FurnacePlot::setRoughness(float perceptualRoughness) {
    if (perceptualRoughness == m_roughness)
        return;
    m_roughness = perceptualRoughness;
    refresh();
}

float FurnacePlot::returned(float perceptualRoughness) const {
    return static_cast<float>(
        plotPoint(m_curve.points, static_cast<double>(perceptualRoughness)).y() / 100.0);
}

QString FurnacePlot::text() const {
    return tr("White metal, roughness %1: %2 % returned")
        .arg(static_cast<double>(m_roughness), 0, 'f', 2)
        .arg(100.0 * static_cast<double>(returned(m_roughness)), 0, 'f', 1);
}

void FurnacePlot::refresh() {
    setCurves({m_curve});
    setTitle(text());
    setMarker(static_cast<double>(m_roughness), {});
    setDot(static_cast<double>(m_roughness), 100.0 * static_cast<double>(returned(m_roughness)));
    setDescription(text());
}

} // namespace patina::editor
