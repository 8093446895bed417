// Where all the light goes, as bars that are full at 100 %: highlight, body, colour, and what is
// lost between facets, without and with compensation.
#pragma once

#include "app/editor/widget/PlotFrame.h"

#include <array>

namespace patina::editor {

// Shares of what arrives; they add up to 1.
struct EnergyShares {
    double specular = 0, diffuse = 0, absorbed = 0, lost = 0;
};

class EnergyBars : public PlotFrame {
    Q_OBJECT
  public:
    explicit EnergyBars(QWidget* parent = nullptr);

    // `compensated`: which of the two the picture shows.
    void setShares(const EnergyShares& without, const EnergyShares& with, bool compensated);

    // Of a part (0 highlight … 3 lost), without (0) or with (1) compensation.
    [[nodiscard]] QPointF pointOf(const QPointF& place) const override;
    [[nodiscard]] std::optional<QPointF> placeAt(const QPointF& point) const override;
    [[nodiscard]] std::vector<PlotValue> valuesAt(const QPointF& place) const override;
    [[nodiscard]] bool hasHeightForWidth() const override { return true; }
    [[nodiscard]] int heightForWidth(int width) const override;
    [[nodiscard]] QSize sizeHint() const override;
    [[nodiscard]] QSize minimumSizeHint() const override;

  protected:
    [[nodiscard]] bool hasValues() const override { return m_known; }
    [[nodiscard]] QString placeText(const QPointF& place) const override;
    [[nodiscard]] QPointF startPlace() const override { return {0.0, m_compensated ? 1.0 : 0.0}; }
    void paintGround(QPainter&) const override {} // it stands among words
    void paintValues(QPainter& painter) const override;
    void paintProbe(QPainter& painter, const QPointF& place) const override;

  private:
    struct Entry {
        QString text;
        int part = 0;
    };
    [[nodiscard]] std::array<Entry, 4> legend() const;
    [[nodiscard]] QRectF bar(int row) const;
    [[nodiscard]] QRectF segment(int row, int part) const;
    // Calls `place(entry, x, y)` for each entry that fits the width, and returns the height.
    template <class Place>
    int layOutLegend(int width, Place place) const;

    EnergyShares m_without, m_with;
    bool m_compensated = true, m_known = false;
};

} // namespace patina::editor
