// How a light looks at the scene when its shadow map is drawn: as closely as the scene's bounds
// allow. No OpenGL.
#pragma once

#include "core/document/Document.h"

#include <glm/mat4x4.hpp>

namespace patina::render {

struct ShadowView {
    glm::mat4 worldToClip{1.0f}; // for drawing the map
    glm::mat4 worldToMap{1.0f};  // to u, v and depth, 0…1 each, homogeneous
    // Diameter of the penumbra, in u and v, per difference in depth between receiver and occluder.
    // Depth is linear in the distance for a directional light and in its reciprocal for a spot: in
    // both cases the geometric width of the penumbra is this number times that difference.
    float penumbra = 0.0f;
    float texelDepth = 0.0f; // depth of one texel's width at the scene's centre
    float maxSlope = 0.0f; // depth per u of the steepest surface that is corrected for, about 80°
    bool empty = true;     // nothing of the scene lies in its light

    friend bool operator==(const ShadowView&, const ShadowView&) = default;
};

// `light`: directional or spot; `scene`: bounds of what casts and receives; `size`: texels along a
// side of the map.
[[nodiscard]] ShadowView shadowView(const Light& light, const Bounds& scene, int size);

} // namespace patina::render
