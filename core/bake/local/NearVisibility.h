// How much of a local light arrives at points of a scene, traced with rays: transfer in spherical
// harmonics knows directions, not distances, and no sharp edge.
#pragma once

#include "core/bake/domain/BakePoints.h"
#include "core/document/Document.h"
#include "core/trace/BakeScene.h"

#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

namespace patina {

// Where a light is and how large: all that its shadows depend on besides the scene. World space.
struct NearEmitter {
    enum class Shape { Point, Sphere, Rectangle };
    Shape shape = Shape::Point; // spots are points: a cone takes light away, and adds no shadow
    glm::vec3 position{0.0f};
    float radius = 0.0f;                // metres, sphere
    glm::vec3 halfX{0.0f}, halfY{0.0f}; // half of a rectangle's sides; the side that
                                        // cross(halfY, halfX) points to is lit
    friend bool operator==(const NearEmitter&, const NearEmitter&) = default;
};

// Nothing for a directional light.
[[nodiscard]] std::optional<NearEmitter> nearEmitter(const Light& light);

// Rays to spheres and rectangles: so many everywhere, and so many where these disagree. Points of
// light take one; where blended surfaces let rays pass by chance, they take as many.
inline constexpr std::uint32_t kFirstNearRays = 32, kMostNearRays = 256;

// So many points are traced together, by one thread: the caller's where there are no more.
inline constexpr std::size_t kNearGrain = 64;

// For each point the share E / E_open, 0…1, of the light's irradiance that arrives: cosine-weighted
// over the light's area, by rays that end at the light, so that nothing behind it casts a shadow.
// Exactly 0 in full shadow and exactly 1 where nothing is in the way; 1 where the light would not
// reach the open surface either (behind it, or on a rectangle's dark side). Point i takes the
// samples of element firstElement + i: results depend on neither the number of threads nor the way
// points are divided. Errors: Cancelled.
[[nodiscard]] Result<std::vector<float>>
nearVisibility(const BakeScene& scene, std::span<const BakePoint> points,
               const NearEmitter& emitter, const JobContext& job, std::uint32_t firstElement = 0);

} // namespace patina
