// FLIP of a tile of two pictures, with what its filters need around it. Seen by this module only.
#pragma once

#include "core/compare/FlipColor.h"
#include "core/compare/FlipKernels.h"
#include "core/image/Image.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <span>
#include <vector>

namespace patina::compare {

struct TileRect {
    int x = 0, y = 0, width = 0, height = 0;
};

// One row of a tile: the two differences of features as in FlipTerms, and that of colours.
struct FlipRow {
    std::span<const float> color, edge, point;
};

// ΔE = ΔE_c^(1 - ΔE_f) (2020, eq. 9): nothing where colours are the same, more than their
// difference where edges or points differ, too.
inline float flipError(float color, float edge, float point) {
    constexpr float kSqrtHalf = 1.0f / std::numbers::sqrt2_v<float>;
    const float feature = std::sqrt(std::min(1.0f, std::max(edge, point) * kSqrtHalf));
    return color > 0.0f ? std::pow(color, 1.0f - feature) : 0.0f;
}

// What FLIP sees of a tile of one picture, in rows: Hunt-adjusted L*a*b*, and magnitudes.
struct FlipFeatures {
    std::array<std::vector<float>, 3> color;
    std::vector<float> edge, point;
};

// The buffers of one thread.
class FlipTile {
  public:
    static constexpr int kSide = 128; // planes of a tile stay in the second-level cache

    FlipTile(const Image& image, const Image& reference, const FlipKernels& kernels);

    // The tile that evaluate() is about. Reads both pictures.
    void read(const TileRect& rect);

    // Calls take(y, row) for each row, y from the tile's top. With an exposure both pictures are
    // multiplied by 2^exposure and tone mapped, else cut to 0…1.
    void evaluate(const float* exposure, const std::function<void(int, const FlipRow&)>& take);

    // Of one picture, cut to 0…1.
    [[nodiscard]] FlipFeatures features(const Image& image, const TileRect& rect);
    // As evaluate() without an exposure, of `image` and of features that are known.
    void evaluateAgainst(const FlipFeatures& reference, const Image& image, const TileRect& rect,
                         const std::function<void(int, const FlipRow&)>& take);

  private:
    using Plane = std::vector<float>;
    // Of one picture. Filtered along x: rows from `radius` above to `radius` below the tile.
    struct Picture {
        std::array<Plane, 3> light; // linear, with `radius` pixels more on each side
        Plane achromatic, redGreen;
        std::array<Plane, 2> blueYellow;
        Plane gaussian, derivative, secondDerivative;
        // Of the current row.
        std::array<Plane, 3> color; // Hunt-adjusted L*a*b*
        Plane edge, point;          // magnitudes
    };

    void readPicture(const Image& image, Picture& picture) const;
    void filterAlongX(Picture& picture, const float* exposure);
    void filterRow(Picture& picture, int y);

    const Image& m_image;
    const Image& m_reference;
    const FlipKernels& m_kernels;
    ColorDifference m_colorDifference;
    int m_radius;
    TileRect m_rect;
    std::array<Picture, 2> m_pictures;
    std::array<Plane, 4> m_row; // Y, Cx, Cz and normalized Y of a row, or scratch of one
    Plane m_color, m_edge, m_point;
};

} // namespace patina::compare
