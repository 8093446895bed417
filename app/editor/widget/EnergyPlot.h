// Curves of returned energy in percent: the material's place on the axis as a band, and what lies
// above 100 %, light out of nothing, on a red ground. A press or drag chooses a place.
#pragma once

#include "app/editor/widget/CurvePlot.h"

namespace patina::editor {

class EnergyPlot : public CurvePlot {
    Q_OBJECT
  public:
    EnergyPlot(const QString& title, const PlotAxis& x, QWidget* parent = nullptr);

    void setBand(double low, double high); // equal: none
    // The curve that counts meets the marker in a dot.
    void setDot(double x, double y);

  Q_SIGNALS:
    void picked(double x);

  protected:
    void paintValues(QPainter& painter) const override;
    bool pick(const QPointF& place, Qt::KeyboardModifiers modifiers) override;

  private:
    double m_low = 0, m_high = 0;
    QPointF m_dot;
};

} // namespace patina::editor
