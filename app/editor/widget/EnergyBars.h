// Where all the light goes, as bars that are full at 100 %: highlight, body, colour, and what is
// lost between facets, without and with compensation.
#pragma once

#include <QStringList>
#include <QWidget>
#include <array>

namespace patina::editor {

// Shares of what arrives; they add up to 1.
struct EnergyShares {
    double specular = 0, diffuse = 0, absorbed = 0, lost = 0;
};

class EnergyBars : public QWidget {
    Q_OBJECT
  public:
    explicit EnergyBars(QWidget* parent = nullptr);

    // `compensated`: which of the two the picture shows.
    void setShares(const EnergyShares& without, const EnergyShares& with, bool compensated);

    [[nodiscard]] bool hasHeightForWidth() const override { return true; }
    [[nodiscard]] int heightForWidth(int width) const override;
    [[nodiscard]] QSize sizeHint() const override;
    [[nodiscard]] QSize minimumSizeHint() const override;

  protected:
    void paintEvent(QPaintEvent* event) override;

  private:
    struct Entry {
        QString text;
        int part = 0;
    };
    [[nodiscard]] std::array<Entry, 4> legend() const;
    // Calls `place(entry, x, y)` for each entry that fits the width, and returns the height.
    template <class Place>
    int layOutLegend(int width, Place place) const;

    EnergyShares m_without, m_with;
    bool m_compensated = true;
};

} // namespace patina::editor
