// Patina's side of a comparison: what a transfer bake shows at places of a scene.
#pragma once

#include "core/bake/domain/BakeArtifact.h"
#include "tests/reference/ReferenceScene.h"

#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

namespace patina::reference {

// Exit radiance, albedo included: values between vertices (or texels) interpolated, dot `light`,
// radiance coefficients of which the first order² are used (at most as many as the bake holds).
// `bounced`: with the part that came by way of other surfaces.
[[nodiscard]] std::vector<glm::dvec3> transferPicture(const ReferenceScene& scene,
                                                      std::span<const std::optional<Place>> places,
                                                      const BakeArtifact& artifact,
                                                      std::span<const glm::vec3> light, int order,
                                                      bool bounced);

// Of two pictures, over the pixels that show a surface and three channels.
struct Distance {
    double mean = 0.0;  // of the reference
    double bias = 0.0;  // of the picture: its mean less the reference's
    double rmse = 0.0;  // of the picture
    double noise = 0.0; // RMS of the reference's own
    double worst = 0.0; // largest difference
    // The share of the mean that the picture is off, the reference's noise taken away.
    [[nodiscard]] double relative() const;
};
[[nodiscard]] Distance distance(std::span<const std::optional<Place>> places,
                                std::span<const glm::dvec3> picture,
                                std::span<const glm::dvec3> reference,
                                std::span<const glm::dvec3> noise);

} // namespace patina::reference
