#include "core/bake/transfer/InsideGeometry.h"

#include "core/bake/domain/HemisphereSamples.h"
#include "core/base/Check.h"
#include "core/job/Parallel.h"

#include <algorithm>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <limits>

namespace patina {
namespace {

constexpr float kMostVisible = 1.0f / 64.0f; // rays may slip through between two triangles
constexpr std::uint32_t kPairs = 16;         // of rays, to opposite sides
constexpr int kFewestVotes = 30;             // of twice as many
constexpr int kMostHits = 64;                // of one ray
constexpr std::size_t kPairsAtATime = 2;
// How deep something has to stand in something else, in scene units: the 5,000th part of the
// scene.
constexpr float kLeastDepth = 40.0f * kRayOffset;

// The side that a ray of `direction` comes to.
bool meetsBack(const BakeGeometryMesh& mesh, const ClosestRay& hit) {
    const std::uint32_t* corner = mesh.mesh->indices.data() + 3 * std::size_t{hit.triangle};
    const glm::vec3 normal = (1.0f - hit.u - hit.v) * mesh.normals[corner[0]] +
                             hit.u * mesh.normals[corner[1]] + hit.v * mesh.normals[corner[2]];
    return glm::dot(normal, hit.ray.direction) > 0.0f;
}

// A number for a mesh.
struct OfMesh {
    std::uint32_t mesh = 0;
    int number = 0;
};

int& numberOf(std::vector<OfMesh>& numbers, std::uint32_t mesh) {
    const auto found = std::ranges::find(numbers, mesh, &OfMesh::mesh);
    return found != numbers.end() ? found->number : numbers.emplace_back(OfMesh{mesh, 0}).number;
}

class InsideTest {
  public:
    InsideTest(const BakeGeometry& geometry, const RayScene& scene,
               const HemisphereSamples& samples)
        : m_geometry(geometry)
        , m_scene(scene)
        , m_samples(samples) {}

    bool isInside(const BakePoint& point, std::uint32_t number, std::uint32_t ownMesh) {
        // Of the others, from within its own surface; of itself, from before it.
        return isEnclosed(point.origin - kLeastDepth * point.normal, point.normal, number, ownMesh,
                          false) ||
               isEnclosed(point.origin, point.normal, number, ownMesh, true);
    }

  private:
    bool isEnclosed(const glm::vec3& origin, const glm::vec3& normal, std::uint32_t number,
                    std::uint32_t ownMesh, bool byItself) {
        const std::uint32_t seed = seedFor(0, number);
        const glm::mat3 frame = HemisphereSamples::frame(normal, seed);
        const std::span<const glm::vec3> directions = m_samples.directions(seed, m_scratch);
        const auto all = static_cast<int>(2 * directions.size());
        m_windings.resize(2 * directions.size());
        for (std::vector<OfMesh>& ofRay : m_windings)
            ofRay.clear(); // keeps its memory
        // A few rays at a time: nearly all vertices lie outside, which those tell.
        int leaving = 0, traced = 0;
        for (std::size_t first = 0; first < directions.size(); first += kPairsAtATime) {
            const std::size_t count = std::min(kPairsAtATime, directions.size() - first);
            trace(origin, frame, directions.subspan(first, count), first, ownMesh, byItself);
            for (std::size_t r = 2 * first; r < 2 * (first + count); ++r, ++traced)
                leaving += std::ranges::any_of(m_windings[r],
                                               [](const OfMesh& w) { return w.number > 0; });
            if (leaving + all - traced < kFewestVotes)
                return false;
        }
        m_votes.clear();
        for (const std::vector<OfMesh>& ofRay : m_windings)
            for (const OfMesh& winding : ofRay)
                if (winding.number > 0)
                    ++numberOf(m_votes, winding.mesh);
        return std::ranges::any_of(
            m_votes, [](const OfMesh& votes) { return votes.number >= kFewestVotes; });
    }

