#include "core/library/Noise.h"

#include "core/math/PortableMath.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace patina::library {

namespace {

float fade(float t) {
    return t * t * t * (t * (t * 6.0f - 15.0f) + 10.0f);
}

// Lattice column and position within the cell for every pixel along one axis.
struct AxisTable {
    std::vector<int> cell;
    std::vector<float> t, weight;
    AxisTable(int size, int cells)
        : cell(static_cast<std::size_t>(size))
        , t(static_cast<std::size_t>(size))
        , weight(static_cast<std::size_t>(size)) {
        for (int i = 0; i < size; ++i) {
            const auto k = static_cast<std::size_t>(i);
            const float x = (static_cast<float>(i) + 0.5f) * static_cast<float>(cells) /
                            static_cast<float>(size);
            cell[k] = std::min(static_cast<int>(x), cells - 1);
            t[k] = x - static_cast<float>(cell[k]);
            weight[k] = fade(t[k]);
        }
    }
};

struct Lattice {
    int cellsX;
    std::vector<float> gx, gy;
    Lattice(int cx, int cy, std::uint32_t seed)
        : cellsX(cx)
        , gx(static_cast<std::size_t>(cx) * static_cast<std::size_t>(cy))
        , gy(gx.size()) {
        // 64 directions: a table, because a sine per lattice point would cost more than the noise.
        float directions[64][2];
        for (int i = 0; i < 64; ++i) {
            directions[i][0] = static_cast<float>(cosTurns(i / 64.0));
            directions[i][1] = static_cast<float>(sinTurns(i / 64.0));
        }
        for (int y = 0; y < cy; ++y)
            for (int x = 0; x < cx; ++x) {
                const auto h =
                    hashInt(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y), seed) >>
                    26;
                const auto k = static_cast<std::size_t>(y * cx + x);
                gx[k] = directions[h][0];
                gy[k] = directions[h][1];
            }
    }
};

// result = shape(noise) * amplitude, added up.
template <class Shape>
void addNoise(Field& result, int cellsX, int cellsY, std::uint32_t seed, const Shape& shape) {
    const int n = result.size();
    const Lattice lattice(cellsX, cellsY, seed);
    const AxisTable xs(n, cellsX), ys(n, cellsY);
    forRows(n, [&](int y) {
        const auto ky = static_cast<std::size_t>(y);
        const int top = ys.cell[ky], bottom = (top + 1) % cellsY;
        const float ty = ys.t[ky], wy = ys.weight[ky];

        // Along a row the noise of a lattice column is the line slope * tx + value.
        std::vector<float> slope(static_cast<std::size_t>(cellsX) + 1), value(slope.size());
        for (int i = 0; i <= cellsX; ++i) {
            const auto a = static_cast<std::size_t>(top * cellsX + i % cellsX);
            const auto b = static_cast<std::size_t>(bottom * cellsX + i % cellsX);
            const auto k = static_cast<std::size_t>(i);
            slope[k] = mix(lattice.gx[a], lattice.gx[b], wy);
            value[k] = mix(lattice.gy[a] * ty, lattice.gy[b] * (ty - 1.0f), wy);
        }
        float* out = result.row(y);
        for (int x = 0; x < n; ++x) {
            const auto kx = static_cast<std::size_t>(x);
            const auto k = static_cast<std::size_t>(xs.cell[kx]);
            const float tx = xs.t[kx];
            const float left = slope[k] * tx + value[k];
            const float right = slope[k + 1] * (tx - 1.0f) + value[k + 1];
            // Gradients have length 1, so that the extremes are ±sqrt(1/2).
            out[x] += shape(1.41421356f * mix(left, right, xs.weight[kx]));
        }
    });
}

template <class Shape>
Field sumOctaves(int size, const FbmSettings& s, const Shape& shape) {
    Field result(size);
    float total = 0.0f, amplitude = 1.0f;
    for (int octave = 0; octave < s.octaves; ++octave, amplitude *= s.gain)
        total += amplitude;
    amplitude = 1.0f / total;
    for (int octave = 0; octave < s.octaves; ++octave, amplitude *= s.gain)
        addNoise(result, s.cellsX << octave, s.cellsY << octave,
                 hashInt(s.seed * 31u + static_cast<std::uint32_t>(octave)),
                 [=](float noise) { return amplitude * shape(noise); });
    return result;
}

} // namespace

Field gradientNoise(int size, int cellsX, int cellsY, std::uint32_t seed) {
    Field result(size);
    addNoise(result, cellsX, cellsY, hashInt(seed), [](float noise) { return noise; });
    return result;
}

Field fbm(int size, const FbmSettings& settings) {
    return sumOctaves(size, settings, [](float noise) { return noise; });
}

Field ridged(int size, const FbmSettings& settings) {
    return sumOctaves(size, settings, [](float noise) {
        const float crest = 1.0f - std::fabs(noise);
        return crest * crest;
    });
}

