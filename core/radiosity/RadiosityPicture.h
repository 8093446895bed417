// Pictures of a solution, by a ray through each part of a pixel.
#pragma once

#include "core/base/Result.h"
#include "core/image/Image.h"
#include "core/job/JobContext.h"
#include "core/radiosity/Reconstruction.h"
#include "core/radiosity/SceneProblem.h"
#include "core/trace/path/PathTracer.h"

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

namespace patina::radiosity {

enum class Look {
    Smooth,   // light interpolated between vertices, textures and glow as they are
    Elements, // each element's own, in one colour
    Gathered, // every point gathers the light of what it sees, lights straight: without the
              // division
};

struct PictureSettings {
    Look look = Look::Smooth;
    int samples = 4;     // rays per pixel
    int gatherRays = 64; // Gathered: of each of them, to surfaces as to lights
    std::uint32_t seed = 0;
};

// A place on a triangle of the scene, on one of its sides.
struct SidePlace {
    std::uint32_t mesh = 0, triangle = 0; // of the geometry, of the mesh
    glm::vec2 weights{0.0f};              // barycentric coordinates of the second and third corner
    bool back = false;
};

// A solution as it is looked at. What it is made of must outlive it.
class SeenSolution {
  public:
    SeenSolution(const TraceScene& scene, const ElementMesh& elements, const SceneProblem& lit,
                 const Solution& solution);

    // Interpolated irradiance at a point of an element (scene units), W/m².
    [[nodiscard]] glm::vec3 irradiance(std::uint32_t element, const glm::dvec3& position) const;
    // Of all that the element sends, W/m².
    [[nodiscard]] glm::vec3 radiosity(std::uint32_t element) const { return m_radiosity[element]; }

    // Linear radiance that leaves a place of a side that is divided.
    [[nodiscard]] glm::vec3 radianceAt(const SidePlace& place, const PictureSettings& settings,
                                       std::uint32_t seed) const;
    // Whether it is within something else: ElementMesh::isBuried().
    [[nodiscard]] bool isBuried(const SidePlace& place) const;

    // Linear radiance, RGBA, F32, with coverage. Light falls on the sides that were solved, and the
    // view's background is what stands behind. Errors: Cancelled.
    [[nodiscard]] Result<Image> picture(const TraceView& view, const PictureSettings& settings,
                                        const JobContext& job) const;

  private:
    [[nodiscard]] ClosestRay rayTo(const SidePlace& place) const; // that has met it
    [[nodiscard]] glm::vec3 radiance(const ClosestRay& ray, const PictureSettings& settings,
                                     std::uint32_t seed) const;
    [[nodiscard]] glm::vec3 gathered(const TracePoint& point, const PictureSettings& settings,
                                     std::uint32_t seed) const;

    const TraceScene& m_scene;
    const ElementMesh& m_elements;
    LitMesh m_mesh;
    std::vector<glm::dvec3> m_light;            // irradiance of each of its lights
    std::vector<std::uint32_t> m_firstTriangle; // of each element, and their number
    std::vector<glm::vec3> m_radiosity;
};

} // namespace patina::radiosity