    // On its way out of a closed mesh a ray meets one back more than fronts: into m_windings, of
    // two rays for each of `directions`, which begin with number `first`.
    void trace(const glm::vec3& origin, const glm::mat3& frame,
               std::span<const glm::vec3> directions, std::size_t first, std::uint32_t ownMesh,
               bool byItself) {
        m_rays.clear();
        for (const glm::vec3& local : directions)
            for (const float side : {1.0f, -1.0f}) {
                ClosestRay& closest = m_rays.emplace_back();
                closest.ray.id = static_cast<unsigned>(2 * first + m_rays.size() - 1);
                closest.ray.origin = origin;
                closest.ray.direction = side * (frame * local);
            }
        for (int hits = 0; hits < kMostHits && !m_rays.empty(); ++hits) {
            // Points and normals are finite and unit by construction.
            CHECK_EQ(m_scene.intersect(m_rays), std::size_t{0});
            std::erase_if(m_rays, [](const ClosestRay& closest) {
                return closest.mesh == ClosestRay::kNothing;
            });
            for (ClosestRay& closest : m_rays) {
                const BakeGeometryMesh& mesh = m_geometry.meshes[closest.mesh];
                if ((closest.mesh == ownMesh) == byItself && !mesh.doubleSided)
                    numberOf(m_windings[closest.ray.id], closest.mesh) +=
                        meetsBack(mesh, closest) ? 1 : -1;
                closest.ray.minDistance = closest.ray.maxDistance * 1.000001f + 0.1f * kRayOffset;
                closest.ray.maxDistance = std::numeric_limits<float>::infinity();
            }
        }
    }

    const BakeGeometry& m_geometry;
    const RayScene& m_scene;
    const HemisphereSamples& m_samples;
    std::vector<ClosestRay> m_rays;
    std::vector<std::vector<OfMesh>> m_windings; // by ray
    std::vector<OfMesh> m_votes;
    std::vector<glm::vec3> m_scratch;
};

} // namespace

std::vector<std::size_t> countVerticesInside(const BakeGeometry& geometry, const RayScene& scene,
                                             std::span<const BakePoint> points,
                                             std::span<const float> visibility,
                                             const JobContext& job) {
    CHECK_EQ(points.size(), visibility.size());
    constexpr std::size_t kGrain = 256;
    std::vector<std::size_t> inside;
    const HemisphereSamples samples(0, 0, kPairs);
    std::size_t first = 0;
    for (std::uint32_t m = 0; m < geometry.meshes.size(); ++m) {
        const std::size_t count = geometry.meshes[m].positions.size();
        std::vector<std::uint8_t> isInside(count, 0);
        parallelFor(job, count, kGrain, [&](std::size_t begin, std::size_t end) {
            const FlushDenormals flush;
            InsideTest test(geometry, scene, samples);
            for (std::size_t v = begin; v < end; ++v)
                if (visibility[first + v] <= kMostVisible)
                    isInside[v] =
                        test.isInside(points[first + v], static_cast<std::uint32_t>(v), m) ? 1 : 0;
        });
        inside.push_back(static_cast<std::size_t>(std::ranges::count(isInside, 1)));
        first += count;
    }
    return inside;
}

std::vector<std::uint8_t> verticesInside(const BakeGeometry& geometry, const RayScene& scene,
                                         std::uint32_t mesh, std::span<const BakePoint> points,
                                         std::span<const std::uint32_t> which,
                                         const JobContext& job) {
    constexpr std::size_t kGrain = 64;
    static const HemisphereSamples samples(0, 0, kPairs); // asked for each of thousands of meshes
    std::vector<std::uint8_t> inside(which.size(), 0);
    const auto testRange = [&](std::size_t begin, std::size_t end) {
        const FlushDenormals flush;
        InsideTest test(geometry, scene, samples);
        for (std::size_t i = begin; i < end; ++i)
            inside[i] = test.isInside(points[which[i]], which[i], mesh) ? 1 : 0;
    };
    if (which.size() <= kGrain) // too few to divide
        testRange(0, which.size());
    else
        parallelFor(job, which.size(), kGrain, testRange);
    return inside;
}

std::string insideNote(const BakeGeometry& geometry, std::span<const std::size_t> inside) {
    constexpr std::size_t kMostMeshes = 8;
    std::string note;
    std::size_t named = 0, unnamed = 0;
    for (std::size_t m = 0; m < inside.size(); ++m) {
        if (inside[m] == 0)
            continue;
        if (named == kMostMeshes) {
            ++unnamed;
            continue;
        }
        ++named;
        const BakeGeometryMesh& mesh = geometry.meshes[m];
        const std::string name =
            mesh.name.empty() ? fmt::format("mesh {}", mesh.id) : "“" + mesh.name + "”";
        note += fmt::format("{}{} of the {} vertices of {}", note.empty() ? "" : ", ", inside[m],
                            mesh.positions.size(), name);
    }
    if (unnamed > 0)
        note += fmt::format(" and some of {} more meshes", unnamed);
    if (!note.empty())
        note += " lie inside geometry, where no light arrives: move them out of it, or delete "
                "what nobody sees.";
    return note;
}

} // namespace patina