VoronoiCells voronoi(int size, int cellsX, int cellsY, float jitter, std::uint32_t seed) {
    struct Site {
        float x, y, random;
    };
    std::vector<Site> sites(static_cast<std::size_t>(cellsX) * static_cast<std::size_t>(cellsY));
    for (int y = 0; y < cellsY; ++y)
        for (int x = 0; x < cellsX; ++x) {
            const auto h =
                hashInt(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y), seed);
            sites[static_cast<std::size_t>(y * cellsX + x)] = {
                0.5f + jitter * (hashToFloat(h) - 0.5f),
                0.5f + jitter * (hashToFloat(hashInt(h)) - 0.5f),
                hashToFloat(hashInt(h ^ 0x68bc21ebu))};
        }

    VoronoiCells result{Field(size), Field(size), Field(size)};
    const float scaleX = static_cast<float>(cellsX) / static_cast<float>(size);
    const float scaleY = static_cast<float>(cellsY) / static_cast<float>(size);
    forRows(size, [&](int y) {
        const float py = (static_cast<float>(y) + 0.5f) * scaleY;
        const int cy = std::min(static_cast<int>(py), cellsY - 1);
        for (int x = 0; x < size; ++x) {
            const float px = (static_cast<float>(x) + 0.5f) * scaleX;
            const int cx = std::min(static_cast<int>(px), cellsX - 1);
            float dx[9], dy[9], random = 0.0f, best = 1e9f;
            int bestIndex = 0;
            for (int j = -1, k = 0; j <= 1; ++j)
                for (int i = -1; i <= 1; ++i, ++k) {
                    const Site& site = sites[static_cast<std::size_t>(
                        ((cy + j + cellsY) % cellsY) * cellsX + (cx + i + cellsX) % cellsX)];
                    dx[k] = static_cast<float>(cx + i) + site.x - px;
                    dy[k] = static_cast<float>(cy + j) + site.y - py;
                    const float d = dx[k] * dx[k] + dy[k] * dy[k];
                    if (d < best) {
                        best = d;
                        bestIndex = k;
                        random = site.random;
                    }
                }
            // Distance to the perpendicular bisector with each neighbour (Quilez, "Voronoi edges").
            float edge = 1e9f;
            for (int k = 0; k < 9; ++k) {
                if (k == bestIndex)
                    continue;
                const float ex = dx[k] - dx[bestIndex], ey = dy[k] - dy[bestIndex];
                const float length = std::sqrt(ex * ex + ey * ey);
                const float d =
                    0.5f * ((dx[k] + dx[bestIndex]) * ex + (dy[k] + dy[bestIndex]) * ey) / length;
                edge = std::min(edge, d);
            }
            result.nearest.row(y)[x] = std::sqrt(best);
            result.edge.row(y)[x] = edge;
            result.random.row(y)[x] = random;
        }
    });
    return result;
}

Field strokes(int size, const StrokeSettings& s) {
    Field result(size);
    for (int i = 0; i < s.count; ++i) {
        std::uint32_t h = hashInt(static_cast<std::uint32_t>(i), 0x51u, s.seed);
        const auto next = [&h] { return hashToFloat(h = hashInt(h + 0x9e3779b9u)); };
        const float x0 = next() * static_cast<float>(size);
        const float y0 = next() * static_cast<float>(size);
        const float length = mix(s.minLength, s.maxLength, next());
        const float strength = mix(0.35f, 1.0f, next());
        const double turns =
            (s.directionDeg + s.spreadDeg * (static_cast<double>(next()) - 0.5)) / 360.0;
        const auto dx = static_cast<float>(cosTurns(turns));
        const auto dy = static_cast<float>(sinTurns(turns));
        const float bend = (next() - 0.5f) * 0.25f * length; // sagitta

        // Half-pixel steps along the stroke, each a small round dab.
        const int steps = static_cast<int>(length * 2.0f);
        const int reach = static_cast<int>(s.halfWidth) + 2;
        for (int k = 0; k <= steps; ++k) {
            const float t = static_cast<float>(k) / static_cast<float>(steps);
            const float arc = bend * 4.0f * t * (1.0f - t);
            const float px = x0 + dx * length * t - dy * arc;
            const float py = y0 + dy * length * t + dx * arc;
            const float taper = strength * smoothstep(0.0f, 0.2f, t) * smoothstep(1.0f, 0.6f, t);
            const int cx = static_cast<int>(px + 4096.0f) - 4096;
            const int cy = static_cast<int>(py + 4096.0f) - 4096;
            for (int y = cy - reach; y <= cy + reach; ++y)
                for (int x = cx - reach; x <= cx + reach; ++x) {
                    const float ox = static_cast<float>(x) + 0.5f - px;
                    const float oy = static_cast<float>(y) + 0.5f - py;
                    const float d = std::sqrt(ox * ox + oy * oy);
                    float& pixel = result.at(x, y);
                    pixel = std::max(pixel,
                                     taper * smoothstep(s.halfWidth + 0.7f, s.halfWidth - 0.7f, d));
                }
        }
    }
    return result;
}

} // namespace patina::library
