#include "core/library/MaterialRecipes.h"
#include "core/library/Noise.h"
#include "core/math/PortableMath.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

namespace patina::library {

namespace {}

// Moulded charcoal plastic with the fine pebble of a spark-eroded tool.
Surface roughPlastic() {
    Surface s(kMapSize);
    const Field grain = fbm(kMapSize, {72, 72, 2, 0.55f, 51});
    const Field coarse = fbm(kMapSize, {36, 36, 2, 0.5f, 52});
    const Field smudge = fbm(kMapSize, {3, 3, 5, 0.55f, 53});
    const Field scuff = strokes(kMapSize, {50, 20, 80, 0.7f, 30, 160, 54});
    forRows(kMapSize, [&](int y) {
        for (int x = 0; x < kMapSize; ++x) {
            const float g = smoothstep(-0.35f, 0.45f, grain.row(y)[x] + 0.6f * coarse.row(y)[x]);
            const float worn = smoothstep(0.0f, 0.5f, smudge.row(y)[x]);
            const float mark = scuff.row(y)[x];
            s.setColor(x, y,
                       glm::vec3(0.034f, 0.035f, 0.038f) * (0.9f + 0.25f * g + 0.25f * worn) +
                           0.02f * mark);
            s.roughness.row(y)[x] = 0.60f - 0.10f * g - 0.08f * worn - 0.06f * mark;
            s.height.row(y)[x] = 0.0011f * g - 0.0002f * mark;
        }
    });
    s.cavityRadius = 4;
    s.cavityStrength = 0.8f;
    return s;
}

// 2 × 2 twill: each tow passes over two and under two, shifted by one from row to row. Tows are
// rounded and their fibres make the weave shimmer.
Surface carbonFibre() {
    constexpr int kTows = 24; // per tile, a multiple of the weave's period 4
    Surface s(kMapSize);
    const Field fibresAlongU = fbm(kMapSize, {8, 256, 1, 0.5f, 61});
    const Field fibresAlongV = fbm(kMapSize, {256, 8, 1, 0.5f, 62});
    const Field wobble = fbm(kMapSize, {8, 8, 3, 0.5f, 63});
    const Field smudge = fbm(kMapSize, {3, 3, 4, 0.55f, 64});
    forRows(kMapSize, [&](int y) {
        for (int x = 0; x < kMapSize; ++x) {
            const float scale = static_cast<float>(kTows) / static_cast<float>(kMapSize);
            const float px = (static_cast<float>(x) + 0.5f) * scale + 0.03f * wobble.row(y)[x];
            const float py = (static_cast<float>(y) + 0.5f) * scale + 0.03f * wobble.at(y, x);
            const int ix = static_cast<int>(px + 16.0f) - 16,
                      iy = static_cast<int>(py + 16.0f) - 16;
            const float fx = px - static_cast<float>(ix), fy = py - static_cast<float>(iy);
            const bool warpOnTop = ((ix + iy) & 3) < 2; // the tow along v

            // Across the tow a flat arch, along it a rise over the two crossings.
            const float across = (warpOnTop ? fx : fy) * 2.0f - 1.0f;
            const int phase = warpOnTop ? ((ix + iy) & 3) : ((ix + iy) & 3) - 2;
            const float along =
                (static_cast<float>(phase) + (warpOnTop ? fy : fx)) - 1.0f; // -1…1 over two cells
            const float arch = std::sqrt(std::max(0.0f, 1.0f - 0.82f * across * across));
            const float rise = 1.0f - 0.55f * along * along;
            const float fibre = warpOnTop ? fibresAlongV.row(y)[x] : fibresAlongU.row(y)[x];

            const float gap = smoothstep(1.0f, 0.86f, std::fabs(across));
            const float tone = warpOnTop ? 1.0f : 0.72f;
            s.setColor(x, y,
                       glm::vec3(0.052f, 0.055f, 0.060f) * tone * (0.45f + 0.55f * gap) *
                           (1.0f + 0.5f * fibre));
            s.roughness.row(y)[x] = 0.26f + 0.08f * fibre + 0.1f * (1.0f - gap) +
                                    0.05f * smoothstep(0.0f, 0.5f, smudge.row(y)[x]);
            s.height.row(y)[x] = 0.0024f * arch * rise + 0.00016f * fibre;
        }
    });
    s.cavityRadius = 10;
    s.cavityStrength = 1.2f;
    return s;
}

} // namespace patina::library
