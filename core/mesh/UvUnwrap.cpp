#include "core/mesh/UvUnwrap.h"

#include "core/base/Check.h"
#include "core/mesh/BorderSweep.h"
#include "core/mesh/BoxProjection.h"
#include "core/mesh/RectanglePacking.h"
#include "core/mesh/SplitVertices.h"
#include "core/mesh/UvCharts.h"
#include "core/mesh/UvRaster.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/trigonometric.hpp>
#include <limits>
#include <utility>

namespace patina {
namespace {

struct Box2 {
    glm::dvec2 min{std::numeric_limits<double>::max()};
    glm::dvec2 max{std::numeric_limits<double>::lowest()};
    void add(const glm::dvec2& p) {
        min = glm::min(min, p);
        max = glm::max(max, p);
    }
    [[nodiscard]] glm::dvec2 size() const { return glm::max(max - min, glm::dvec2(0.0)); }
};

// Positions moved and scaled to a box of size 1, so that every scale of mesh is treated alike.
struct NormalizedPoints {
    std::vector<glm::dvec3> points;
    double side = 1.0; // of the box, in the mesh's units
};
NormalizedPoints normalizedPoints(const Mesh& mesh) {
    const Bounds bounds = mesh.bounds();
    const glm::dvec3 low(bounds.min), extent = glm::dvec3(bounds.max) - low;
    NormalizedPoints result;
    result.side = std::max({extent.x, extent.y, extent.z});
    result.points.resize(mesh.vertexCount());
    for (std::size_t i = 0; i < result.points.size(); ++i)
        result.points[i] = (glm::dvec3(mesh.positions[i]) - low) / result.side;
    return result;
}

// Turns each chart so that its box is smallest and lies on its longer side.
void turnCharts(const Mesh& mesh, std::vector<glm::dvec2>& local,
                const std::vector<std::uint32_t>& chartOfVertex, std::vector<Box2>& boxes) {
    constexpr int kAngles = 16; // over 90 degrees
    std::vector<double> bestArea(boxes.size(), std::numeric_limits<double>::max());
    std::vector<int> bestAngle(boxes.size(), 0);
    const auto turned = [](const glm::dvec2& p, double angle) {
        return glm::dvec2(p.x * std::cos(angle) - p.y * std::sin(angle),
                          p.x * std::sin(angle) + p.y * std::cos(angle));
    };
    const auto radians = [](int step) { return glm::radians(90.0) * step / kAngles; };
    std::vector<Box2> trial(boxes.size());
    for (int step = 0; step < kAngles; ++step) {
        std::fill(trial.begin(), trial.end(), Box2{});
        const double cosine = std::cos(radians(step)), sine = std::sin(radians(step));
        for (const std::uint32_t i : mesh.indices)
            trial[chartOfVertex[i]].add(
                {local[i].x * cosine - local[i].y * sine, local[i].x * sine + local[i].y * cosine});
        for (std::size_t c = 0; c < boxes.size(); ++c) {
            const glm::dvec2 size = trial[c].size();
            // Upright charts win ties and near ties.
            const double area = size.x * size.y * (step == 0 ? 0.95 : 1.0);
            if (area < bestArea[c]) {
                bestArea[c] = area;
                bestAngle[c] = size.y > size.x ? step - kAngles : step;
            }
        }
    }
    for (std::size_t i = 0; i < local.size(); ++i)
        local[i] = turned(local[i], radians(bestAngle[chartOfVertex[i]]));
    for (const std::uint32_t i : mesh.indices) // a vertex without triangles must not stretch a box
        boxes[chartOfVertex[i]].add(local[i]);
}

// A mesh cut into charts that lie flat, each in coordinates of its own.
struct FlatCharts {
    std::vector<glm::dvec2> local; // of each vertex
    std::vector<std::uint32_t> chartOfVertex;
    std::vector<Box2> boxes; // of each chart
    double side = 1.0;       // in the mesh's units, of 1 in `local`
};

// Splits vertices on the charts' borders.
FlatCharts flatten(Mesh& mesh, const UnwrapSettings& settings, std::vector<std::uint32_t>* origin) {
    UvChartSettings chartSettings;
    chartSettings.maxDeviationDeg = settings.maxNormalDeviationDeg;
    // A hundredth of a texel, if the mesh's box had the image's size: overlap that no texel sees.
    chartSettings.overlapTolerance = 0.01 / settings.resolution;
    const UvCharts charts = cutUvCharts(mesh, normalizedPoints(mesh).points, chartSettings);
    FlatCharts flat;
    flat.chartOfVertex = splitVertices(mesh, charts.chartOfTriangle, origin);

    // Project along the charts' axes.
    const NormalizedPoints normalized = normalizedPoints(mesh);
    flat.side = normalized.side;
    std::vector<ChartFrame> frames(charts.axes.size());
    std::transform(charts.axes.begin(), charts.axes.end(), frames.begin(), chartFrame);
    flat.local.resize(normalized.points.size());
    for (std::size_t i = 0; i < flat.local.size(); ++i) {
        const ChartFrame& frame = frames[flat.chartOfVertex[i]];
        flat.local[i] = {glm::dot(normalized.points[i], frame.x),
                         glm::dot(normalized.points[i], frame.y)};
    }
    flat.boxes.resize(charts.axes.size());
    turnCharts(mesh, flat.local, flat.chartOfVertex, flat.boxes);
    return flat;
}

} // namespace

void unwrapUvs(Mesh& mesh, const UnwrapSettings& settings, std::vector<std::uint32_t>* origin) {
    if (mesh.triangleCount() > kMaxChartedTriangles) {
        boxProjectUvs(mesh, origin);
        return;
    }
    std::vector<std::uint32_t> unused(origin != nullptr ? 0 : mesh.vertexCount());
    unwrapUvsTogether({&mesh, 1}, settings, {origin != nullptr ? origin : &unused, 1});
}

int unwrapUvsTogether(std::span<Mesh> meshes, const UnwrapSettings& settings,
                      std::span<std::vector<std::uint32_t>> origins) {
    CHECK_LT(0, settings.resolution);
    CHECK_EQ(meshes.size(), origins.size());
    std::vector<FlatCharts> flat(meshes.size());
    double unit = 0.0; // of the packing, in the meshes' units
    std::size_t triangles = 0;
    for (std::size_t m = 0; m < meshes.size(); ++m) {
        meshes[m].uvs.assign(meshes[m].positions.size(), glm::vec2(0.0f));
        triangles += meshes[m].triangleCount();
        CHECK_LE(triangles, kMaxChartedTriangles);
        if (meshes[m].indices.empty())
            continue;
        flat[m] = flatten(meshes[m], settings, &origins[m]);
        unit = std::max(unit, flat[m].side);
    }

    std::vector<glm::dvec2> sizes;
    for (const FlatCharts& of : flat)
        for (const Box2& box : of.boxes)
            sizes.push_back(box.size() * (of.side / unit));
    if (sizes.empty())
        return settings.resolution;
    const int margin = static_cast<int>(std::ceil(std::max(settings.marginTexels, 0.0f)));
    const RectanglePacking packing = packRectangles(sizes, settings.resolution, margin);

    // UVs: v grows downwards, so the image shows each chart as seen from outside.
    std::size_t firstChart = 0;
    for (std::size_t m = 0; m < meshes.size(); ++m) {
        const FlatCharts& of = flat[m];
        if (of.boxes.empty())
            continue;
        const double scale = packing.scale * (of.side / unit);
        meshes[m].uvs.resize(of.local.size());
        for (std::size_t i = 0; i < of.local.size(); ++i) {
            const std::uint32_t chart = of.chartOfVertex[i];
            const Box2& box = of.boxes[chart];
            const glm::dvec2 inBox(of.local[i].x - box.min.x, box.max.y - of.local[i].y);
            const glm::dvec2 texel = glm::dvec2(packing.positions[firstChart + chart]) +
                                     static_cast<double>(margin) + inBox * scale;
            meshes[m].uvs[i] =
                glm::vec2(glm::clamp(texel / static_cast<double>(packing.side), 0.0, 1.0));
        }
        firstChart += of.boxes.size();
    }
    return packing.side;
}

namespace {

// Whether the triangles of a small mesh surely lie beside each other within the unit square.
bool uvsSurelyLieApart(const Mesh& mesh) {
    constexpr std::size_t kSmall = 2000; // of others an image of them costs less
    if (mesh.triangleCount() > kSmall || std::ranges::any_of(mesh.uvs, [](const glm::vec2& uv) {
            return !(uv.x >= 0.0f && uv.x <= 1.0f && uv.y >= 0.0f && uv.y <= 1.0f);
        }))
        return false;
    // Sides with the triangle on their left; whichever way round it runs.
    const auto precedes = [](const BorderSegment& s, const BorderSegment& t) {
        return std::array{s[0].x, s[0].y, s[1].x, s[1].y} <
               std::array{t[0].x, t[0].y, t[1].x, t[1].y};
    };
    std::vector<BorderSegment> sides;
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
        std::array<glm::dvec2, 3> corner;
        for (std::size_t k = 0; k < 3; ++k)
            corner[k] = glm::dvec2(mesh.uvs[mesh.indices[i + k]]);
        const glm::dvec2 u = corner[1] - corner[0], v = corner[2] - corner[0];
        if (u.x * v.y - u.y * v.x < 0.0)
            std::swap(corner[1], corner[2]);
        for (std::size_t k = 0; k < 3; ++k)
            sides.push_back({corner[k], corner[(k + 1) % 3]});
    }
    std::sort(sides.begin(), sides.end(), precedes);
    std::vector<BorderSegment> border;
    for (std::size_t begin = 0, end = 0; begin < sides.size(); begin = end) {
        const BorderSegment& side = sides[begin];
        while (end < sides.size() && sides[end] == side)
            ++end;
        const auto [first, last] =
            std::equal_range(sides.begin(), sides.end(), BorderSegment{side[1], side[0]}, precedes);
        if (const auto against = static_cast<std::size_t>(last - first); end - begin > against)
            border.insert(border.end(), end - begin - against, side);
    }
    return windsAtMostOnce(border);
}

} // namespace

