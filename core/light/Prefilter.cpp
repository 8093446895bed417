#include "core/light/Prefilter.h"

#include "core/base/Check.h"
#include "core/job/Parallel.h"
#include "core/light/Cubemap.h"
#include "core/light/PrefilterSums.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <memory>
#include <numbers>

namespace patina {

namespace {

using namespace detail;

constexpr int kTile = 8; // texels on a tile's side
constexpr int kLobeFace = 4;
// Of a texel's width: through a narrower lobe a texel is a disc and no point.
constexpr float kPointLobe = 0.5f;
constexpr float kBrightGroup = 0.08f; // of the distance + 2 alpha: how wide a group may be

// A tile of face +Z: its texels, rows one after another; unused lanes repeat the last texel.
struct Tile {
    TileDirections directions;
    int x0, y0, side;
    glm::vec3 centre{0.0f};
    float radius; // angle to the farthest texel

    Tile(int size, int x, int y)
        : x0(x)
        , y0(y)
        , side(std::min(kTile, size)) {
        const int count = side * side;
        for (int i = 0; i < kTileTexels; ++i) {
            const int k = std::min(i, count - 1);
            const auto position = [&](int at) {
                return (static_cast<float>(at) + 0.5f) / static_cast<float>(size);
            };
            const glm::vec3 d = glm::normalize(
                cubeDirection(kLobeFace, position(x0 + k % side), position(y0 + k / side)));
            directions.x[i] = d.x;
            directions.y[i] = d.y;
            directions.z[i] = d.z;
            centre += d;
        }
        centre = glm::normalize(centre);
        float cosine = 1.0f;
        for (int i = 0; i < count; ++i)
            cosine = std::min(cosine, glm::dot(centre, direction(i)));
        radius = std::acos(std::clamp(cosine, -1.0f, 1.0f));
    }

    [[nodiscard]] glm::vec3 direction(int i) const {
        return {directions.x[i], directions.y[i], directions.z[i]};
    }
};

// The cells a tile sums over, by level and face.
class CellList {
  public:
    CellList(const CubePyramid& pyramid, float alpha, const PrefilterQuality& quality)
        : m_levels(pyramid.levels())
        , m_alpha(alpha)
        , m_quality(quality)
        , m_groups(m_levels.size() * 6) {}

    struct Group {
        std::vector<glm::vec4> cells; // direction, solid angle
        std::vector<int> x, y;        // on the face
    };

    void collect(const Tile& tile) {
        for (Group& group : m_groups) {
            group.cells.clear();
            group.x.clear();
            group.y.clear();
        }
        const int coarsest = static_cast<int>(m_levels.size()) - 1;
        for (int face = 0; face < 6; ++face)
            visit(tile, coarsest, face, 0, 0);
    }

    [[nodiscard]] const Group& group(std::size_t level, int face) const {
        return m_groups[level * 6 + face];
    }

  private:
    void visit(const Tile& tile, int index, int face, int x, int y) {
        const CubePyramid::Level& level = m_levels[index];
        const glm::vec4& inPlusZ = level.cells[static_cast<std::size_t>(y) * level.size + x];
        const glm::vec3 direction = cubeSymmetries()[face].matrix * glm::vec3(inPlusZ);
        const float width =
            2.0f / static_cast<float>(level.size); // of the central cell, the largest
        const float chord = glm::length(direction - tile.centre);

        // Wholly behind the horizon of every texel: N·L <= 0.
        const float horizon = 0.5f * std::numbers::pi_v<float> + tile.radius + 0.71f * width;
        if (horizon < std::numbers::pi_v<float> && chord > 2.0f * std::sin(0.5f * horizon))
            return;

        // The chord never exceeds the angle: the test errs on the side of smaller cells.
        const float distance = std::max(chord - tile.radius, 0.0f);
        const float allowed =
            std::min(m_quality.relative * (distance + 2.0f * m_alpha), m_quality.widest);
        if (index == 0 || width <= allowed) {
            Group& group = m_groups[static_cast<std::size_t>(index) * 6 + face];
            group.cells.emplace_back(direction, inPlusZ.w);
            group.x.push_back(x);
            group.y.push_back(y);
            return;
        }
        for (int k = 0; k < 4; ++k)
            visit(tile, index - 1, face, 2 * x + k % 2, 2 * y + k / 2);
    }

    const std::vector<CubePyramid::Level>& m_levels;
    float m_alpha;
    PrefilterQuality m_quality;
    std::vector<Group> m_groups;
};

// Filters one tile of face +Z and its images.
class TileFilter {
  public:
    TileFilter(const CubePyramid& pyramid, float alpha, const PrefilterQuality& quality,
               CubeLevel& out)
        : m_pyramid(pyramid)
        , m_alpha(alpha)
        , m_shape{alpha * alpha,
                  alpha < kPointLobe * 2.0f / static_cast<float>(pyramid.levels()[0].size)}
        , m_out(out)
        , m_arithmetic(prefilterSums().front())
        , m_list(pyramid, alpha, quality) {}

    void filter(int x0, int y0, int images) {
        const Tile tile(m_out.size, x0, y0);
        m_list.collect(tile);
        alignas(64) float total[kTileTexels] = {};
        std::array<TileSums, 48> sums;
        for (std::size_t level = 0; level < m_pyramid.levels().size(); ++level)
            for (int face = 0; face < 6; ++face)
                addGroup(tile, m_list.group(level, face), level, face, images, total, sums);
        for (int i = 0; i < images; ++i) {
            const CubeSymmetry& symmetry = cubeSymmetries()[i];
            addBrightTexels(tile, symmetry, sums[i]);
            write(tile, symmetry, total, sums[i]);
        }
    }

