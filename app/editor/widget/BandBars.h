// The coefficients of spherical harmonics as bars, band by band. A click on a band mutes it, with
// Shift it is alone; so does Space on the band that the cursor is in.
#pragma once

#include "app/editor/widget/PlotFrame.h"

#include <vector>

namespace patina::editor {

class BandBars : public PlotFrame {
    Q_OBJECT
  public:
    explicit BandBars(QWidget* parent = nullptr);

    // l(l+1)+m; `shares`: a line below each band, one for each.
    void setCoefficients(std::vector<float> coefficients, QStringList shares);
    [[nodiscard]] unsigned bands() const { return m_on; } // bit l: band l is on
    [[nodiscard]] int order() const { return m_order; }
    [[nodiscard]] QRectF bandArea(int l) const;

    // Of a coefficient, counted as they come.
    [[nodiscard]] QPointF pointOf(const QPointF& place) const override;
    [[nodiscard]] std::optional<QPointF> placeAt(const QPointF& point) const override;
    [[nodiscard]] std::vector<PlotValue> valuesAt(const QPointF& place) const override;
    [[nodiscard]] QSize sizeHint() const override { return {340, 200}; }
    [[nodiscard]] QSize minimumSizeHint() const override { return {160, 116}; }

  Q_SIGNALS:
    void bandsChanged();

  protected:
    [[nodiscard]] bool hasValues() const override { return m_order > 0; }
    [[nodiscard]] QString placeText(const QPointF& place) const override;
    [[nodiscard]] QRectF area() const override;
    [[nodiscard]] QPointF startPlace() const override { return {}; }
    bool pick(const QPointF& place, Qt::KeyboardModifiers modifiers) override;
    void paintValues(QPainter& painter) const override;
    void paintProbe(QPainter& painter, const QPointF& place) const override;

  private:
    [[nodiscard]] QRectF barsArea(int l) const; // of band l, without the words above and below
    [[nodiscard]] QRectF bar(int l, int m) const;

    std::vector<float> m_coefficients;
    float m_largest = 1.0f;
    QStringList m_shares;
    int m_order = 0;
    unsigned m_on = ~0u;
};

} // namespace patina::editor
