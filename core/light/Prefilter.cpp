#include "core/light/Prefilter.h"

#include "core/base/Check.h"
#include "core/job/Parallel.h"
#include "core/light/Cubemap.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace patina {

namespace {

constexpr int kTile = 8; // texels on a tile's side
constexpr int kTileTexels = kTile * kTile;
constexpr int kLanes = 8;

// Eight floats that the compiler maps to whatever registers the target has.
using Lanes = float __attribute__((vector_size(kLanes * sizeof(float))));

struct Cell {
    glm::vec3 direction;
    float solidAngle;
    glm::vec3 radiance;
};

// The tile's texels as structure of arrays; unused lanes repeat the last texel.
struct alignas(64) TileTexels {
    std::array<float, kTileTexels> x, y, z;
    std::array<float, kTileTexels> r, g, b;
};

// Σ w L / Σ w over the cells with w = N·L Ω / d², d = ((1 + c)/2 (alpha² - 1) + 1), c = N·L.
// With t = |N - L|² / 4 = (1 - c) / 2 that is d = t + alpha² (1 - t) and c = 1 - 2t: no
// cancellation where the lobe peaks.
[[gnu::always_inline]] inline void sumCells(const std::vector<Cell>& cells, float alpha2,
                                            int groups, TileTexels& tile) {
    for (int group = 0; group < groups; ++group) {
        Lanes nx, ny, nz;
        for (int k = 0; k < kLanes; ++k) {
            nx[k] = tile.x[group * kLanes + k];
            ny[k] = tile.y[group * kLanes + k];
            nz[k] = tile.z[group * kLanes + k];
        }
        Lanes red{}, green{}, blue{}, weights{};
        const Lanes zero{};
        for (const Cell& cell : cells) {
            const Lanes dx = nx - cell.direction.x;
            const Lanes dy = ny - cell.direction.y;
            const Lanes dz = nz - cell.direction.z;
            const Lanes t = (dx * dx + dy * dy + dz * dz) * 0.25f;
            const Lanes cosine = 1.0f - 2.0f * t;
            const Lanes d = t + alpha2 * (1.0f - t);
            const Lanes w = (cosine > zero ? cosine : zero) * cell.solidAngle / (d * d);
            red += w * cell.radiance.x;
            green += w * cell.radiance.y;
            blue += w * cell.radiance.z;
            weights += w;
        }
        red /= weights;
        green /= weights;
        blue /= weights;
        for (int k = 0; k < kLanes; ++k) {
            tile.r[group * kLanes + k] = red[k];
            tile.g[group * kLanes + k] = green[k];
            tile.b[group * kLanes + k] = blue[k];
        }
    }
}

using SumCells = void (*)(const std::vector<Cell>&, float, int, TileTexels&);

void sumCellsBaseline(const std::vector<Cell>& cells, float alpha2, int groups, TileTexels& tile) {
    sumCells(cells, alpha2, groups, tile);
}

#if defined(__x86_64__)
[[gnu::target("avx2,fma")]] void sumCellsAvx2(const std::vector<Cell>& cells, float alpha2,
                                              int groups, TileTexels& tile) {
    sumCells(cells, alpha2, groups, tile);
}
#endif

// The widest instructions this machine has.
SumCells chooseSumCells() {
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
        return sumCellsAvx2;
#endif
    return sumCellsBaseline;
}

// Walks the pyramid for one tile.
class CellCollector {
  public:
    CellCollector(const CubePyramid& pyramid, float alpha, const PrefilterQuality& quality)
        : m_levels(pyramid.levels())
        , m_alpha(alpha)
        , m_quality(quality) {}

    // `centre`: unit vector; `radius`: angle to the tile's farthest texel.
    void collect(const glm::vec3& centre, float radius, std::vector<Cell>& cells) {
        m_centre = centre;
        m_radius = radius;
        cells.clear();
        const int coarsest = static_cast<int>(m_levels.size()) - 1;
        for (int face = 0; face < 6; ++face)
            visit(coarsest, face, 0, 0, cells);
    }

  private:
    void visit(int index, int face, int x, int y, std::vector<Cell>& cells) {
        const CubePyramid::Level& level = m_levels[index];
        const int n = level.radiance.size;
        const std::size_t at = (static_cast<std::size_t>(face) * n + y) * n + x;
        const glm::vec4& cell = level.cells[at];
        const glm::vec3 direction(cell);
        const float width = 2.0f / static_cast<float>(n); // of a face's central cell, the largest
        const float chord = glm::length(direction - m_centre);

        // Wholly behind the horizon of every texel: N·L <= 0.
        const float horizon = 0.5f * std::numbers::pi_v<float> + m_radius + 0.71f * width;
        if (horizon < std::numbers::pi_v<float> && chord > 2.0f * std::sin(0.5f * horizon))
            return;

        // The chord never exceeds the angle: the test errs on the side of smaller cells.
        const float distance = std::max(chord - m_radius, 0.0f);
        const float allowed =
            std::min(m_quality.relative * (distance + 2.0f * m_alpha), m_quality.widest);
        if (index == 0 || width <= allowed) {
            cells.push_back({direction, cell.w, level.radiance.texels[at]});
            return;
        }
        for (int k = 0; k < 4; ++k)
            visit(index - 1, face, 2 * x + k % 2, 2 * y + k / 2, cells);
    }

