#include "core/trace/whitted/WhittedTracer.h"

#include "core/base/Check.h"
#include "core/job/Parallel.h"
#include "core/math/Sampling.h"
#include "core/trace/path/Eye.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>

namespace patina {
namespace {

constexpr int kWhittedTile = kTraceTile;
constexpr std::uint32_t kPixelPosition = 0; // dimensions of a stochastic sample: where in the pixel
constexpr std::uint32_t kFirstRay = 1;      // all others but
constexpr std::uint32_t kOnLens = 2;        // where on the lens

// Mitchell 1987, "Generating Antialiased Images at Low Sampling Densities", section 3.
float contrastOf(float least, float most) {
    return least + most > 0.0f ? (most - least) / (most + least) : 0.0f;
}

// The corners of a tile's pixels, which neighbours share.
class TileCorners {
  public:
    TileCorners(int left, int top)
        : m_left(left)
        , m_top(top) {}
    struct Corner {
        bool traced = false;
        WhittedShader::Sample sample;
    };
    [[nodiscard]] Corner& at(int x, int y) {
        return m_corners[static_cast<std::size_t>(y - m_top) * (kWhittedTile + 1) +
                         static_cast<std::size_t>(x - m_left)];
    }

  private:
    int m_left, m_top;
    std::array<Corner, std::size_t{kWhittedTile + 1} * (kWhittedTile + 1)> m_corners;
};

struct PixelValue {
    glm::vec3 radiance{0.0f};
    float alpha = 0.0f;
    RayCounts counts;
};

// Section 3 of Whitted's paper: a square is the mean of its corners where they are nearly equal,
// and else of its quarters.
class AdaptivePixel {
  public:
    AdaptivePixel(WhittedShader& shader, const Eye& eye, const WhittedSettings& settings)
        : m_shader(shader)
        , m_eye(eye)
        , m_contrast(settings.contrast)
        , m_side(1 << settings.subdivisions) {}

    PixelValue shade(int x, int y, TileCorners* corners, RayTree* tree) {
        m_x = x;
        m_y = y;
        m_corners = corners;
        m_tree = tree;
        m_points.clear();
        m_found.fill(kUnseen);
        square(0, 0, m_side);
        // Each corner has a quarter of each square that it belongs to: a number of few bits, so
        // that shares are exact and add up to 1.
        PixelValue value;
        glm::dvec3 radiance(0.0);
        double alpha = 0.0;
        for (const Point& point : m_points) {
            const double share = 0.25 * point.squares / (static_cast<double>(m_side) * m_side);
            radiance += share * glm::dvec3(point.sample.radiance);
            alpha += share * static_cast<double>(point.sample.alpha);
            value.counts.add(point.sample.counts);
            if (tree != nullptr)
                tree->at(point.node).share = share;
        }
        value.radiance = glm::vec3(radiance);
        value.alpha = static_cast<float>(alpha);
        return value;
    }

  private:
    static constexpr int kMostSide = 1 << kMostSubdivisions;
    static constexpr int kUnseen = -1;
    struct Point {
        WhittedShader::Sample sample;
        int squares = 0; // of the smallest size
        int node = RayNode::kNone;
    };

    // Columns and rows count in parts of the pixel.
    std::size_t point(int column, int row) {
        int& found = m_found[static_cast<std::size_t>(row) * (kMostSide + 1) +
                             static_cast<std::size_t>(column)];
        if (found == kUnseen) {
            found = static_cast<int>(m_points.size());
            Point point;
            if (m_tree != nullptr)
                point.node = static_cast<int>(m_tree->nodes().size());
            const bool shared = m_corners != nullptr && column % m_side == 0 && row % m_side == 0;
            TileCorners::Corner* corner =
                shared ? &m_corners->at(m_x + column / m_side, m_y + row / m_side) : nullptr;
            if (corner != nullptr && corner->traced) {
                point.sample = corner->sample;
            } else {
                const glm::vec2 at = glm::vec2(column, row) / static_cast<float>(m_side);
                point.sample =
                    m_shader.look(m_eye.origin(), m_eye.direction(m_x, m_y, at), 0, 0, m_tree);
                if (m_tree != nullptr)
                    m_tree->at(point.node).at = at;
                if (corner != nullptr)
                    *corner = {true, point.sample};
            }
            m_points.push_back(point);
        }
        return static_cast<std::size_t>(found);
    }

    // Corners that are alike by chance say nothing of what lies between: to stop at those would
    // favour what is more likely.
    [[nodiscard]] bool isEven(const std::array<std::size_t, 4>& corners) const {
        if (std::ranges::any_of(corners,
                                [&](std::size_t i) { return m_points[i].sample.byChance; }))
            return false;
        for (int c = 0; c < 4; ++c) {
            const auto channel = [&](std::size_t i) {
                const WhittedShader::Sample& sample = m_points[i].sample;
                return c < 3 ? sample.radiance[c] : sample.alpha;
            };
            float least = channel(corners[0]), most = least;
            for (const std::size_t i : corners) {
                least = std::min(least, channel(i));
                most = std::max(most, channel(i));
            }
            if (contrastOf(least, most) > m_contrast)
                return false;
        }
        return true;
    }

    void square(int column, int row, int side) {
        const std::array<std::size_t, 4> corners{point(column, row), point(column + side, row),
                                                 point(column, row + side),
                                                 point(column + side, row + side)};
        if (side == 1 || isEven(corners)) {
            for (const std::size_t i : corners)
                m_points[i].squares += side * side;
            return;
        }
        const int half = side / 2;
        for (const int down : {0, half})
            for (const int right : {0, half})
                square(column + right, row + down, half);
    }

