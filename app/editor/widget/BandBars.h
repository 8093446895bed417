// The coefficients of spherical harmonics as bars, band by band. A click on a band mutes it, with
// Shift it is alone; so does Space on the band that the arrow keys choose.
#pragma once

#include <QWidget>
#include <vector>

namespace patina::editor {

class BandBars : public QWidget {
    Q_OBJECT
  public:
    explicit BandBars(QWidget* parent = nullptr);

    // l(l+1)+m; `shares`: a line below each band, one for each.
    void setCoefficients(std::vector<float> coefficients, QStringList shares);
    [[nodiscard]] unsigned bands() const { return m_on; } // bit l: band l is on
    [[nodiscard]] int order() const { return m_order; }
    [[nodiscard]] QRectF bandArea(int l) const;

    [[nodiscard]] QSize sizeHint() const override { return {340, 200}; }
    [[nodiscard]] QSize minimumSizeHint() const override { return {160, 116}; }

  Q_SIGNALS:
    void bandsChanged();

  protected:
    void paintEvent(QPaintEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;
    bool event(QEvent* event) override; // tool tips

  private:
    [[nodiscard]] int bandAt(const QPointF& position) const; // -1: none
    void toggle(int band, bool solo);

    std::vector<float> m_coefficients;
    QStringList m_shares;
    int m_order = 0, m_current = 0; // of the keyboard
    unsigned m_on = ~0u;
};

} // namespace patina::editor
