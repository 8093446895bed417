// What a camera sees of any scene without transmission, by brute force: written apart from
// core/trace/path, as its judge. It shares the triangles and the question what a ray meets first
// (core/trace/RayScene.h, of which it takes all surfaces for solid), and what a surface reflects
// (shaders/shared). How it looks for light is its own, and plain:
//   - random numbers are independent of each other;
//   - a path goes on by half in a cosine lobe, by half in a facet's of all that GGX has;
//   - every light, one glowing triangle and each bright part of the sky get a ray at every surface:
//     a point evenly on the light's area, a direction evenly in the part of the sky. A path does
//     not count what it meets of these itself, so that nothing is weighted;
//   - a blended surface lets a ray of a path pass by chance, and the share of a ray to a light.
#pragma once

#include "core/base/Result.h"
#include "core/light/Light.h"
#include "core/math/Camera.h"
#include "core/trace/RayScene.h"
#include "core/trace/path/TraceInputs.h"

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <vector>

namespace patina::reference {

// Directions around an axis: no two parts may share one.
struct SkyPart {
    glm::dvec3 axis{0.0, 1.0, 0.0}; // unit
    double cosHalfAngle = 1.0;
};

class PictureReference {
  public:
    // `bright`: small bright parts of the environments; right without them, too, but noisier.
    static Result<PictureReference> create(TraceInputs inputs, std::vector<SkyPart> bright = {});

    // Mean radiance of each pixel over its square by so many paths, rows from the top.
    [[nodiscard]] std::vector<glm::dvec3> look(const Camera& camera, int width, int height,
                                               int paths, std::uint64_t seed) const;

  private:
    class Path;
    struct Place;
    struct GlowingTriangle {
        std::size_t mesh = 0;
        std::uint32_t triangle = 0;
        double areaBefore = 0.0, area = 0.0; // m²; the former: of all before it and itself
    };

    PictureReference() = default;
    void collectGlow();
    [[nodiscard]] const Material& material(std::size_t mesh) const;
    [[nodiscard]] glm::dvec3 sky(const glm::dvec3& direction) const;
    [[nodiscard]] bool isBright(const glm::dvec3& direction) const;
    [[nodiscard]] Place placeOf(std::size_t mesh, std::uint32_t triangle, double b1,
                                double b2) const;

    TraceInputs m_inputs;
    std::vector<SkyPart> m_bright;
    std::unique_ptr<BakeGeometry> m_geometry; // m_rays points at it
    std::unique_ptr<RayScene> m_rays;
    std::vector<std::size_t> m_materials; // of the geometry's meshes
    std::vector<GlowingTriangle> m_glow;
    std::vector<glm::dvec2> m_dfg;
};

} // namespace patina::reference