    WhittedShader& m_shader;
    const Eye& m_eye;
    float m_contrast;
    int m_side; // of the pixel, in smallest squares
    int m_x = 0, m_y = 0;
    TileCorners* m_corners = nullptr;
    RayTree* m_tree = nullptr;
    std::vector<Point> m_points; // in the order in which they were traced
    std::array<int, std::size_t{kMostSide + 1} * (kMostSide + 1)> m_found{};
};

WhittedShader::Sample stochasticSample(WhittedShader& shader, const Eye& eye, const TraceView& view,
                                       const WhittedSettings& settings, int x, int y,
                                       std::uint32_t index, RayTree* tree) {
    const std::uint32_t seed =
        seedFor(settings.seed, static_cast<std::uint32_t>(y * view.width + x));
    const glm::vec2 at = sobolOwen2D(index, seedFor(seed, kPixelPosition));
    const int node = tree != nullptr ? static_cast<int>(tree->nodes().size()) : RayNode::kNone;
    const Eye::Ray ray = settings.depthOfField && eye.hasLens()
                             ? eye.throughLens(x, y, at, sobolOwen2D(index, seedFor(seed, kOnLens)))
                             : Eye::Ray{eye.origin(), eye.direction(x, y, at)};
    const WhittedShader::Sample sample =
        shader.look(ray.origin, ray.direction, index, seedFor(seed, kFirstRay), tree);
    if (tree != nullptr)
        tree->at(node).at = at;
    return sample;
}

} // namespace

Result<void> traceWhitted(const TraceScene& scene, const TraceView& view,
                          const WhittedSettings& settings, Film& film, std::uint32_t first,
                          std::uint32_t count, const JobContext& job, TraceRays* rays,
                          const TraceTiles& tiles, RayCountMap* counts,
                          const TeachingHierarchy* hierarchy) {
    CHECK(film.width() == view.width && film.height() == view.height);
    CHECK(settings.subdivisions >= 0 && settings.subdivisions <= kMostSubdivisions);
    CHECK(settings.maxDepth >= 0 && settings.maxDepth <= kMostWhittedDepth);
    const std::uint32_t last = settings.isStochastic() ? first + count : 1;
    const int columns = (view.width + kWhittedTile - 1) / kWhittedTile,
              rows = (view.height + kWhittedTile - 1) / kWhittedTile;
    const Eye eye(scene, view);
    const WhittedLights lights(scene);
    const auto traceTile = [&](int tile) {
        WhittedShader shader(scene, lights, view, settings, hierarchy);
        AdaptivePixel adaptive(shader, eye, settings);
        const int x0 = tile % columns * kWhittedTile, y0 = tile / columns * kWhittedTile;
        TileCorners corners(x0, y0);
        for (int y = y0; y < std::min(y0 + kWhittedTile, view.height) && !job.stopping(); ++y)
            for (int x = x0; x < std::min(x0 + kWhittedTile, view.width); ++x) {
                Film::Pixel sum = film.at(x, y);
                RayCounts took;
                for (std::uint32_t i = std::max(first, sum.samples); i < last; ++i) {
                    if (settings.isStochastic()) {
                        const WhittedShader::Sample sample =
                            stochasticSample(shader, eye, view, settings, x, y, i, nullptr);
                        sum.add(sample.radiance, sample.alpha);
                        took.add(sample.counts);
                    } else {
                        const PixelValue value = adaptive.shade(x, y, &corners, nullptr);
                        sum.add(value.radiance, value.alpha);
                        took.add(value.counts);
                    }
                }
                const auto held = tiles.film != nullptr ? std::unique_lock(*tiles.film)
                                                        : std::unique_lock<std::mutex>();
                film.at(x, y) = sum;
                if (counts != nullptr)
                    counts->pixels()[static_cast<std::size_t>(y * view.width + x)].add(took);
            }
        job.addWork(static_cast<double>(shader.rays()), "rays");
        if (rays != nullptr)
            rays->count += shader.rays();
        if (tiles.tileDone)
            tiles.tileDone();
    };
    parallelFor(job, static_cast<std::size_t>(columns * rows), 1,
                [&](std::size_t begin, std::size_t end) {
                    const FlushDenormals flush;
                    for (std::size_t tile = begin; tile < end; ++tile)
                        if (tiles.shard.holds(tile))
                            traceTile(static_cast<int>(tile));
                });
    if (job.cancelled())
        return Error{ErrorKind::Cancelled, "cancelled", {}, {}};
    return {};
}

RayTree traceRayTree(const TraceScene& scene, const TraceView& view,
                     const WhittedSettings& settings, int x, int y, std::uint32_t samples) {
    CHECK(x >= 0 && y >= 0 && x < view.width && y < view.height);
    const FlushDenormals flush;
    const Eye eye(scene, view);
    const WhittedLights lights(scene);
    WhittedShader shader(scene, lights, view, settings);
    RayTree tree;
    if (!settings.isStochastic()) {
        AdaptivePixel(shader, eye, settings).shade(x, y, nullptr, &tree);
        return tree;
    }
    tree.setMean(samples);
    for (std::uint32_t i = 0; i < samples; ++i)
        stochasticSample(shader, eye, view, settings, x, y, i, &tree);
    return tree;
}

} // namespace patina
