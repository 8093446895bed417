#include "core/library/MaterialRecipes.h"
#include "core/library/Noise.h"
#include "core/math/PortableMath.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

namespace patina::library {

namespace {

// Reflectance at normal incidence in linear sRGB, from measured optical constants (Hoffman,
// "Background: Physics and Math of Shading", 2013, table 1).
const glm::vec3 kGold(1.0f, 0.765f, 0.336f);
const glm::vec3 kCopper(0.955f, 0.638f, 0.538f);
const glm::vec3 kSteel(0.560f, 0.570f, 0.580f);

} // namespace

// Teal enamel over a light primer over steel. One "wear" field decides all layers: where it passes
// a threshold the paint is gone; just inside the paint's edge the primer shows, just outside the
// steel has rusted.
Surface wornPaintedMetal() {
    Surface s(kMapSize);
    const Field large = fbm(kMapSize, {3, 3, 3, 0.5f, 11});
    const Field detail = fbm(kMapSize, {8, 8, 6, 0.6f, 12});
    const Field fine = fbm(kMapSize, {32, 32, 4, 0.6f, 13});
    const Field tone = fbm(kMapSize, {2, 2, 4, 0.5f, 14});
    const Field smudge = warp(fbm(kMapSize, {4, 4, 5, 0.55f, 15}), large, detail, 40.0f);
    const Field deep = strokes(kMapSize, {26, 30, 130, 1.1f, 25, 50, 16});
    const Field hair = strokes(kMapSize, {110, 20, 90, 0.6f, 20, 120, 17});

    const glm::vec3 teal(0.020f, 0.205f, 0.215f), tealWorn(0.065f, 0.270f, 0.270f);
    const glm::vec3 primer(0.40f, 0.36f, 0.30f);
    const glm::vec3 rustDark(0.115f, 0.038f, 0.018f), rustBright(0.36f, 0.125f, 0.035f);

    forRows(kMapSize, [&](int y) {
        for (int x = 0; x < kMapSize; ++x) {
            const float a = large.row(y)[x], b = detail.row(y)[x], c = fine.row(y)[x];
            const float scratch = deep.row(y)[x], hairline = hair.row(y)[x];

            // Positive: the paint is gone. Deep scratches cut through it.
            const float wear = std::max(0.9f * a + 0.85f * b + 0.12f * c - 0.345f,
                                        scratch * 0.22f - 0.13f + 0.1f * c);
            const float bare = smoothstep(-0.004f, 0.012f, wear);
            const float primerEdge =
                smoothstep(-0.050f, -0.030f, wear + 0.035f * c) * (1.0f - bare);
            const float rim = 1.0f - smoothstep(0.02f, 0.16f, wear + 0.16f * c + 0.04f * b);
            const float rust = bare * saturate(rim + smoothstep(0.08f, 0.35f, c) * 0.6f);
            const float stain = smoothstep(-0.17f, -0.02f, wear + 0.07f * c) * (1.0f - bare) *
                                smoothstep(-0.1f, 0.3f, smudge.row(y)[x] + 0.4f * a);

            // Colour: paint, its chalky primer, rust stains bleeding over both, steel, rust.
            glm::vec3 paint = glm::mix(teal, tealWorn, saturate(0.42f + 0.9f * tone.row(y)[x]));
            paint = glm::mix(paint, tealWorn * 1.35f, 0.45f * hairline);
            paint *= 1.0f - 0.22f * smoothstep(0.0f, 0.45f, smudge.row(y)[x]);
            glm::vec3 color = glm::mix(paint, primer, primerEdge * 0.85f);
            color = glm::mix(color, rustDark * 1.3f, stain * 0.55f);
            const glm::vec3 steel = kSteel * (0.78f + 0.35f * c + 0.12f * hairline);
            const glm::vec3 rusty =
                glm::mix(rustDark, rustBright, smoothstep(-0.25f, 0.3f, b + 0.7f * c));
            color = glm::mix(color, glm::mix(steel, rusty, rust), bare);
            s.setColor(x, y, color);

            const float paintRough = 0.17f + 0.20f * smoothstep(0.0f, 0.45f, smudge.row(y)[x]) +
                                     0.20f * hairline + 0.30f * primerEdge + 0.25f * stain;
            const float bareRough = mix(0.34f + 0.18f * c, 0.86f + 0.1f * c, rust);
            s.roughness.row(y)[x] = mix(paintRough, bareRough, bare);
            s.metallic.row(y)[x] = bare * (1.0f - rust);

            // 0.5 mm of paint on a tile of 0.7 m, orange peel, blistered rust, scratches.
            const float thickness = (1.0f - bare) * (1.0f - 0.35f * primerEdge);
            s.height.row(y)[x] = 0.0016f * thickness + 0.00016f * c * (1.0f - bare) +
                                 rust * (0.0014f * (c + 0.35f) + 0.0008f * b) +
                                 0.0012f * stain * (1.0f - bare) * (0.3f + b) - 0.00025f * hairline;
        }
    });
    s.cavityStrength = 2.0f;
    s.cavityRadius = 8;
    return s;
}

// Copper that has been outside: bright only where it is rubbed, brown oxide, then verdigris that
// gathers in the hollows and runs down.
Surface copperPatina() {
    Surface s(kMapSize);
    const Field large = fbm(kMapSize, {3, 3, 4, 0.5f, 21});
    const Field detail = fbm(kMapSize, {10, 10, 5, 0.6f, 22});
    const Field powder = fbm(kMapSize, {48, 48, 3, 0.7f, 23});
    const Field runs = warp(fbm(kMapSize, {24, 2, 4, 0.55f, 24}), detail, large, 10.0f);
    const VoronoiCells dents = voronoi(kMapSize, 7, 7, 0.9f, 25);
    const Field scratch = strokes(kMapSize, {90, 20, 110, 0.6f, 0, 360, 26});

    const glm::vec3 brown(0.26f, 0.105f, 0.058f), darkBrown(0.075f, 0.036f, 0.026f);
    const glm::vec3 verdigris(0.065f, 0.255f, 0.205f), pale(0.285f, 0.51f, 0.425f);

    forRows(kMapSize, [&](int y) {
        for (int x = 0; x < kMapSize; ++x) {
            const float a = large.row(y)[x], b = detail.row(y)[x], p = powder.row(y)[x];
            const float dent = dents.nearest.row(y)[x];
            const float hammered = 0.5f * dent * dent; // shallow bowls
            const float growth =
                1.0f * a + 0.55f * b + 0.55f * runs.row(y)[x] + 0.35f * (0.32f - hammered) - 0.05f;
            const float green = smoothstep(0.00f, 0.20f, growth + 0.20f * p);
            const float oxide = smoothstep(-0.75f, -0.30f, growth + 0.25f * p);
            const float rubbed = scratch.row(y)[x] * (1.0f - green);

            const glm::vec3 copper = kCopper * (0.92f + 0.2f * b);
            const glm::vec3 tarnish = glm::mix(brown, darkBrown, smoothstep(-0.2f, 0.4f, b + p));
            glm::vec3 color = glm::mix(copper, glm::mix(tarnish, kCopper * 0.5f, 0.3f),
                                       oxide * (1.0f - 0.7f * rubbed));
            const glm::vec3 salt =
                glm::mix(verdigris, pale, smoothstep(0.05f, 0.65f, growth + 0.6f * p));
            color = glm::mix(color, salt, green);
            s.setColor(x, y, color);

            s.metallic.row(y)[x] = (1.0f - green) * mix(1.0f, 0.55f, oxide * (1.0f - rubbed));
            s.roughness.row(y)[x] =
                mix(mix(0.24f + 0.12f * b, 0.50f + 0.15f * p, oxide) - 0.1f * rubbed,
                    0.86f + 0.1f * p, green);
            s.height.row(y)[x] = 0.0075f * hammered + green * (0.0012f + 0.0022f * p + 0.001f * b) -
                                 0.0002f * scratch.row(y)[x];
        }
    });
    s.cavityStrength = 1.6f;
    return s;
}

// Hammered sheet gold: overlapping shallow facets, polished, with fine hair scratches.
Surface gold() {
    Surface s(kMapSize);
    const Field warpX = fbm(kMapSize, {6, 6, 3, 0.5f, 31}),
                warpY = fbm(kMapSize, {6, 6, 3, 0.5f, 32});
    const VoronoiCells cells = voronoi(kMapSize, 9, 9, 0.95f, 33);
    const Field bowls = blur(warp(cells.nearest, warpX, warpY, 9.0f), 2);
    const Field smudge = fbm(kMapSize, {4, 4, 5, 0.6f, 34});
    const Field hair = strokes(kMapSize, {160, 20, 120, 0.55f, 0, 360, 35});
    const Field grain = fbm(kMapSize, {64, 64, 2, 0.6f, 36});
    forRows(kMapSize, [&](int y) {
        for (int x = 0; x < kMapSize; ++x) {
            const float d = bowls.row(y)[x];
            const float soft = d * d / (0.35f + d); // bowls meet in rounded crests
            const float dirt = smoothstep(0.05f, 0.5f, smudge.row(y)[x]);
            s.setColor(x, y, kGold * (1.0f - 0.07f * dirt));
            s.roughness.row(y)[x] =
                0.17f + 0.10f * dirt + 0.10f * hair.row(y)[x] + 0.03f * grain.row(y)[x];
            s.metallic.row(y)[x] = 1.0f;
            s.height.row(y)[x] = 0.0075f * soft + 0.0002f * grain.row(y)[x] +
                                 0.0006f * smudge.row(y)[x] - 0.00012f * hair.row(y)[x];
        }
    });
    s.cavityRadius = 24;
    return s;
}

// A linear brush finish: streaks along u in roughness and normal spread highlights across them.
Surface brushedSteel() {
    Surface s(kMapSize);
    const Field broad = fbm(kMapSize, {2, 64, 3, 0.6f, 41});
    const Field streak = fbm(kMapSize, {4, 256, 1, 0.6f, 42});
    const Field streak2 = fbm(kMapSize, {1, 128, 2, 0.7f, 43});
    const Field smudge = fbm(kMapSize, {3, 3, 5, 0.5f, 44});
    const Field cuts = strokes(kMapSize, {70, 60, 300, 0.6f, 0, 5, 45});
    forRows(kMapSize, [&](int y) {
        for (int x = 0; x < kMapSize; ++x) {
            const float line =
                0.45f * broad.row(y)[x] + 0.3f * streak.row(y)[x] + 0.45f * streak2.row(y)[x];
            const float print = smoothstep(0.05f, 0.5f, smudge.row(y)[x]);
            s.setColor(x, y,
                       glm::vec3(0.585f, 0.575f, 0.560f) * (1.0f + 0.22f * line - 0.06f * print));
            s.roughness.row(y)[x] = 0.33f + 0.20f * line + 0.07f * print + 0.08f * cuts.row(y)[x];
            s.metallic.row(y)[x] = 1.0f;
            s.height.row(y)[x] = 0.00055f * line - 0.0004f * cuts.row(y)[x];
        }
    });
    s.cavityStrength = 0.6f;
    s.cavityRadius = 4;
    return s;
}

} // namespace patina::library
