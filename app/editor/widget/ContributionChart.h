// A waterfall of what a pixel's radiance is made of: each share begins where the last one ended.
#pragma once

#include "render/view/Explanation.h"

#include <QWidget>
#include <vector>

namespace patina::editor {

class ContributionChart : public QWidget {
    Q_OBJECT
  public:
    explicit ContributionChart(QWidget* parent = nullptr);

    void setContributions(std::vector<render::Contribution> parts);
    void setChannels(bool channels); // red, green and blue apart instead of luminance
    [[nodiscard]] bool channels() const { return m_channels; }

    // Where a bar is painted: shares of the chart's height and bar area; for tests and the mouse.
    [[nodiscard]] int rowAt(const QPoint& position) const; // the last is the sum; -1: none
    [[nodiscard]] QRectF barArea() const;
    [[nodiscard]] int rowHeight() const;

    [[nodiscard]] QSize sizeHint() const override;
    [[nodiscard]] QSize minimumSizeHint() const override;

  Q_SIGNALS:
    void chosen(const QString& key); // of the contribution that was clicked

  protected:
    void paintEvent(QPaintEvent* event) override;
    void mouseReleaseEvent(QMouseEvent* event) override;
    void changeEvent(QEvent* event) override;
    bool event(QEvent* event) override; // tool tips

  private:
    void paintRow(QPainter& painter, int row, const QString& label, const glm::vec3& begin,
                  const render::Contribution& part, const QString& number) const;
    [[nodiscard]] float largest() const;
    [[nodiscard]] QString shareText(const glm::vec3& radiance) const;

    std::vector<render::Contribution> m_parts;
    glm::vec3 m_sum{0.0f};
    bool m_channels = false;
};

} // namespace patina::editor
