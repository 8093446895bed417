// The cameras that a scene's model files hold, and the view camera that shows what one of them
// does.
#pragma once

#include "core/math/Bounds.h"
#include "core/math/Camera.h"

#include <glm/vec3.hpp>
#include <string>

namespace patina {

struct SceneCamera {
    std::string name; // unlike those of the scene's others
    glm::vec3 position{0.0f}, forward{0.0f, 0.0f, -1.0f}, up{0.0f, 1.0f, 0.0f}; // unit vectors
    float fovDeg = 35.0f;                                                       // vertical
    friend bool operator==(const SceneCamera&, const SceneCamera&) = default;
};

// Stands and looks as the scene's does; its target is as far away as the middle of `scene`.
// Upright, and at most 89° up or down, as all view cameras: where that makes a difference, `notice`
// receives a sentence about it. The lens is that of `view`.
[[nodiscard]] Camera cameraLike(const SceneCamera& camera, const Camera& view, const Bounds& scene,
                                std::string& notice);

} // namespace patina
