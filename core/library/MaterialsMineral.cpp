#include "core/library/MaterialRecipes.h"
#include "core/library/Noise.h"
#include "core/math/PortableMath.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

namespace patina::library {

namespace {}

// A celadon glaze: glossy, pooling slightly, with a fine crackle and iron specks.
Surface ceramic() {
    Surface s(kMapSize);
    const Field warpX = fbm(kMapSize, {8, 8, 3, 0.5f, 71}),
                warpY = fbm(kMapSize, {8, 8, 3, 0.5f, 72});
    const VoronoiCells large = voronoi(kMapSize, 6, 6, 0.95f, 73),
                       small = voronoi(kMapSize, 15, 15, 0.95f, 74);
    const Field edgeLarge = warp(large.edge, warpX, warpY, 16.0f);
    const Field edgeSmall = warp(small.edge, warpY, warpX, 8.0f);
    const Field pool = fbm(kMapSize, {2, 2, 4, 0.5f, 75});
    const Field presence = fbm(kMapSize, {5, 5, 2, 0.5f, 76});
    const VoronoiCells specks = voronoi(kMapSize, 36, 36, 1.0f, 77);
    const glm::vec3 glaze(0.50f, 0.64f, 0.55f), thick(0.30f, 0.49f, 0.42f),
        thin(0.72f, 0.76f, 0.66f);
    const glm::vec3 iron(0.13f, 0.085f, 0.055f), crack(0.22f, 0.20f, 0.15f);
    forRows(kMapSize, [&](int y) {
        for (int x = 0; x < kMapSize; ++x) {
            const float p = pool.row(y)[x];
            const float major = smoothstep(0.016f, 0.003f, edgeLarge.row(y)[x]) *
                                smoothstep(-0.45f, 0.05f, presence.row(y)[x]);
            const float minor = smoothstep(0.036f, 0.006f, edgeSmall.row(y)[x]) *
                                smoothstep(-0.1f, 0.35f, presence.row(y)[x]);
            const float line = std::max(major * 0.75f, minor * 0.45f);
            const float size = 0.26f * smoothstep(0.90f, 1.0f, specks.random.row(y)[x]);
            const float speck =
                size > 0.03f ? smoothstep(size, 0.4f * size, specks.nearest.row(y)[x]) : 0.0f;
            glm::vec3 color = glm::mix(glaze, thick, smoothstep(0.0f, 0.6f, p));
            color = glm::mix(color, thin, smoothstep(0.0f, 0.6f, -p));
            color = glm::mix(color, crack, 0.55f * line);
            color = glm::mix(color, iron, 0.6f * speck);
            s.setColor(x, y, color);
            s.roughness.row(y)[x] = 0.085f + 0.16f * line + 0.03f * smoothstep(0.0f, 0.5f, p);
            s.height.row(y)[x] = 0.0030f * p + 0.0006f * warpX.row(y)[x] - 0.00035f * major -
                                 0.00015f * minor + 0.0002f * speck;
        }
    });
    s.cavityRadius = 6;
    return s;
}

// Cast concrete: cement with sand, air bubbles of several sizes, damp stains, a few hairlines.
Surface concrete() {
    Surface s(kMapSize);
    const Field stain = fbm(kMapSize, {2, 2, 6, 0.55f, 81});
    const Field blotch = fbm(kMapSize, {9, 9, 4, 0.55f, 82});
    const Field sand = fbm(kMapSize, {96, 96, 2, 0.7f, 83});
    const Field wave = fbm(kMapSize, {5, 5, 3, 0.5f, 84});
    const VoronoiCells bubbles = voronoi(kMapSize, 14, 14, 1.0f, 85),
                       pores = voronoi(kMapSize, 44, 44, 1.0f, 86);
    const VoronoiCells plates = voronoi(kMapSize, 3, 3, 0.9f, 87);
    const Field crackEdge = warp(plates.edge, blotch, wave, 34.0f);
    forRows(kMapSize, [&](int y) {
        for (int x = 0; x < kMapSize; ++x) {
            // A bubble's radius varies with its cell; most cells have none.
            const float big = 0.24f * smoothstep(0.72f, 1.0f, bubbles.random.row(y)[x]);
            const float small = 0.40f * smoothstep(0.68f, 1.0f, pores.random.row(y)[x]);
            const float hole =
                big > 0.02f ? smoothstep(big, 0.55f * big, bubbles.nearest.row(y)[x]) : 0.0f;
            const float pore =
                small > 0.02f ? smoothstep(small, 0.4f * small, pores.nearest.row(y)[x]) : 0.0f;
            const float crack = smoothstep(0.012f, 0.003f, crackEdge.row(y)[x]) *
                                smoothstep(-0.15f, 0.2f, wave.row(y)[x]);
            const float damp = smoothstep(0.0f, 0.45f, stain.row(y)[x]);
            float tone =
                0.40f + 0.16f * stain.row(y)[x] + 0.12f * blotch.row(y)[x] + 0.07f * sand.row(y)[x];
            tone *= 1.0f - 0.25f * damp;
            tone *= (1.0f - 0.4f * hole) * (1.0f - 0.35f * pore) * (1.0f - 0.5f * crack);
            s.setColor(x, y,
                       tone * glm::mix(glm::vec3(1.0f, 0.975f, 0.93f),
                                       glm::vec3(1.0f, 0.96f, 0.89f), damp));
            s.roughness.row(y)[x] = 0.84f - 0.12f * damp + 0.08f * sand.row(y)[x] + 0.08f * hole;
            s.height.row(y)[x] = 0.004f * wave.row(y)[x] + 0.0012f * sand.row(y)[x] +
                                 0.001f * blotch.row(y)[x] - 0.0060f * hole - 0.0022f * pore -
                                 0.0020f * crack;
        }
    });
    s.cavityRadius = 8;
    s.cavityStrength = 1.2f;
    return s;
}

} // namespace patina::library
