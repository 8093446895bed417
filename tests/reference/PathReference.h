// Diffuse light by brute force: from every pixel's place paths go on from surface to surface until
// they leave the scene, and bring back what the environment sends from there.
#pragma once

#include "tests/reference/ReferenceLight.h"
#include "tests/reference/ReferenceScene.h"

#include <array>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

namespace patina::reference {

enum class Transport { Unshadowed, Shadowed, Interreflected };
inline constexpr int kTransports = 3;

struct PathSettings {
    int paths = 1024; // per pixel, in each of the two pictures; at least one from each place
    int bounces = 3;  // at most, on other surfaces than the one that is seen
    std::uint32_t seed = 1;
    // Places in rows of `width` belong to pixels of side × side places, each of which share out the
    // paths of one pixel among them.
    int side = 1, width = 1;
};

// Exit radiance of every place, albedo included. Two pictures of independent paths: their mean is
// the reference, half their difference its noise.
struct PathPictures {
    struct Pixel {
        std::array<glm::dvec3, kLights> light{}; // [0] whole environment, [n] its first n bands
    };
    // [environment][transport][0 or 1]
    std::vector<std::array<std::array<std::vector<Pixel>, 2>, kTransports>> pictures;

    [[nodiscard]] std::vector<glm::dvec3> mean(std::size_t environment, Transport transport,
                                               int light) const;
    [[nodiscard]] std::vector<glm::dvec3> halfDifference(std::size_t environment,
                                                         Transport transport, int light) const;
};

[[nodiscard]] PathPictures tracePaths(const ReferenceScene& scene,
                                      std::span<const std::optional<Place>> places,
                                      std::span<const ReferenceLight> environments,
                                      const PathSettings& settings);

} // namespace patina::reference
