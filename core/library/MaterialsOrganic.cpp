#include "core/library/MaterialRecipes.h"
#include "core/library/Noise.h"
#include "core/math/PortableMath.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

namespace patina::library {

namespace {}

// Oiled oak boards along u, five to a tile, each butted against the next at its own place. Growth
// rings are cut at a shallow angle (cathedral grain), pores follow the fibres.
Surface wood() {
    constexpr int kBoards = 5;
    Surface s(kMapSize);
    const Field bend = fbm(kMapSize, {3, 12, 4, 0.45f, 91});
    const Field fibre = fbm(kMapSize, {8, 128, 2, 0.6f, 92});
    const Field figure = fbm(kMapSize, {2, 24, 3, 0.5f, 93});
    const Field tone = fbm(kMapSize, {3, 6, 4, 0.5f, 94});
    const Field pores = fbm(kMapSize, {20, 256, 1, 0.5f, 95});
    const glm::vec3 light(0.47f, 0.285f, 0.140f), dark(0.235f, 0.118f, 0.050f);
    forRows(kMapSize, [&](int y) {
        const float v = (static_cast<float>(y) + 0.5f) / static_cast<float>(kMapSize) * kBoards;
        const int board = static_cast<int>(v);
        const float across = v - static_cast<float>(board); // 0…1 over the board's width
        for (int x = 0; x < kMapSize; ++x) {
            const float u = (static_cast<float>(x) + 0.5f) / static_cast<float>(kMapSize);
            const float joint = hashToFloat(hashInt(static_cast<std::uint32_t>(board), 7u, 96u));
            float along = u - joint;
            along -= along < 0.0f ? -1.0f : 0.0f;
            const auto id = static_cast<std::uint32_t>(board);
            const float random = hashToFloat(hashInt(id, 3u, 97u));
            const float random2 = hashToFloat(hashInt(id, 5u, 98u));

            // Rings: parabolas opening along the board, bent by the tree's irregularity.
            const float heart = across - mix(0.2f, 0.8f, random);
            const int shift = static_cast<int>(random * 512.0f);
            const float irregular = bend.at(x + shift, y + shift);
            const float ring = (random2 > 0.5f ? along : 1.0f - along) * 3.0f +
                               heart * heart * 16.0f + 1.3f * irregular + random * 7.0f;
            const float phase =
                ring * 2.2f - static_cast<float>(static_cast<int>(ring * 2.2f + 64.0f) - 64);
            const float late = smoothstep(0.25f, 0.85f, phase) * smoothstep(1.0f, 0.92f, phase);
            const float f = fibre.at(x + shift, y);
            const float pore =
                smoothstep(0.28f, 0.55f, pores.at(x + shift, y)) * (1.0f - 0.6f * late);

            // Gaps between boards and at butt joints, in pixels.
            const float edgeV =
                std::min(across, 1.0f - across) * (static_cast<float>(kMapSize) / kBoards);
            const float endU = std::min(along, 1.0f - along) * static_cast<float>(kMapSize);
            const float edge = std::min(edgeV, endU);
            const float gap = smoothstep(1.5f, 0.4f, edge);
            const float bevel = smoothstep(5.0f, 1.0f, edge);

            glm::vec3 color = glm::mix(
                light, dark,
                saturate(0.22f + 0.50f * late + 0.45f * f + 0.4f * figure.at(x + shift, y)));
            color *= 0.80f + 0.36f * random2 + 0.25f * tone.row(y)[x];
            color = glm::mix(color, dark * 0.45f, 0.75f * pore);
            color *= (1.0f - 0.85f * gap) * (1.0f - 0.18f * bevel);
            s.setColor(x, y, color);
            s.roughness.row(y)[x] = 0.46f + 0.10f * f - 0.06f * late + 0.22f * pore + 0.3f * gap;
            s.height.row(y)[x] = -0.0045f * gap - 0.0018f * bevel - 0.0010f * pore +
                                 0.0005f * late + 0.0006f * f + 0.0008f * (random - 0.5f);
        }
    });
    s.cavityRadius = 6;
    s.cavityStrength = 1.2f;
    return s;
}

// Cognac full-grain leather: pebbles of two sizes separated by creases, wear on their tops.
Surface leather() {
    Surface s(kMapSize);
    const Field warpX = fbm(kMapSize, {7, 7, 4, 0.55f, 101}),
                warpY = fbm(kMapSize, {7, 7, 4, 0.55f, 102});
    const VoronoiCells pebbles = voronoi(kMapSize, 30, 30, 1.0f, 103);
    const VoronoiCells grains = voronoi(kMapSize, 58, 58, 1.0f, 104);
    const Field crease = warp(pebbles.edge, warpX, warpY, 22.0f);
    const Field fineCrease = warp(grains.edge, warpY, warpX, 14.0f);
    const Field tint = fbm(kMapSize, {3, 3, 5, 0.55f, 105});
    const Field pore = fbm(kMapSize, {110, 110, 1, 0.5f, 106});
    const glm::vec3 brown(0.235f, 0.090f, 0.034f), deep(0.085f, 0.029f, 0.014f);
    const glm::vec3 rubbed(0.37f, 0.165f, 0.068f);
    forRows(kMapSize, [&](int y) {
        for (int x = 0; x < kMapSize; ++x) {
            const float e = saturate(crease.row(y)[x] * 2.6f);
            const float dome = e * (2.0f - e);
            const float fine = smoothstep(0.0f, 0.30f, fineCrease.row(y)[x]);
            const float top = 0.78f * dome + 0.22f * fine * dome;
            const float t = tint.row(y)[x];
            const float wear = smoothstep(0.05f, 0.6f, t) * dome;
            glm::vec3 color = glm::mix(deep, brown, 0.42f + 0.58f * smoothstep(0.0f, 0.7f, top));
            color = glm::mix(color, rubbed, 0.6f * wear);
            color *= 1.0f + 0.35f * t;
            s.setColor(x, y, color);
            s.roughness.row(y)[x] = 0.60f - 0.16f * top - 0.06f * wear + 0.05f * pore.row(y)[x];
            s.height.row(y)[x] = 0.0052f * top + 0.0003f * pore.row(y)[x] + 0.002f * t;
        }
    });
    s.cavityRadius = 6;
    s.cavityStrength = 1.0f;
    return s;
}

} // namespace patina::library
