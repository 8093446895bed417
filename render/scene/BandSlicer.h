// Cuts a pass over all pixels into bands of rows that take about as long as they may, by the time
// that those before took.
#pragma once

#include <algorithm>

namespace patina::render {

class BandSlicer {
  public:
    static constexpr int kRows = 64; // bands are made of whole lots of them

    void begin(int height) {
        m_height = height;
        m_first = 0;
    }
    [[nodiscard]] bool done() const { return m_first >= m_height; }
    [[nodiscard]] int first() const { return m_first; } // row from the bottom
    [[nodiscard]] int rows() const { return std::min(m_rows, m_height - m_first); }
    // The band took so long.
    void took(double milliseconds, double budgetMs) {
        const double factor = kAim * budgetMs / std::max(milliseconds, 1e-3);
        const int wanted = static_cast<int>(std::clamp(factor, 0.25, 2.0) * m_rows);
        m_first += rows();
        m_rows = std::clamp(wanted / kRows * kRows, kRows, kMostRows);
    }

  private:
    static constexpr double kAim = 0.7; // of the budget
    static constexpr int kMostRows = 1 << 14;

    int m_height = 0, m_first = 0;
    int m_rows = kRows; // kept from pass to pass
};

} // namespace patina::render
