// A waterfall of what a pixel's radiance is made of: each share begins where the last one ended.
#pragma once

#include "app/editor/widget/PlotFrame.h"
#include "render/view/Explanation.h"

#include <vector>

namespace patina::editor {

class ContributionChart : public PlotFrame {
    Q_OBJECT
  public:
    explicit ContributionChart(QWidget* parent = nullptr);

    void setContributions(std::vector<render::Contribution> parts);
    void setChannels(bool channels); // red, green and blue apart instead of luminance
    [[nodiscard]] bool channels() const { return m_channels; }

    // Where a bar is painted: shares of the chart's height and bar area; for tests and the mouse.
    [[nodiscard]] int rowAt(const QPoint& position) const; // the last is the sum; -1: none
    [[nodiscard]] QRectF barArea() const { return area(); }
    [[nodiscard]] int rowHeight() const;

    [[nodiscard]] std::optional<QPointF> placeAt(const QPointF& point) const override;
    [[nodiscard]] std::vector<PlotValue> valuesAt(const QPointF& place) const override;
    [[nodiscard]] QSize sizeHint() const override;
    [[nodiscard]] QSize minimumSizeHint() const override;

  Q_SIGNALS:
    void chosen(const QString& key); // of the contribution that was clicked

  protected:
    [[nodiscard]] bool hasValues() const override { return !m_parts.empty(); }
    [[nodiscard]] QString placeText(const QPointF& place) const override;
    [[nodiscard]] QRectF area() const override;
    [[nodiscard]] QPointF startPlace() const override { return {0.0, m_axes[1].min}; } // the sum
    bool pick(const QPointF& place, Qt::KeyboardModifiers modifiers) override;
    void paintValues(QPainter& painter) const override;
    void paintProbe(QPainter& painter, const QPointF& place) const override;
    void changeEvent(QEvent* event) override;

  private:
    [[nodiscard]] render::Contribution row(int index) const; // a part, or their sum
    void paintRow(QPainter& painter, int index, const glm::vec3& begin) const;
    [[nodiscard]] float largest() const;
    [[nodiscard]] QString shareText(const glm::vec3& radiance) const;

    std::vector<render::Contribution> m_parts;
    glm::vec3 m_sum{0.0f};
    bool m_channels = false;
};

} // namespace patina::editor
