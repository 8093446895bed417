// A ball of the looked-at material under one light and its environment, shaded on any thread by the
// functions that shade the viewport.
#pragma once

#include "core/document/Document.h"
#include "core/light/BrdfLens.h"
#include "core/light/Ibl.h"
#include "core/light/Orientation.h"

#include <QImage>
#include <memory>

namespace patina::editor {

struct SphereLight {
    // World: the viewer looks along -Z, +Y is up. Unit vector to the light.
    glm::vec3 toLight{0.0f, 0.0f, 1.0f};
    float illuminance = 3.0f;            // of the light, lux
    std::shared_ptr<const IblMaps> maps; // of the environment; null: the light alone
    Orientation orientation;             // of the environment
    float exposureEv = 0.0f;             // of the environment
    View view; // exposure and tone curve; what needs the picture's luminance is shown by default
};

// Radiance towards the viewer at normal n.
[[nodiscard]] glm::vec3 sphereRadiance(const BrdfLens& lens, const SphereLight& light,
                                       const glm::vec3& n);
// `side` pixels square, transparent around the ball.
[[nodiscard]] QImage spherePicture(const BrdfLens& lens, const SphereLight& light, int side);

} // namespace patina::editor
