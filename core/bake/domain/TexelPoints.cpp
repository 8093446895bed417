#include "core/bake/domain/BakePoints.h"
#include "core/mesh/UvRaster.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <vector>

namespace patina {
namespace {

constexpr double kMaxTiles = 8.0;       // triangles that repeat the texture more often are skipped
constexpr double kTexelRadius = 0.7072; // centre to corner
constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

using Triangle2 = std::array<glm::dvec2, 3>;

double cross(const glm::dvec2& a, const glm::dvec2& b) {
    return a.x * b.y - a.y * b.x;
}

// Barycentric coordinates 1 and 2 of the point of the triangle closest to p (Ericson 2005,
// "Real-Time Collision Detection", 5.1.5, by edges).
glm::dvec2 closestPoint(const Triangle2& t, const glm::dvec2& p, double& distance) {
    const double area = cross(t[1] - t[0], t[2] - t[0]);
    if (area != 0.0) {
        const double b1 = cross(p - t[0], t[2] - t[0]) / area;
        const double b2 = cross(t[1] - t[0], p - t[0]) / area;
        if (b1 >= 0.0 && b2 >= 0.0 && b1 + b2 <= 1.0) {
            distance = 0.0;
            return {b1, b2};
        }
    }
    distance = std::numeric_limits<double>::max();
    glm::dvec2 best(0.0);
    for (std::size_t edge = 0; edge < 3; ++edge) {
        const glm::dvec2 a = t[edge], along = t[(edge + 1) % 3] - a;
        const double length2 = glm::dot(along, along);
        const double s =
            length2 > 0.0 ? std::clamp(glm::dot(p - a, along) / length2, 0.0, 1.0) : 0.0;
        const double d = glm::distance(a + s * along, p);
        if (d >= distance)
            continue;
        distance = d;
        double b[3] = {0.0, 0.0, 0.0};
        b[edge] = 1.0 - s;
        b[(edge + 1) % 3] += s;
        best = {b[1], b[2]};
    }
    return best;
}

// Calls visit(x, y) for the texels within a texel of the triangle's border; some come repeatedly.
template <class Visit>
void forEachBorderTexel(const Triangle2& t, Visit&& visit) {
    for (std::size_t edge = 0; edge < 3; ++edge) {
        const glm::dvec2 a = t[edge], b = t[(edge + 1) % 3];
        const bool steep = std::abs(b.y - a.y) > std::abs(b.x - a.x);
        const int major = steep ? 1 : 0, minor = 1 - major;
        const double low = std::min(a[major], b[major]), high = std::max(a[major], b[major]);
        for (double i = std::floor(low) - 1.0; i <= std::floor(high) + 1.0; ++i) {
            const double s =
                high > low ? std::clamp((i + 0.5 - a[major]) / (b[major] - a[major]), 0.0, 1.0)
                           : 0.0;
            const double middle = std::floor(a[minor] + s * (b[minor] - a[minor]));
            for (double j = middle - 1.0; j <= middle + 1.0; ++j)
                visit(static_cast<std::int64_t>(steep ? j : i),
                      static_cast<std::int64_t>(steep ? i : j));
        }
    }
}

// What is known about every texel while triangles are drawn.
class TexelCollector {
  public:
    TexelCollector(const BakeGeometry& geometry, int size)
        : m_geometry(geometry)
        , m_size(size)
        , m_first(static_cast<std::size_t>(size) * static_cast<std::size_t>(size), {kNone})
        , m_distance(m_first.size(), std::numeric_limits<float>::max()) {}

    void draw(std::uint32_t mesh, std::uint32_t triangle, const Triangle2& t) {
        forEachCoveredTexel(t, [&](std::int64_t x, std::int64_t y) {
            double distance = 0.0;
            const glm::dvec2 b = closestPoint(t, centre(x, y), distance);
            const std::size_t texel = wrapped(x, y);
            if (m_distance[texel] == 0.0f) { // covered before
                m_others.push_back({static_cast<std::uint32_t>(texel), point(mesh, triangle, b)});
                return;
            }
            m_distance[texel] = 0.0f;
            m_first[texel] = point(mesh, triangle, b);
        });
        forEachBorderTexel(t, [&](std::int64_t x, std::int64_t y) {
            const std::size_t texel = wrapped(x, y);
            if (m_distance[texel] == 0.0f)
                return;
            double distance = 0.0;
            const glm::dvec2 b = closestPoint(t, centre(x, y), distance);
            // A centre on the very border belongs to one of the triangles there by rule; here it
            // only counts as near.
            distance = std::max(distance, 1e-6);
            if (distance > kTexelRadius || static_cast<float>(distance) >= m_distance[texel])
                return;
            m_distance[texel] = static_cast<float>(distance);
            m_first[texel] = point(mesh, triangle, b);
        });
    }

