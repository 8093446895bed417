// One point of a surface as a transfer bake knows it, and what it sees: for looking closer.
#pragma once

#include "core/bake/domain/BakeArtifact.h"
#include "core/base/Result.h"
#include "core/job/JobContext.h"
#include "core/trace/BakeInputs.h"

#include <array>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

namespace patina {

struct Document;

// Where a point lies on a mesh.
struct MeshPoint {
    Id mesh = 0;
    std::size_t triangle = 0;
    glm::vec3 weights{0.0f}; // of its corners; their sum is 1
};

// The point of the mesh nearest to a point of the world; nothing when the mesh is gone or empty.
[[nodiscard]] std::optional<MeshPoint> nearestMeshPoint(const Document& document, Id mesh,
                                                        const glm::vec3& position);

// The texel of a side × side texture at the point, in rows from the top. The mesh must have texture
// coordinates.
[[nodiscard]] std::size_t texelOf(const Mesh& mesh, const MeshPoint& point, int side);

// The transfer that is shown at a point: between vertices as triangles interpolate, between texels
// the nearest one's.
struct PointTransfer {
    int order = 0;
    std::vector<float> direct;      // T_i, order²
    std::vector<glm::vec3> bounced; // B_i by colour; empty: none

    [[nodiscard]] glm::vec3 coefficient(std::size_t i) const { // T_i + B_i
        return bounced.empty() ? glm::vec3(direct[i]) : direct[i] + bounced[i];
    }
    [[nodiscard]] float meanCoefficient(std::size_t i) const { // of red, green and blue
        const glm::vec3 c = coefficient(i);
        return (c.x + c.y + c.z) / 3.0f;
    }
    // Σ over the bands whose bit is set of light_i (T_i + B_i): exit radiance of albedo 1.
    [[nodiscard]] glm::vec3 radiance(const std::vector<glm::vec3>& light, unsigned bands) const;
    // Of B_i alone, by way of other surfaces.
    [[nodiscard]] glm::vec3 bouncedRadiance(const std::vector<glm::vec3>& light,
                                            unsigned bands) const;
    // T_i and the mean of B_i as a function of the direction: Σ (T_i + B_i) Y_i(direction).
    [[nodiscard]] float towards(const glm::vec3& direction, unsigned bands) const;
};

// Nothing when the bake has no values for that mesh as it is now.
[[nodiscard]] std::optional<PointTransfer>
pointTransfer(const Document& document, const BakeArtifact& bake, const MeshPoint& point);

// Which directions of a lat-long picture (2 height × height, row 0 up, its middle -Z) nothing of
// the scene hides from the point, one ray each; directions behind the surface are hidden.
// Errors: those of BakeScene::build(); Cancelled.
Result<std::vector<bool>> visibleDirections(const BakeInputs& inputs, const MeshPoint& point,
                                            int height, const JobContext& job);
// The direction of a pixel's centre of such a picture, unit.
[[nodiscard]] glm::vec3 latLongDirection(int x, int y, int width, int height);

} // namespace patina
