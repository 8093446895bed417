#include "tests/core/trace/VeachPlates.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <memory>
#include <utility>

namespace patina::test {
namespace {

constexpr std::array<float, kPlates> kRoughness{0.1f, 0.17f, 0.25f, 0.35f};
constexpr std::array<float, kPlateLights> kRadii{0.033f, 0.1f, 0.3f, 0.9f};
constexpr float kHalfWidth = 3.6f, kHalfDepth = 0.5f;

// The lights stand in a row along x through the origin.
float lightX(int light) {
    return -3.75f + 2.5f * static_cast<float>(light);
}

// Of a plate that shows the middle of the row in its own middle.
struct Plate {
    glm::vec3 centre, normal, back; // back: unit, away from the camera along the plate
};
Plate plateAt(int plate) {
    const glm::vec3 eye = ofVeachPlates().camera.position();
    Plate result;
    result.centre = {0.0f, -2.4f - 0.45f * static_cast<float>(plate),
                     1.25f * static_cast<float>(plate)};
    result.normal =
        glm::normalize(glm::normalize(eye - result.centre) + glm::normalize(-result.centre));
    result.back = glm::cross(result.normal, glm::vec3(1, 0, 0));
    return result;
}

} // namespace

TraceView ofVeachPlates() {
    TraceView view;
    view.width = 64;
    view.height = 40;
    view.camera = {{0.0f, -2.9f, 2.0f}, 0.0f, 20.0f, 14.0f, 20.0f};
    return view;
}

TraceInputs veachPlates() {
    TraceInputs inputs;
    for (int p = 0; p < kPlates; ++p) {
        const Plate plate = plateAt(p);
        Mesh mesh;
        for (const glm::vec2 at :
             {glm::vec2(-1, -1), glm::vec2(1, -1), glm::vec2(1, 1), glm::vec2(-1, 1)}) {
            mesh.positions.push_back(plate.centre + at.x * kHalfWidth * glm::vec3(1, 0, 0) +
                                     at.y * kHalfDepth * plate.back);
            mesh.normals.push_back(plate.normal);
            mesh.tangents.emplace_back(1, 0, 0, 1);
            mesh.uvs.push_back(0.5f * at + 0.5f);
        }
        mesh.indices = {0, 1, 2, 0, 2, 3};
        Material& metal = inputs.materials.emplace_back();
        metal.baseColor = glm::vec3(0.7f);
        metal.metallic = 1.0f;
        metal.doubleSided = true;
        metal.perceptualRoughness = kRoughness[static_cast<std::size_t>(p)];
        inputs.meshes.push_back({static_cast<Id>(p + 1),
                                 std::make_shared<const Mesh>(std::move(mesh)), glm::mat4(1.0f),
                                 static_cast<std::size_t>(p)});
    }
    for (int i = 0; i < kPlateLights; ++i) {
        Light& light = inputs.lights.emplace_back();
        light.type = LightType::Sphere;
        light.position = {lightX(i), 0.0f, 0.0f};
        light.radius = kRadii[static_cast<std::size_t>(i)];
        light.intensity = 1.0f / (light.radius * light.radius);
    }
    return inputs;
}

std::vector<std::optional<int>> plateCells() {
    const TraceView view = ofVeachPlates();
    const glm::vec3 eye = view.camera.position();
    const float tangent = std::tan(0.5f * glm::radians(view.camera.fovDeg));
    std::vector<std::optional<int>> cells;
    for (int y = 0; y < view.height; ++y)
        for (int x = 0; x < view.width; ++x) {
            const auto across =
                static_cast<float>(2 * x + 1 - view.width) / static_cast<float>(view.height);
            const auto up =
                static_cast<float>(view.height - 2 * y - 1) / static_cast<float>(view.height);
            const glm::vec3 direction =
                view.camera.forward() +
                tangent * (across * view.camera.right() + up * view.camera.up());
            std::optional<int>& cell = cells.emplace_back();
            for (int p = 0; p < kPlates; ++p) {
                const Plate plate = plateAt(p);
                const float distance =
                    glm::dot(plate.centre - eye, plate.normal) / glm::dot(direction, plate.normal);
                const glm::vec3 at = eye + distance * direction;
                if (std::abs(at.x) > kHalfWidth ||
                    std::abs(glm::dot(at - plate.centre, plate.back)) > kHalfDepth)
                    continue;
                // A light's reflection lies as far towards it as the way to it is long.
                const float there = glm::length(plate.centre),
                            here = glm::length(eye - plate.centre);
                const float seenAt = at.x * (here + there) / here;
                const int light = static_cast<int>(std::floor((seenAt + 5.0f) / 2.5f));
                cell = p * kPlateLights + std::min(std::max(light, 0), kPlateLights - 1);
            }
        }
    return cells;
}

} // namespace patina::test
