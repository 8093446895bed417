// The response of a camera: which code it gives for how much light, by channel, beside sRGB's.
#pragma once

#include "app/editor/widget/CurvePlot.h"
#include "core/bracket/Bracket.h"

namespace patina::editor {

class ResponsePlot : public CurvePlot {
    Q_OBJECT
  public:
    explicit ResponsePlot(QWidget* parent = nullptr);

    void setReport(const BracketReport& report);
    void clear();

    [[nodiscard]] std::vector<PlotValue> valuesAt(const QPointF& place) const override;
    [[nodiscard]] QSize sizeHint() const override { return {300, 190}; }
    [[nodiscard]] QSize minimumSizeHint() const override { return {200, 150}; }

  protected:
    [[nodiscard]] QColor colorOf(const PlotCurve& curve) const override;
    [[nodiscard]] QString corner() const override { return m_kind; }
    void paintCurve(QPainter& painter, const PlotCurve& curve) const override;

  private:
    QString m_kind; // "sRGB", "recovered from the photos"
};

} // namespace patina::editor