  private:
    void addGroup(const Tile& tile, const CellList::Group& group, std::size_t index, int face,
                  int images, float* total, std::array<TileSums, 48>& sums) {
        const CubePyramid::Level& level = m_pyramid.levels()[index];
        // A cell of 4^k points has that much of the second moment of an even one.
        const float spread = (1.0f - std::exp2(-2.0f * static_cast<float>(index))) / 24.0f;
        const int n = level.size;
        for (std::size_t first = 0; first < group.cells.size(); first += kChunk) {
            const std::size_t count = std::min<std::size_t>(kChunk, group.cells.size() - first);
            m_arithmetic.weigh(tile.directions, std::span(group.cells).subspan(first, count),
                               spread, m_shape, m_weights, total);
            CellPlaces places{std::span(group.x).subspan(first, count),
                              std::span(group.y).subspan(first, count)};
            for (int i = 0; i < images; ++i) {
                // Where the symmetry finds the cells' radiance
                const CubeSymmetry::FaceMap& map = cubeSymmetries()[i].faces[face];
                const int originX = std::min(map.xx, map.xy) < 0 ? n - 1 : 0;
                const int originY = std::min(map.yx, map.yy) < 0 ? n - 1 : 0;
                places.first =
                    static_cast<int>(level.first) + (map.face * n + originY) * n + originX;
                places.alongX = map.yx * n + map.xx;
                places.alongY = map.yy * n + map.xy;
                m_arithmetic.add(m_weights, places, m_pyramid.radiance().data(), sums[i]);
            }
        }
    }

    void addBrightTexels(const Tile& tile, const CubeSymmetry& symmetry, TileSums& sums) {
        if (m_pyramid.brightTexels().empty())
            return;
        TileDirections turned;
        for (int i = 0; i < kTileTexels; ++i) {
            const glm::vec3 d = symmetry.matrix * tile.direction(i);
            turned.x[i] = d.x;
            turned.y[i] = d.y;
            turned.z[i] = d.z;
        }
        const glm::vec3 centre = symmetry.matrix * tile.centre;
        const float horizon = -std::sin(tile.radius) - 1e-4f;
        // A group counts as one texel where it spans little of the kernel's scale.
        const float width = 4.0f / static_cast<float>(m_pyramid.levels()[0].size);
        m_visible.clear();
        for (const CubePyramid::BrightGroup& group : m_pyramid.brightGroups()) {
            const float cosine = glm::dot(centre, group.all.direction);
            if (cosine < horizon - width)
                continue;
            // A group that may be half behind a texel's horizon is not one texel, however far.
            const float distance = glm::length(centre - group.all.direction) - tile.radius;
            if (cosine > -horizon + width &&
                width <= kBrightGroup * (std::max(distance, 0.0f) + 2.0f * m_alpha))
                m_visible.push_back(group.all);
            else
                m_visible.insert(m_visible.end(),
                                 m_pyramid.brightTexels().begin() +
                                     static_cast<std::ptrdiff_t>(group.first),
                                 m_pyramid.brightTexels().begin() +
                                     static_cast<std::ptrdiff_t>(group.first + group.count));
        }
        m_arithmetic.addBrightTexels(turned, m_visible, m_shape, sums);
    }

    void write(const Tile& tile, const CubeSymmetry& symmetry, const float* total,
               const TileSums& sums) {
        const int n = m_out.size;
        for (int i = 0; i < tile.side * tile.side; ++i) {
            const int x = tile.x0 + i % tile.side, y = tile.y0 + i / tile.side;
            const int across = symmetry.transposed ? y : x, down = symmetry.transposed ? x : y;
            const int column = symmetry.mirrorX ? n - 1 - across : across;
            const int row = symmetry.mirrorY ? n - 1 - down : down;
            m_out.texels[(static_cast<std::size_t>(symmetry.face) * n + row) * n + column] =
                glm::vec3(sums.red[i], sums.green[i], sums.blue[i]) / total[i];
        }
    }

    const CubePyramid& m_pyramid;
    float m_alpha;
    LobeShape m_shape;
    CubeLevel& m_out;
    PrefilterSums m_arithmetic;
    CellList m_list;
    CellWeights m_weights;
    std::vector<CubePyramid::BrightTexel> m_visible;
};

} // namespace

CubeLevel prefilterGGX(const CubePyramid& pyramid, int size, float alpha,
                       const PrefilterQuality& quality, const JobContext& job) {
    CHECK(alpha > 0.0f);
    CHECK(std::has_single_bit(static_cast<unsigned>(size)));
    CubeLevel out;
    out.size = size;
    out.texels.resize(6 * static_cast<std::size_t>(size) * size);

    // A quarter of a face's tiles on one side of its diagonal; their images are all. A single tile
    // is mirrored into itself, one on the diagonal transposed into itself.
    const int tiles = (size + kTile - 1) / kTile;
    std::vector<glm::ivec2> corners;
    for (int y = 0; y < (tiles + 1) / 2; ++y)
        for (int x = 0; x <= y; ++x)
            corners.emplace_back(x, y);
    parallelFor(job, corners.size(), 1, [&](std::size_t begin, std::size_t end) {
        const auto filter = std::make_unique<TileFilter>(pyramid, alpha, quality, out);
        for (std::size_t i = begin; i < end; ++i) {
            const glm::ivec2 corner = corners[i];
            const int images = tiles == 1 ? 6 : corner.x == corner.y ? 24 : 48;
            filter->filter(corner.x * kTile, corner.y * kTile, images);
        }
    });
    return out;
}

} // namespace patina
