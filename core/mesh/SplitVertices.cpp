#include "core/mesh/SplitVertices.h"

#include "core/base/Check.h"

#include <limits>

namespace patina {

std::vector<std::uint32_t> splitVertices(Mesh& mesh, std::span<const std::uint32_t> labels,
                                         std::vector<std::uint32_t>* origin) {
    CHECK_EQ(labels.size(), mesh.triangleCount());
    CHECK(origin == nullptr || origin->size() == mesh.vertexCount());
    constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
    std::vector<std::uint32_t> label(mesh.vertexCount(), kNone);
    // Copies of one original form a list from copy to copy; few vertices have more than two.
    std::vector<std::uint32_t> nextCopy(mesh.vertexCount(), kNone);
    const bool hasNormals = mesh.normals.size() == mesh.positions.size();
    const bool hasTangents = mesh.tangents.size() == mesh.positions.size();
    mesh.uvs.clear();

    for (std::size_t corner = 0; corner < mesh.indices.size(); ++corner) {
        const std::uint32_t wanted = labels[corner / 3];
        std::uint32_t vertex = mesh.indices[corner];
        while (label[vertex] != kNone && label[vertex] != wanted && nextCopy[vertex] != kNone)
            vertex = nextCopy[vertex];
        if (label[vertex] == kNone) {
            label[vertex] = wanted;
        } else if (label[vertex] != wanted) {
            const auto copy = static_cast<std::uint32_t>(mesh.positions.size());
            mesh.positions.push_back(glm::vec3(mesh.positions[vertex]));
            if (hasNormals)
                mesh.normals.push_back(glm::vec3(mesh.normals[vertex]));
            if (hasTangents)
                mesh.tangents.push_back(glm::vec4(mesh.tangents[vertex]));
            if (origin != nullptr)
                origin->push_back(std::uint32_t{(*origin)[vertex]});
            label.push_back(wanted);
            nextCopy.push_back(kNone);
            nextCopy[vertex] = copy;
            vertex = copy;
        }
        mesh.indices[corner] = vertex;
    }
    for (std::uint32_t& value : label)
        value = value == kNone ? 0 : value;
    return label;
}

} // namespace patina
