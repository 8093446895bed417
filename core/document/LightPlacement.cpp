#include "core/document/LightPlacement.h"

#include "core/light/Light.h"
#include "core/light/Lights.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <limits>

namespace patina {
namespace {

// Of the half picture, square in the middle: whatever shape the viewport has, it is in there, with
// its handles.
constexpr float kSeen = 0.7f;
constexpr float kApart = 0.4f;    // radii of the scene between two lights, at least
constexpr float kTurnDeg = 25.0f; // between directional lights
constexpr float kSameDeg = 5.0f;
constexpr int kCells = 6, kDepths = 18; // of the places that are tried

float sizeOf(const Light& light) {
    switch (light.type) {
    case LightType::Sphere:
        return light.radius;
    case LightType::Rectangle:
        return 0.5f * std::hypot(light.width, light.height);
    default:
        return 0.0f;
    }
}

// The picture's plane as the camera sees it: x and y in -1 … 1 over the square, z metres away.
struct ViewSpace {
    Camera camera;
    float tangent;

    explicit ViewSpace(const Camera& c)
        : camera(c)
        , tangent(std::tan(0.5f * glm::radians(c.fovDeg))) {}

    [[nodiscard]] glm::vec3 fromWorld(const glm::vec3& p) const {
        const glm::vec3 d = p - camera.position();
        const float depth = glm::dot(d, camera.forward());
        const float half = std::max(std::abs(depth), 1e-6f) * tangent;
        return {glm::dot(d, camera.right()) / half, glm::dot(d, camera.up()) / half, depth};
    }
    [[nodiscard]] glm::vec3 toWorld(const glm::vec3& v) const {
        const float half = v.z * tangent;
        return camera.position() + v.z * camera.forward() + v.x * half * camera.right() +
               v.y * half * camera.up();
    }
    [[nodiscard]] bool sees(const glm::vec3& p) const {
        const glm::vec3 v = fromWorld(p);
        return v.z > 0.0f && std::max(std::abs(v.x), std::abs(v.y)) <= kSeen + 1e-4f;
    }
};

// Moved into the picture; in front of the scene where it would come to lie within it.
glm::vec3 broughtIntoView(const glm::vec3& p, const ViewSpace& view, const Bounds& scene) {
    if (view.sees(p))
        return p;
    const float distance = glm::length(scene.center() - view.camera.position());
    const float before = std::max(distance - 1.2f * scene.radius(), 0.3f * distance);
    glm::vec3 v = view.fromWorld(p);
    if (!(v.z > 0.0f))
        v = {v.x < 0.0f ? -kSeen : kSeen, kSeen, before};
    v.x = std::clamp(v.x, -kSeen, kSeen);
    v.y = std::clamp(v.y, -kSeen, kSeen);
    if (glm::length(view.toWorld(v) - scene.center()) < 1.1f * scene.radius())
        v.z = before;
    return view.toWorld(v);
}

// Whether the scene lies at p, or before it.
bool isHidden(const glm::vec3& p, const glm::vec3& viewer, const Bounds& scene) {
    const float radius = 1.1f * scene.radius();
    if (glm::length(p - scene.center()) < radius)
        return true;
    const glm::vec3 way = p - viewer, toScene = scene.center() - viewer;
    const float share = glm::dot(toScene, way) / std::max(glm::dot(way, way), 1e-12f);
    return share > 0.0f && share < 1.0f && glm::length(toScene - share * way) < radius &&
           glm::length(toScene) > radius; // a viewer inside of it sees past it
}

// The nearest place to `start` that is seen and free of other lights: as far from them as both are
// large, where the picture has so much room.
glm::vec3 freePlace(const glm::vec3& start, const Light& light, const Document& document,
                    const Bounds& scene) {
    const ViewSpace view(document.view.camera);
    const glm::vec3 viewer = view.camera.position();
    const float radius = std::max(scene.radius(), 1e-3f);
    const float away = std::max(glm::length(scene.center() - viewer), 1e-3f);
    const auto isFree = [&](const glm::vec3& p, float room) {
        return std::none_of(
            document.lights.begin(), document.lights.end(), [&](const Light& other) {
                const float apart =
                    std::max(kApart * radius, room * (sizeOf(light) + sizeOf(other)));
                return hasPosition(other.type) && glm::length(other.position - p) < apart;
            });
    };
    for (const float room : {1.0f, 0.5f, 0.0f}) {
        if (isFree(start, room))
            return start;
        glm::vec3 nearest = start;
        float distance = std::numeric_limits<float>::max();
        // From a third of the way to the scene to four times as far.
        for (int z = 0; z <= kDepths; ++z)
            for (int y = -kCells; y <= kCells; ++y)
                for (int x = -kCells; x <= kCells; ++x) {
                    const glm::vec3 p = view.toWorld(
                        {kSeen * static_cast<float>(x) / kCells,
                         kSeen * static_cast<float>(y) / kCells,
                         away * std::exp2(-1.6f + 3.6f * static_cast<float>(z) / kDepths)});
                    const float from = glm::length(p - start);
                    if (from < distance && isFree(p, room) && !isHidden(p, viewer, scene)) {
                        nearest = p;
                        distance = from;
                    }
                }
        if (distance < std::numeric_limits<float>::max())
            return nearest;
    }
    return start; // there are hundreds
}

Light turnedAway(Light light, const Document& document) {
    const auto taken = [&] {
        return std::any_of(document.lights.begin(), document.lights.end(), [&](const Light& other) {
            return other.type == light.type &&
                   glm::dot(other.directionToLight(), light.directionToLight()) >
                       std::cos(glm::radians(kSameDeg));
        });
    };
    for (float turned = 0.0f; turned < 360.0f && taken(); turned += kTurnDeg)
        light.azimuthDeg = std::remainder(light.azimuthDeg + kTurnDeg, 360.0f);
    return light;
}

} // namespace

Light placedInView(const Light& light, const Document& document) {
    if (!hasPosition(light.type))
        return turnedAway(light, document);
    const Bounds scene = document.bounds();
    const auto last = std::find_if(document.lights.rbegin(), document.lights.rend(),
                                   [](const Light& other) { return hasPosition(other.type); });
    const glm::vec3 beside = last != document.lights.rend() ? last->position : light.position;
    Light placed = light;
    placed.position = freePlace(broughtIntoView(beside, ViewSpace(document.view.camera), scene),
                                light, document, scene);
    if (placed.position == light.position)
        return light;
    if (hasDirection(light.type))
        setDirectionToLight(placed, placed.position - scene.center());
    const float before = illuminanceAt(light, scene.center());
    const float scaled = placed.intensity * before / illuminanceAt(placed, scene.center());
    if (before > 0.0f && std::isfinite(scaled) && scaled > 0.0f)
        placed.intensity = scaled;
    return placed;
}

} // namespace patina
