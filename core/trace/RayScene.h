// Asking whether something is in the way: the scene's triangles in a bounding volume hierarchy. The
// only part of Patina that sees Embree.
#pragma once

#include "core/base/Result.h"
#include "core/job/JobContext.h"
#include "core/trace/BakeGeometry.h"

#include <cstddef>
#include <glm/vec3.hpp>
#include <limits>
#include <memory>
#include <span>

namespace patina {

// A question and its answer. Laid out as Embree's RTCRay, so that rays are not copied.
struct alignas(16) OcclusionRay {
    glm::vec3 origin{0.0f}; // scene units (core/trace/BakeGeometry.h)
    float minDistance = 0.0f;
    glm::vec3 direction{0.0f, 1.0f, 0.0f}; // unit
    float time = 0.0f;
    float maxDistance = std::numeric_limits<float>::infinity();
    unsigned mask = ~0u;
    unsigned id = 0;
    unsigned flags = 0;

    // After RayScene::occlude: something is between minDistance and maxDistance.
    [[nodiscard]] bool occluded() const {
        return maxDistance == -std::numeric_limits<float>::infinity();
    }
};

// A question for what is met first, and its answer. Laid out as RTCRayHit of Embree 3.
struct alignas(16) ClosestRay {
    static constexpr unsigned kNothing = ~0u;

    OcclusionRay ray;
    glm::vec3 geometricNormal{0.0f}; // not normalised
    // Barycentric coordinates: (1 - u - v) of the triangle's first corner, u of its second, v of
    // its third.
    float u = 0.0f, v = 0.0f;
    unsigned triangle = kNothing; // of the mesh
    unsigned mesh = kNothing;     // index into BakeGeometry::meshes; kNothing: the ray met nothing
    unsigned instance = kNothing;
};

class RayScene {
  public:
    // Builds the hierarchy over all triangles, the better the more rays are to come; both sides
    // occlude, except where a masked or blended surface lets the ray through. `geometry` must
    // outlive the scene: its vertices and indices are used in place. A build that needs more than
    // `maxBytes` (0: no limit) or that the system refuses memory is an Internal error; cancelling
    // stops the build.
    static Result<RayScene> build(const BakeGeometry& geometry, const JobContext& job,
                                  std::size_t maxBytes = 0, double expectedRays = 0.0);
    RayScene(RayScene&&) noexcept;
    RayScene& operator=(RayScene&&) noexcept;
    ~RayScene();

    // Answers every ray in place; 256 to 2048 at a time are fastest. Embree
    // aborts the process on rays that are not finite: such rays, and rays without direction,
    // are left out, count as not occluded, and their number is returned. Callable from any thread.
    std::size_t occlude(std::span<OcclusionRay> rays) const;
    // The same for rays that are finite for certain: not a look is spent on that.
    void occludeFinite(std::span<OcclusionRay> rays) const;
    // What each ray meets first, under the same rules.
    std::size_t intersect(std::span<ClosestRay> rays) const;

    // Whether chance has decided since the last call, on this thread, if a blended surface stops a
    // ray: what was found then is a sample and no value.
    [[nodiscard]] static bool takeChance();

    [[nodiscard]] std::size_t triangleCount() const;
    [[nodiscard]] std::size_t memoryBytes() const; // of the hierarchy

  private:
    struct Impl;
    explicit RayScene(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> m_impl;
};

// While it lives, this thread flushes denormal floats to zero: near-zero coordinates would slow
// down traversal a hundredfold. Restores the previous mode.
class FlushDenormals {
  public:
    FlushDenormals();
    ~FlushDenormals();
    FlushDenormals(const FlushDenormals&) = delete;
    FlushDenormals& operator=(const FlushDenormals&) = delete;

  private:
    unsigned m_previous;
};

} // namespace patina