bool hasOverlappingUvs(const Mesh& mesh, int resolution) {
    CHECK_LT(0, resolution);
    CHECK_EQ(mesh.uvs.size(), mesh.positions.size());
    if (uvsSurelyLieApart(mesh))
        return false;
    // Shared borders of charts whose numbers differ by rounding do not count.
    constexpr double kBorderTexels = 0.05;
    constexpr double kMaxTiles = 16.0; // a triangle that spans more repeats the image
    constexpr std::uint32_t kFree = std::numeric_limits<std::uint32_t>::max();

    const auto triangleAt = [&](std::size_t t) {
        std::array<glm::dvec2, 3> triangle;
        for (std::size_t corner = 0; corner < 3; ++corner)
            triangle[corner] =
                glm::dvec2(mesh.uvs[mesh.indices[3 * t + corner]]) * double(resolution);
        return triangle;
    };
    struct Cover {
        std::uint32_t triangle;
        bool inside; // by more than the border
    };
    const auto side = static_cast<std::size_t>(resolution);
    std::vector<Cover> covers(side * side, {kFree, false});
    for (std::size_t t = 0; t < mesh.triangleCount(); ++t) {
        const std::array<glm::dvec2, 3> triangle = triangleAt(t);
        const glm::dvec2 size = glm::max(glm::max(triangle[0], triangle[1]), triangle[2]) -
                                glm::min(glm::min(triangle[0], triangle[1]), triangle[2]);
        if (std::max(size.x, size.y) > kMaxTiles * resolution)
            return true;
        bool overlaps = false;
        forEachCoveredTexel(triangle, [&](std::int64_t x, std::int64_t y) {
            const auto wrap = [&](std::int64_t i) {
                return static_cast<std::size_t>((i % resolution + resolution) % resolution);
            };
            Cover& cover = covers[wrap(y) * side + wrap(x)];
            const glm::dvec2 centre(static_cast<double>(x) + 0.5, static_cast<double>(y) + 0.5);
            const bool inside = insideDistance(triangle, centre) > kBorderTexels;
            if (cover.triangle != kFree && cover.inside && inside)
                overlaps = true;
            if (cover.triangle == kFree || inside)
                cover = {static_cast<std::uint32_t>(t), inside || cover.inside};
        });
        if (overlaps)
            return true;
    }
    return false;
}

} // namespace patina
