#include "core/bake/transfer/InsideShares.h"

#include "core/bake/transfer/InsideGeometry.h"

#include <algorithm>

namespace patina {
namespace {

// Calls visit(v, w) for both directions of each edge of each triangle.
template <class Visit>
void forEachEdge(const Mesh& mesh, Visit visit) {
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3)
        for (std::size_t a = 0; a < 3; ++a)
            for (std::size_t b = 0; b < 3; ++b)
                if (a != b)
                    visit(mesh.indices[i + a], mesh.indices[i + b]);
}

} // namespace

InsideShares::InsideShares(const BakeScene& scene, std::uint32_t mesh,
                           std::span<const BakePoint> points)
    : m_scene(scene)
    , m_mesh(mesh)
    , m_points(points)
    , m_known(points.size(), kUnknown) {}

// Only those that are asked for are traced: some rays for each vertex would cost more than the
// shadows of most lights.
void InsideShares::ask(const std::vector<std::uint32_t>& vertices, const JobContext& job) const {
    std::vector<std::uint32_t> unknown;
    std::ranges::copy_if(vertices, std::back_inserter(unknown),
                         [&](std::uint32_t v) { return m_known[v] == kUnknown; });
    const std::vector<std::uint8_t> inside =
        verticesInside(*m_scene.geometry, m_scene.rays, m_mesh, m_points, unknown, job);
    if (job.cancelled())
        return;
    for (std::size_t i = 0; i < unknown.size(); ++i)
        m_known[unknown[i]] = inside[i] != 0 ? kInside : kOutside;
}

void InsideShares::mend(std::span<float> shares, const JobContext& job) const {
    const Mesh& mesh = *m_scene.geometry->meshes[m_mesh].mesh;
    const std::scoped_lock lock(m_mutex);
    // Dark ones beside lit ones, and the dark ones beside those that are inside.
    const auto darkBeside = [&](auto wanted) {
        std::vector<std::uint32_t> found;
        forEachEdge(mesh, [&](std::uint32_t v, std::uint32_t w) {
            if (shares[v] == 0.0f && wanted(w))
                found.push_back(v);
        });
        std::ranges::sort(found);
        found.erase(std::unique(found.begin(), found.end()), found.end());
        return found;
    };
    const std::vector<std::uint32_t> rim =
        darkBeside([&](std::uint32_t w) { return shares[w] > 0.0f; });
    ask(rim, job);
    ask(darkBeside([&](std::uint32_t w) {
            return m_known[w] == kInside && std::ranges::binary_search(rim, w);
        }),
        job);
    if (job.cancelled())
        return;
    std::vector<float> sums(shares.size(), 0.0f), counts(shares.size(), 0.0f);
    forEachEdge(mesh, [&](std::uint32_t v, std::uint32_t w) {
        if (shares[v] != 0.0f || m_known[v] != kInside ||
            (shares[w] == 0.0f && m_known[w] == kInside))
            return;
        sums[v] += shares[w];
        counts[v] += 1.0f;
    });
    for (const std::uint32_t v : rim)
        if (m_known[v] == kInside && counts[v] > 0.0f)
            shares[v] = sums[v] / counts[v];
}

} // namespace patina
