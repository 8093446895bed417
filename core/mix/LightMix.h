// The light mix of a document, as on a mixing desk: which lights and environments take part (on,
// solo), and what the environments' faders (gain, tint, cross-fade) make of their light.
#pragma once

#include "core/document/Document.h"
#include "core/light/Orientation.h"

#include <vector>

namespace patina {

// While anything is solo, a light or an environment, everything else is off.
[[nodiscard]] bool anySolo(const Document& document);

// Switched on, and solo if anything is.
[[nodiscard]] bool isActive(const Document& document, const Light& light);
// The lights of which that is so, in the document's order; they point into it.
[[nodiscard]] std::vector<const Light*> activeLights(const Document& document);

// Environment that lights the scene: radiance scale · image, as it stands in the world.
struct EnvironmentPart {
    enum class Role { First, Second, Both };
    Role role = Role::First; // whose picture it is
    ImagePtr image;          // lat-long, as Environment::image
    Orientation orientation;
    glm::vec3 scale{1.0f};
    friend bool operator==(const EnvironmentPart&, const EnvironmentPart&) = default;
};

// Those that take part: on, solo if anything is, neither faded out nor black. Their radiances add
// up; the cross-fade weighs the first by 1 - fade, the second by fade, as long as there is a second
// one with an image and not one alone is solo, which is in full. At most two, the first one first.
[[nodiscard]] std::vector<EnvironmentPart> environmentParts(const Document& document);
// With `environment` alone in place of the document's; whether another one or a light is solo, and
// it itself is, the document says.
[[nodiscard]] std::vector<EnvironmentPart> environmentParts(const Document& document,
                                                            const Environment& environment);

// The same as one picture: the part where there is one; `blended` where there are two, or the first
// until it is there; where there is none the first environment's, scaled by 0.
[[nodiscard]] EnvironmentPart shownEnvironment(const Document& document);
[[nodiscard]] EnvironmentPart shownEnvironment(const Document& document,
                                               const Environment& environment);

} // namespace patina
