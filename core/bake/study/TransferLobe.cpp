#include "core/bake/study/TransferLobe.h"

#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <numbers>

namespace patina {
namespace {

constexpr int kRings = 48, kSegments = 64;

glm::vec3 directionAt(int ring, int segment) {
    const float theta = std::numbers::pi_v<float> * static_cast<float>(ring) / kRings;
    const float phi = 2.0f * std::numbers::pi_v<float> * static_cast<float>(segment) / kSegments;
    return {std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi)};
}

} // namespace

LobeMesh transferLobe(const PointTransfer& transfer, unsigned bands, float peak,
                      const TransferColors& colors) {
    LobeMesh mesh;
    for (int ring = 0; ring <= kRings; ++ring)
        for (int segment = 0; segment <= kSegments; ++segment) {
            const glm::vec3 direction = directionAt(ring, segment);
            const float value = transfer.towards(direction, bands);
            mesh.positions.push_back(direction * (std::abs(value) / peak));
            mesh.colors.push_back(value < 0.0f ? colors.negative : colors.positive);
        }
    mesh.normals.assign(mesh.positions.size(), glm::vec3(0.0f));
    const auto row = static_cast<std::uint32_t>(kSegments + 1);
    const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        const glm::vec3 area = glm::cross(mesh.positions[b] - mesh.positions[a],
                                          mesh.positions[c] - mesh.positions[a]);
        for (const std::uint32_t i : {a, b, c})
            mesh.normals[i] += area;
        mesh.triangles.insert(mesh.triangles.end(), {a, b, c});
    };
    for (std::uint32_t ring = 0; ring < kRings; ++ring)
        for (std::uint32_t segment = 0; segment < kSegments; ++segment) {
            const std::uint32_t i = ring * row + segment;
            add(i, i + 1, i + row);
            add(i + 1, i + row + 1, i + row);
        }
    for (std::size_t i = 0; i < mesh.normals.size(); ++i) {
        glm::vec3& normal = mesh.normals[i];
        const float length = glm::length(normal);
        normal = length > 1e-12f // none where nothing is let through
                     ? normal / length
                     : directionAt(static_cast<int>(i / row), static_cast<int>(i % row));
    }
    return mesh;
}

} // namespace patina