    void finish(TexelPoints& result, std::vector<SurfacePlace>* places) {
        m_places = places;
        std::stable_sort(m_others.begin(), m_others.end(),
                         [](const Other& a, const Other& b) { return a.texel < b.texel; });
        std::size_t other = 0;
        for (std::size_t texel = 0; texel < m_first.size(); ++texel) {
            if (m_first[texel].mesh == kNone)
                continue;
            result.texels.push_back(static_cast<std::uint32_t>(texel));
            result.firstPoint.push_back(static_cast<std::uint32_t>(result.points.size()));
            add(result, m_first[texel]);
            int count = 1;
            for (; other < m_others.size() && m_others[other].texel == texel; ++other)
                if (count++ < kMaxPointsPerTexel)
                    add(result, m_others[other].point);
            result.sharedTexels += count > 1 ? 1 : 0;
        }
        result.firstPoint.push_back(static_cast<std::uint32_t>(result.points.size()));
    }

  private:
    struct Other {
        std::uint32_t texel;
        SurfacePlace point;
    };

    static glm::dvec2 centre(std::int64_t x, std::int64_t y) {
        return {static_cast<double>(x) + 0.5, static_cast<double>(y) + 0.5};
    }
    [[nodiscard]] std::size_t wrapped(std::int64_t x, std::int64_t y) const {
        const auto wrap = [this](std::int64_t i) {
            return static_cast<std::size_t>((i % m_size + m_size) % m_size);
        };
        return wrap(y) * static_cast<std::size_t>(m_size) + wrap(x);
    }
    static SurfacePlace point(std::uint32_t mesh, std::uint32_t triangle, const glm::dvec2& b) {
        return {mesh, triangle, static_cast<float>(b.x), static_cast<float>(b.y)};
    }
    void add(TexelPoints& result, const SurfacePlace& at) const {
        if (m_places != nullptr)
            m_places->push_back(at);
        result.points.push_back(
            surfacePoint(m_geometry.meshes[at.mesh], at.triangle, at.b1, at.b2));
    }

    const BakeGeometry& m_geometry;
    std::int64_t m_size;
    std::vector<SurfacePlace> m_first;
    std::vector<float> m_distance; // of the texel's centre to the triangle of m_first
    std::vector<Other> m_others;   // further triangles over the centre
    std::vector<SurfacePlace>* m_places = nullptr;
};

} // namespace

TexelPoints texelPoints(const BakeGeometry& geometry, Id material, int size, const JobContext& job,
                        std::vector<SurfacePlace>* places) {
    TexelPoints result;
    TexelCollector collector(geometry, size);
    for (std::uint32_t m = 0; m < geometry.meshes.size(); ++m) {
        const BakeGeometryMesh& mesh = geometry.meshes[m];
        if (mesh.material != material || mesh.mesh->uvs.size() != mesh.mesh->positions.size())
            continue; // without texture coordinates it has no texels
        for (std::uint32_t t = 0; t < mesh.mesh->triangleCount(); ++t) {
            if (t % 4096 == 0 && job.cancelled())
                return result;
            Triangle2 triangle;
            for (std::size_t corner = 0; corner < 3; ++corner)
                triangle[corner] =
                    glm::dvec2(mesh.mesh->uvs[mesh.mesh->indices[std::size_t{3} * t + corner]]) *
                    static_cast<double>(size);
            const glm::dvec2 extent = glm::max(glm::max(triangle[0], triangle[1]), triangle[2]) -
                                      glm::min(glm::min(triangle[0], triangle[1]), triangle[2]);
            if (!(std::max(extent.x, extent.y) <= kMaxTiles * size)) { // NaN too
                ++result.skippedTriangles;
                continue;
            }
            collector.draw(m, t, triangle);
        }
    }
    collector.finish(result, places);
    return result;
}

} // namespace patina