    const std::vector<CubePyramid::Level>& m_levels;
    float m_alpha;
    PrefilterQuality m_quality;
    glm::vec3 m_centre{0.0f};
    float m_radius = 0.0f;
};

} // namespace

namespace {

// Where a cell's light comes from: the mean of its children's directions, weighted by their flux.
// A small sun in a large cell keeps its place to first order. A dark cell takes its middle.
glm::vec3 centroid(const CubePyramid::Level& children, int face, int x, int y) {
    const int n = children.radiance.size;
    glm::vec3 byFlux(0.0f), bySolidAngle(0.0f);
    for (int k = 0; k < 4; ++k) {
        const std::size_t at =
            (static_cast<std::size_t>(face) * n + 2 * y + k / 2) * n + 2 * x + k % 2;
        const glm::vec4& child = children.cells[at];
        const glm::vec3 weighted = glm::vec3(child) * child.w;
        const glm::vec3& radiance = children.radiance.texels[at];
        byFlux += weighted * std::max(radiance.x + radiance.y + radiance.z, 0.0f);
        bySolidAngle += weighted;
    }
    const float length = glm::length(byFlux);
    return length > 0.0f && std::isfinite(length) ? byFlux / length : glm::normalize(bySolidAngle);
}

} // namespace

CubePyramid::CubePyramid(CubeLevel base) {
    CHECK(std::has_single_bit(static_cast<unsigned>(base.size)));
    m_levels.push_back({std::move(base), {}});
    while (m_levels.back().radiance.size > 1)
        m_levels.push_back({halveCube(m_levels.back().radiance), {}});
    for (std::size_t index = 0; index < m_levels.size(); ++index) {
        Level& level = m_levels[index];
        const int n = level.radiance.size;
        const std::vector<float> omega = cubeSolidAngles(n);
        level.cells.resize(level.radiance.texels.size());
        for (int face = 0; face < 6; ++face)
            for (int y = 0; y < n; ++y)
                for (int x = 0; x < n; ++x) {
                    const std::size_t texel = static_cast<std::size_t>(y) * n + x;
                    const std::size_t at = face * omega.size() + texel;
                    const glm::vec3 direction =
                        index == 0
                            ? glm::normalize(cubeDirection(
                                  face, (static_cast<float>(x) + 0.5f) / static_cast<float>(n),
                                  (static_cast<float>(y) + 0.5f) / static_cast<float>(n)))
                            : centroid(m_levels[index - 1], face, x, y);
                    level.cells[at] = glm::vec4(direction, omega[texel]);
                }
    }
}

CubeLevel prefilterGGX(const CubePyramid& pyramid, int size, float alpha,
                       const PrefilterQuality& quality, const JobContext& job) {
    CHECK(alpha > 0.0f);
    CubeLevel out;
    out.size = size;
    out.texels.resize(6 * static_cast<std::size_t>(size) * size);

    const int side = std::min(kTile, size);
    const int tilesAcross = (size + side - 1) / side;
    const std::size_t tiles = 6 * static_cast<std::size_t>(tilesAcross) * tilesAcross;
    const SumCells sum = chooseSumCells();
    parallelFor(job, tiles, 1, [&](std::size_t begin, std::size_t end) {
        CellCollector collector(pyramid, alpha, quality);
        std::vector<Cell> cells;
        TileTexels tile;
        for (std::size_t index = begin; index < end; ++index) {
            const int face = static_cast<int>(index) / (tilesAcross * tilesAcross);
            const int x0 = static_cast<int>(index) % tilesAcross * side;
            const int y0 = static_cast<int>(index) / tilesAcross % tilesAcross * side;
            const int columns = std::min(side, size - x0), rows = std::min(side, size - y0);

            // The tile's texels, its centre and its radius
            const int count = columns * rows;
            const int groups = (count + kLanes - 1) / kLanes;
            glm::vec3 centre(0.0f);
            std::array<glm::vec3, kTileTexels> directions;
            for (int i = 0; i < groups * kLanes; ++i) {
                const int k = std::min(i, count - 1);
                const float s =
                    (static_cast<float>(x0 + k % columns) + 0.5f) / static_cast<float>(size);
                const float t =
                    (static_cast<float>(y0 + k / columns) + 0.5f) / static_cast<float>(size);
                directions[i] = glm::normalize(cubeDirection(face, s, t));
                tile.x[i] = directions[i].x;
                tile.y[i] = directions[i].y;
                tile.z[i] = directions[i].z;
                centre += directions[i];
            }
            centre = glm::normalize(centre);
            float cosRadius = 1.0f;
            for (int i = 0; i < count; ++i)
                cosRadius = std::min(cosRadius, glm::dot(directions[i], centre));
            const float radius = std::acos(std::clamp(cosRadius, -1.0f, 1.0f));

            collector.collect(centre, radius, cells);
            sum(cells, alpha * alpha, groups, tile);
            for (int i = 0; i < count; ++i)
                out.texels[(static_cast<std::size_t>(face) * size + y0 + i / columns) * size + x0 +
                           i % columns] = {tile.r[i], tile.g[i], tile.b[i]};
        }
    });
    return out;
}

} // namespace patina
