// The share of light that a white metal of the shading model returns, over roughness, seen from all
// sides on average; with the current roughness marked. A white furnace in numbers.
#pragma once

#include "app/editor/widget/EnergyPlot.h"
#include "core/document/Document.h"

namespace patina::editor {

class FurnacePlot : public EnergyPlot {
    Q_OBJECT
  public:
    explicit FurnacePlot(QWidget* parent = nullptr);

    // Cheap while the choices that matter stay the same; else about a millisecond.
    void setModel(const ShadingModel& model);
    void setRoughness(float perceptualRoughness);

    // Of a white metal with the current model, at a roughness in 0…1.
    [[nodiscard]] float returned(float perceptualRoughness) const;
    [[nodiscard]] QString text() const; // "White metal, roughness 0.50: 88.2 % returned"

  private:
    void refresh();

    ShadingModel m_model;
    PlotCurve m_curve;
    float m_roughness = 0.5f;
};

} // namespace patina::editor
