#include "core/edit/Placing.h"

#include "core/light/Light.h"
#include "core/material/Material.h"

#include <glm/ext/matrix_transform.hpp>
#include <glm/trigonometric.hpp>

namespace patina {

Placements placementsOf(const Document& document, std::span<const Id> meshes) {
    Placements placements;
    for (const Id id : meshes)
        if (const MeshInstance* mesh = document.mesh(id))
            placements.emplace_back(id, mesh->placement);
    return placements;
}

Bounds exactBounds(const Document& document, std::span<const Id> meshes) {
    Bounds bounds;
    for (const Id id : meshes) {
        const MeshInstance* mesh = document.mesh(id);
        if (mesh == nullptr || !mesh->mesh)
            continue;
        const glm::mat4& matrix = mesh->placement.matrix();
        for (const glm::vec3& position : mesh->mesh->positions)
            bounds.add(glm::vec3(matrix * glm::vec4(position, 1.0f)));
    }
    return bounds;
}

Placements moved(Placements placements, const glm::vec3& by) {
    for (auto& [id, placement] : placements)
        placement.setPosition(placement.position() + by);
    return placements;
}

Placements rotated(Placements placements, const glm::vec3& pivot, const glm::vec3& axis,
                   float angleDeg) {
    const glm::mat3 rotation(glm::rotate(glm::mat4(1.0f), glm::radians(angleDeg), axis));
    for (auto& [id, placement] : placements)
        placement.rotateAbout(pivot, rotation);
    return placements;
}

Placements scaled(Placements placements, const glm::vec3& pivot, const glm::vec3& factors) {
    for (auto& [id, placement] : placements)
        placement.scaleAbout(pivot, factors);
    return placements;
}

Placements droppedToGround(const Document& document, std::span<const Id> meshes) {
    const Bounds bounds = exactBounds(document, meshes);
    Placements placements = placementsOf(document, meshes);
    return bounds.empty() ? placements : moved(std::move(placements), {0, -bounds.min.y, 0});
}

Placements backInPlace(const Document& document, std::span<const Id> meshes) {
    Placements placements = placementsOf(document, meshes);
    for (auto& [id, placement] : placements)
        placement = placement.back();
    return placements;
}

} // namespace patina
