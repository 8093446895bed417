// A scene as a path tracer sees it: what the ray through a pixel meets, and the surface there.
// Shares with Patina's bakes the triangles and the question what a ray meets first
// (core/trace/RayScene.h), nothing of what they do with the answers.
#pragma once

#include "core/document/Document.h"
#include "core/trace/RayScene.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace patina::reference {

// A place on a surface, seen from the side of `normal`.
struct Place {
    std::size_t mesh = 0; // of inputs().meshes
    std::uint32_t triangle = 0;
    double b1 = 0.0, b2 = 0.0; // barycentric weights of the corners 1 and 2
    glm::dvec3 position{0.0};  // scene units
    glm::dvec3 normal{0.0};    // unit: interpolated
    glm::dvec3 face{0.0};      // unit: the triangle's, on the side of `normal`
    glm::dvec3 albedo{0.0};    // of the diffuse reflection
};

class ReferenceScene {
  public:
    static Result<ReferenceScene> create(const Document& document);

    [[nodiscard]] const BakeInputs& inputs() const { return m_inputs; }

    // What is seen through the centre of every pixel, rows from the top; nothing where a ray meets
    // nothing, or the back of a surface that has none.
    [[nodiscard]] std::vector<std::optional<Place>> look(const Camera& camera, int width,
                                                         int height) const;
    // Answers the rays in place.
    void intersect(std::span<ClosestRay> rays) const;
    // Where a ray ended, if that reflects.
    [[nodiscard]] std::optional<Place> place(const ClosestRay& ray) const;
    // A ray that leaves a place, clear of the surface.
    [[nodiscard]] static ClosestRay rayFrom(const Place& from, const glm::dvec3& direction);

  private:
    ReferenceScene(BakeInputs inputs, std::unique_ptr<BakeGeometry> geometry, RayScene rays);

    BakeInputs m_inputs;
    std::unique_ptr<BakeGeometry> m_geometry; // m_rays points at it
    RayScene m_rays;
};

} // namespace patina::reference
