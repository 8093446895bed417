// Cuts a frame into slices that take about as long as they may, by the time that those before took.
#pragma once

#include "render/scene/SceneSlice.h"

#include <vector>

namespace patina::render {

class FrameSlicer {
  public:
    static constexpr int kTile = 64; // pixels a side; slices are made of whole tiles

    [[nodiscard]] static int tiles(int pixels) { return (pixels + kTile - 1) / kTile; }

    // A frame of so many pixels. `costs`: what its tiles cost relative to each other, above 0, row
    // by row from the bottom left. `expectedMs`: what the whole may take; below 0: unknown.
    void begin(int width, int height, std::vector<float> costs, double expectedMs, double budgetMs);
    [[nodiscard]] bool done() const { return m_tile >= m_costs.size(); }
    // The slice to draw next; CHECKs that there is one.
    [[nodiscard]] const SceneSlice& slice() const;
    // That slice, as drawing it has set it, took so long.
    void took(double milliseconds, const SceneSlice& drawn);

  private:
    void cut(); // the rectangle that begins with m_tile

    int m_width = 0, m_height = 0;
    std::vector<float> m_costs;
    double m_budgetMs = 0.0;
    double m_share = 0.0;               // cost that a rectangle may have; kept from frame to frame
    std::uint64_t m_triangles = 16'384; // that a slice may have; likewise
    std::size_t m_tile = 0, m_nextTile = 0;
    double m_slowestMs = 0.0; // slice of this rectangle
    bool m_tooLarge = false;  // that one, though of few triangles
    SceneSlice m_slice;
};

} // namespace patina::render
