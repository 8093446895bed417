#include "render/scene/ShadowView.h"

#include "core/light/Light.h"
#include "core/light/Lights.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <limits>

namespace patina::render {
namespace {

constexpr float kSceneMargin = 0.02f; // around the scene, share of its extent
constexpr float kMaxConeDeg = 80.0f;  // beyond it a perspective map has no resolution left
constexpr float kNearShare =
    0.02f;                        // nearest depth of a spot within the scene, share of the far one
constexpr float kMaxSlope = 6.0f; // tan 80°

struct Range {
    float min = std::numeric_limits<float>::max(), max = std::numeric_limits<float>::lowest();
    void add(float value) {
        min = std::min(min, value);
        max = std::max(max, value);
    }
    [[nodiscard]] float extent() const { return max - min; }
    [[nodiscard]] float center() const { return 0.5f * (min + max); }
};

glm::vec3 corner(const Bounds& box, int i) {
    return {i & 1 ? box.max.x : box.min.x, i & 2 ? box.max.y : box.min.y,
            i & 4 ? box.max.z : box.min.z};
}

// Rows as they are written on paper.
glm::mat4 rows(const glm::vec4& x, const glm::vec4& y, const glm::vec4& z, const glm::vec4& w) {
    return glm::transpose(glm::mat4(x, y, z, w));
}

glm::mat4 clipToMap() {
    return rows({0.5f, 0, 0, 0.5f}, {0, 0.5f, 0, 0.5f}, {0, 0, 0.5f, 0.5f}, {0, 0, 0, 1});
}

float tanHalf(float degrees) {
    return std::tan(0.5f * glm::radians(degrees));
}

// Only rectangles have a roll: what another type keeps of one must not turn its map.
RectangleAxes mapAxes(Light light) {
    light.rollDeg = 0.0f;
    return rectangleAxes(light);
}

ShadowView directionalView(const Light& light, const Bounds& scene, int size) {
    const RectangleAxes axes = mapAxes(light);
    const glm::vec3 along = -light.directionToLight();
    Range x, y, z;
    for (int i = 0; i < 8; ++i) {
        const glm::vec3 p = corner(scene, i);
        x.add(glm::dot(axes.x, p));
        y.add(glm::dot(axes.y, p));
        z.add(glm::dot(along, p));
    }
    const float least = 1e-3f * scene.radius(); // a flat scene, seen from its side
    const float width =
        std::max(std::max(x.extent(), y.extent()), least) * (1.0f + 2.0f * kSceneMargin);
    const float depth = std::max(z.extent(), least) * (1.0f + 2.0f * kSceneMargin);
    ShadowView view;
    view.worldToClip = rows(glm::vec4(axes.x, -x.center()) * (2.0f / width),
                            glm::vec4(axes.y, -y.center()) * (2.0f / width),
                            glm::vec4(along, -z.center()) * (2.0f / depth), {0, 0, 0, 1});
    view.penumbra = 2.0f * tanHalf(light.shadowSoftness) * depth / width;
    view.texelDepth = width / static_cast<float>(size) / depth;
    view.maxSlope = kMaxSlope * width / depth;
    view.empty = false;
    return view;
}

ShadowView spotView(const Light& light, const Bounds& scene, int size) {
    const RectangleAxes axes = mapAxes(light);
    const glm::vec3 along = -light.directionToLight();
    const auto distanceOf = [&](const glm::vec3& p) { return glm::dot(along, p - light.position); };
    Range z;
    for (int i = 0; i < 8; ++i)
        z.add(distanceOf(corner(scene, i)));
    ShadowView view;
    if (!(z.max > 0.0f))
        return view;
    const float far = z.max + kSceneMargin * scene.radius();
    const float near = std::max(z.min - kSceneMargin * scene.radius(), kNearShare * far);

    // The window, in tangents: the cone's, or the scene's where that is smaller.
    const float cone = std::tan(glm::radians(std::min(light.outerConeDeg, kMaxConeDeg)));
    Range x, y;
    if (z.min > near) {
        for (int i = 0; i < 8; ++i) {
            const glm::vec3 p = corner(scene, i) - light.position;
            x.add(std::clamp(glm::dot(axes.x, p) / glm::dot(along, p), -cone, cone));
            y.add(std::clamp(glm::dot(axes.y, p) / glm::dot(along, p), -cone, cone));
        }
    } else {
        x.min = y.min = -cone;
        x.max = y.max = cone;
    }
    const float half = 0.5f * std::max(x.extent(), y.extent()) * (1.0f + 2.0f * kSceneMargin);
    if (!(half > 0.0f)) // all of the scene lies beside the cone
        return view;

    const glm::vec4 forward(along, -glm::dot(along, light.position));
    const auto across = [&](const glm::vec3& axis, float center) {
        return (glm::vec4(axis, -glm::dot(axis, light.position)) - center * forward) / half;
    };
    const glm::vec4 depth = forward * ((far + near) / (far - near)) -
                            glm::vec4(0, 0, 0, 2.0f * far * near / (far - near));
    view.worldToClip = rows(across(axes.x, x.center()), across(axes.y, y.center()), depth, forward);

    const float reciprocals = 1.0f / near - 1.0f / far;
    const glm::vec3 center = scene.center();
    const float source =
        2.0f * tanHalf(light.shadowSoftness) * glm::distance(light.position, center);
    view.penumbra = source / (2.0f * half) * reciprocals;
    // One unit of u is 2 half z metres wide, one metre 1 / (z² reciprocals) deep.
    const float z0 = std::clamp(distanceOf(center), near, far);
    const float depthPerU = 2.0f * half / (z0 * reciprocals);
    view.texelDepth = depthPerU / static_cast<float>(size);
    view.maxSlope = kMaxSlope * depthPerU;
    view.empty = false;
    return view;
}

} // namespace

ShadowView shadowView(const Light& light, const Bounds& scene, int size) {
    if (scene.empty() || !canCastShadow(light.type))
        return {};
    ShadowView view = light.type == LightType::Spot ? spotView(light, scene, size)
                                                    : directionalView(light, scene, size);
    view.worldToMap = clipToMap() * view.worldToClip;
    return view;
}

} // namespace patina::render
