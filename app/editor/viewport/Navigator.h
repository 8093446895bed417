// How the hand moves the camera: orbit, pan, dolly and fly, as pure functions of a Camera. Angles
// grow with the drag so that the surface under the pointer follows it.
#pragma once

#include "core/math/Camera.h"

#include <glm/vec2.hpp>

namespace patina::editor {

// Of the environment, or of a light about the scene, per widget pixel.
inline constexpr float kTurnDegrees = 0.4f;

// `pixels`: the drag since the last call, y down, in widget pixels; `height`: of the widget.
[[nodiscard]] Camera orbit(Camera camera, glm::vec2 pixels);
// The point at the target's depth stays under the pointer.
[[nodiscard]] Camera pan(Camera camera, glm::vec2 pixels, float height);
// One wheel notch is steps = 1: the distance shrinks by a tenth per step. `sceneRadius` bounds it.
[[nodiscard]] Camera dolly(Camera camera, float steps, float sceneRadius);
// Turns the camera about its own position.
[[nodiscard]] Camera look(Camera camera, glm::vec2 pixels);
// Moves camera and target: x right, y up, z forward, in metres.
[[nodiscard]] Camera fly(Camera camera, const glm::vec3& metres);

} // namespace patina::editor
