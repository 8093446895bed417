#include "core/mesh/TriangleAdjacency.h"

#include "core/mesh/Weld.h"

#include <algorithm>

namespace patina {

std::vector<std::array<std::uint32_t, 3>> triangleAdjacency(const Mesh& mesh) {
    struct Edge {
        std::uint64_t key;    // smaller vertex, larger vertex
        std::uint32_t corner; // 3 * triangle + edge
        bool forward;         // runs from the smaller to the larger vertex
    };
    const std::vector<std::uint32_t> first = weldPositions(mesh.positions);
    std::vector<Edge> edges(mesh.indices.size());
    for (std::size_t corner = 0; corner < edges.size(); ++corner) {
        const std::size_t triangle = corner / 3, edge = corner % 3;
        const std::uint64_t a = first[mesh.indices[corner]];
        const std::uint64_t b = first[mesh.indices[3 * triangle + (edge + 1) % 3]];
        edges[corner] = {std::min(a, b) << 32 | std::max(a, b), static_cast<std::uint32_t>(corner),
                         a < b};
    }
    std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
        return a.key != b.key ? a.key < b.key : a.corner < b.corner;
    });

    std::vector<std::array<std::uint32_t, 3>> adjacency(mesh.triangleCount(),
                                                        {kNoTriangle, kNoTriangle, kNoTriangle});
    for (std::size_t begin = 0, end = 0; begin < edges.size(); begin = end) {
        while (end < edges.size() && edges[end].key == edges[begin].key)
            ++end;
        if (end - begin != 2 || edges[begin].forward == edges[begin + 1].forward)
            continue;
        const std::uint32_t a = edges[begin].corner, b = edges[begin + 1].corner;
        adjacency[a / 3][a % 3] = b / 3;
        adjacency[b / 3][b % 3] = a / 3;
    }
    return adjacency;
}

} // namespace patina
