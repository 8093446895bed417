// A small plot: the share of light that a white metal of the shading model returns, over roughness,
// seen from all sides on average; with the current roughness marked. A white furnace in numbers.
#pragma once

#include "core/document/Document.h"

#include <QWidget>
#include <vector>

namespace patina::editor {

class FurnacePlot : public QWidget {
    Q_OBJECT
  public:
    explicit FurnacePlot(QWidget* parent = nullptr);

    // Cheap while the choices that matter stay the same; else a few milliseconds.
    void setModel(const ShadingModel& model);
    void setRoughness(float perceptualRoughness);

    // Of a white metal with the current model, at a roughness in 0…1.
    [[nodiscard]] float returned(float perceptualRoughness) const;
    [[nodiscard]] QString text() const; // "White metal, roughness 0.50: 88.2 % returned"
    [[nodiscard]] QSize sizeHint() const override;

  protected:
    void paintEvent(QPaintEvent* event) override;

  private:
    void describe();

    ShadingModel m_model;
    std::vector<float> m_returned; // over roughness at (i + 0.5) / size
    float m_roughness = 0.5f;
};

} // namespace patina::editor
