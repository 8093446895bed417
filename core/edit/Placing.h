// Moving, rotating and scaling meshes: one, or those of a model together.
#pragma once

#include "core/document/Document.h"

#include <span>
#include <utility>
#include <vector>

namespace patina {

using Placements = std::vector<std::pair<Id, Placement>>;

// Of those that exist.
[[nodiscard]] Placements placementsOf(const Document& document, std::span<const Id> meshes);
// In the world, of their vertices (not of their boxes, which rotation makes larger).
[[nodiscard]] Bounds exactBounds(const Document& document, std::span<const Id> meshes);

[[nodiscard]] Placements moved(Placements placements, const glm::vec3& by); // metres
// By angle degrees about an axis of the world (unit), the point `pivot` staying.
[[nodiscard]] Placements rotated(Placements placements, const glm::vec3& pivot,
                                 const glm::vec3& axis, float angleDeg);
// `factors`, each above 0: along the mesh's own axes; of several meshes all three are equal.
[[nodiscard]] Placements scaled(Placements placements, const glm::vec3& pivot,
                                const glm::vec3& factors);
// Together, so that their lowest vertex stands on the ground, y = 0.
[[nodiscard]] Placements droppedToGround(const Document& document, std::span<const Id> meshes);
// Each where its file has it.
[[nodiscard]] Placements backInPlace(const Document& document, std::span<const Id> meshes);

} // namespace patina
