// Which line of a plot is which: samples and names in a row.
#pragma once

#include "app/editor/widget/CurvePlot.h"

#include <QWidget>
#include <vector>

namespace patina::editor {

class PlotLegend : public QWidget {
    Q_OBJECT
  public:
    explicit PlotLegend(QWidget* parent = nullptr);

    void setCurves(std::vector<PlotCurve> curves); // their points do not count
    [[nodiscard]] QSize sizeHint() const override;
    [[nodiscard]] QSize minimumSizeHint() const override { return sizeHint(); }

  protected:
    void paintEvent(QPaintEvent* event) override;

  private:
    std::vector<PlotCurve> m_curves;
};

} // namespace patina::editor
