// One picture of two environments that light the scene together, for image-based light, which is
// prepared from one picture.
#pragma once

#include "core/document/Document.h"
#include "core/job/JobContext.h"
#include "core/light/Orientation.h"

#include <optional>

namespace patina {

// All that the picture depends on.
struct EnvironmentBlend {
    ImagePtr first, second;
    Orientation firstStands, secondStands; // seen from the rotation of the first
    glm::vec3 firstScale{1.0f}, secondScale{1.0f};
    friend bool operator==(const EnvironmentBlend&, const EnvironmentBlend&) = default;
};
// None where fewer than two environments take part: environmentParts() of LightMix.h.
[[nodiscard]] std::optional<EnvironmentBlend> environmentBlend(const Document& document);

// firstScale · first + secondScale · second as they stand, of the larger picture's size. Null
// after a cancel.
[[nodiscard]] ImagePtr blendEnvironments(const EnvironmentBlend& blend, const JobContext& job = {});

// The environments that light the scene as a single environment with neither tint nor fade, for
// files that know of no mix; nothing where none shine.
[[nodiscard]] std::optional<Environment> mixedEnvironment(const Document& document,
                                                          const JobContext& job = {});

// Makes mix.blended what the mix asks for, or null.
void resolveBlend(Document& document, const JobContext& job = {});

} // namespace patina
