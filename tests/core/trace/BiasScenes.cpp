#include "tests/core/trace/BiasScenes.h"

#include "tests/core/trace/TraceBall.h"

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <memory>
#include <numbers>
#include <utility>

namespace patina::test {
namespace {

using Corners = std::array<glm::vec3, 4>; // counter-clockwise, seen from the front

MeshPtr flat(const std::vector<Corners>& faces) {
    Mesh mesh;
    for (const Corners& face : faces) {
        const glm::vec3 normal = glm::normalize(glm::cross(face[1] - face[0], face[3] - face[0]));
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        for (const glm::vec3& corner : face) {
            mesh.positions.push_back(corner);
            mesh.normals.push_back(normal);
            mesh.tangents.emplace_back(glm::normalize(face[1] - face[0]), 1.0f);
        }
        mesh.uvs.insert(mesh.uvs.end(), {{0, 0}, {1, 0}, {1, 1}, {0, 1}});
        for (const std::uint32_t corner : {0u, 1u, 2u, 0u, 2u, 3u})
            mesh.indices.push_back(first + corner);
    }
    return std::make_shared<const Mesh>(std::move(mesh));
}

// Upright, without a bottom.
std::vector<Corners> block(const glm::vec3& low, const glm::vec3& high) {
    const glm::vec3 &a = low, &b = high;
    return {{{{a.x, b.y, b.z}, {b.x, b.y, b.z}, {b.x, b.y, a.z}, {a.x, b.y, a.z}}},
            {{{a.x, a.y, b.z}, {b.x, a.y, b.z}, {b.x, b.y, b.z}, {a.x, b.y, b.z}}},
            {{{b.x, a.y, a.z}, {a.x, a.y, a.z}, {a.x, b.y, a.z}, {b.x, b.y, a.z}}},
            {{{b.x, a.y, b.z}, {b.x, a.y, a.z}, {b.x, b.y, a.z}, {b.x, b.y, b.z}}},
            {{{a.x, a.y, a.z}, {a.x, a.y, b.z}, {a.x, b.y, b.z}, {a.x, b.y, a.z}}}};
}

Corners floorOf(float half, float y = 0.0f) {
    return {{{-half, y, half}, {half, y, half}, {half, y, -half}, {-half, y, -half}}};
}

Corners turnedOver(const Corners& face) {
    return {{face[3], face[2], face[1], face[0]}};
}

std::size_t add(TraceInputs& inputs, const Material& material, const MeshPtr& mesh,
                const glm::mat4& transform = glm::mat4(1.0f)) {
    inputs.materials.push_back(material);
    inputs.meshes.push_back(
        {static_cast<Id>(inputs.meshes.size() + 1), mesh, transform, inputs.materials.size() - 1});
    return inputs.materials.size() - 1;
}

Material coated(const glm::vec3& color, float metallic, float roughness) {
    Material material;
    material.baseColor = color;
    material.metallic = metallic;
    material.perceptualRoughness = roughness;
    return material;
}

TraceView fromCamera(const Camera& camera) {
    TraceView view;
    view.width = view.height = 64;
    view.camera = camera;
    return view;
}

// Brighter upwards, and not the same all around.
ImagePtr gradient(int width, int height) {
    Image image(width, height, 3, PixelType::F32, ColorEncoding::Linear);
    float* out = image.f32().data();
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const float up = 1.0f - static_cast<float>(y) / static_cast<float>(height);
            const float around = 1.0f + 0.5f * std::sin(6.2831853f * static_cast<float>(x) /
                                                        static_cast<float>(width));
            *out++ = 0.2f + 0.5f * up * around;
            *out++ = 0.2f + 0.7f * up;
            *out++ = 0.3f + 0.9f * up;
        }
    return std::make_shared<const Image>(std::move(image));
}

Light lightOf(LightType type, const glm::vec3& position, float azimuthDeg, float elevationDeg,
              float intensity) {
    Light light;
    light.type = type;
    light.position = position;
    light.azimuthDeg = azimuthDeg;
    light.elevationDeg = elevationDeg;
    light.intensity = intensity;
    return light;
}

} // namespace

BiasScene openRoom() {
    BiasScene scene;
    const std::vector<Corners> box = block({-1.0f, 0.0f, -1.0f}, {1.0f, 1.2f, 1.0f});
    std::vector<Corners> walls{floorOf(1.0f)}; // from inside
    for (std::size_t i = 1; i < box.size(); ++i)
        walls.push_back(turnedOver(box[i]));
    add(scene.inputs, coated({0.8f, 0.7f, 0.5f}, 0.0f, 0.9f), flat(walls));
    add(scene.inputs, coated({0.3f, 0.5f, 0.8f}, 0.0f, 0.6f),
        flat(block({-0.5f, 0.0f, -0.6f}, {0.1f, 0.6f, 0.0f})));
    scene.inputs.environments = {{gradient(16, 8), 40.0f, {1.0f, 0.9f, 0.8f}}};
    scene.view = fromCamera({{0.0f, 0.45f, 0.0f}, 20.0f, 30.0f, 4.0f, 33.0f});
    scene.samples = {16, 16, 16};
    scene.referencePaths = 24;
    return scene;
}

BiasScene glossyBall() {
    BiasScene scene;
    glm::mat4 above(0.7f);
    above[3] = {0.0f, 0.7f, 0.0f, 1.0f};
    add(scene.inputs, coated({0.9f, 0.6f, 0.3f}, 0.5f, 0.4f), ball(12), above);
    add(scene.inputs, coated({0.5f, 0.5f, 0.5f}, 0.0f, 0.5f), flat({floorOf(3.0f)}));
    // One texel is the sun; bilinear lookup spreads it to the centres of its neighbours.
    Image sunny(16, 8, 3, PixelType::F32, ColorEncoding::Linear);
    constexpr int kColumn = 10, kRow = 2;
    for (std::size_t i = 0; i < sunny.f32().size(); ++i)
        sunny.f32()[i] = i / 3 == std::size_t{kRow * 16 + kColumn} ? 12.0f : 0.15f;
    scene.inputs.environments = {
        {std::make_shared<const Image>(std::move(sunny)), 0.0f, {1.0f, 0.9f, 0.7f}},
        {gradient(8, 4), 70.0f, glm::vec3(0.4f)}};
    const double theta = std::numbers::pi * (kRow + 0.5) / 8.0,
                 phi = 2.0 * std::numbers::pi * ((kColumn + 0.5) / 16.0 - 0.5);
    // The corner of the square of two texels is less than a texel's diagonal, 31.8°, away.
    scene.bright = {
        {{std::sin(theta) * std::sin(phi), std::cos(theta), -std::sin(theta) * std::cos(phi)},
         std::cos(glm::radians(32.0))}};
    scene.view = fromCamera({{0.0f, 0.6f, 0.0f}, 20.0f, 25.0f, 3.5f, 35.0f});
    scene.samples = {16, 48, 16};
    scene.referencePaths = 32;
    return scene;
}

BiasScene lightsOverMetal() {
    BiasScene scene;
    add(scene.inputs, coated({0.9f, 0.8f, 0.6f}, 1.0f, 0.55f), flat({floorOf(2.0f)}));
    add(scene.inputs, coated({0.4f, 0.6f, 0.3f}, 0.0f, 0.4f),
        flat(block({-0.3f, 0.0f, -0.4f}, {0.3f, 0.5f, 0.2f})));
    Light sphere = lightOf(LightType::Sphere, {-0.8f, 0.9f, 0.3f}, 0.0f, 0.0f, 4.0f);
    sphere.radius = 0.25f;
    Light rectangle = lightOf(LightType::Rectangle, {0.9f, 0.8f, 0.2f}, -100.0f, 40.0f, 3.0f);
    rectangle.width = 0.8f;
    rectangle.height = 0.3f;
    rectangle.rollDeg = 20.0f;
    rectangle.color = {1.0f, 0.6f, 0.4f};
    Light disc = lightOf(LightType::Directional, {}, 200.0f, 50.0f, 0.7f);
    disc.shadowSoftness = 20.0f;
    Light point = lightOf(LightType::Point, {0.2f, 1.2f, 1.0f}, 0.0f, 0.0f, 0.5f);
    point.range = 4.0f;
    Light spot = lightOf(LightType::Spot, {-1.0f, 1.5f, -1.0f}, -135.0f, 45.0f, 2.0f);
    spot.castsShadow = false;
    spot.color = {0.5f, 0.7f, 1.0f};
    scene.inputs.lights = {sphere, rectangle, disc, point, spot};
    scene.view = fromCamera({{0.0f, 0.1f, 0.0f}, 30.0f, 40.0f, 3.0f, 33.0f});
    scene.samples = {16, 16, 48};
    scene.referencePaths = 16;
    return scene;
}

BiasScene glowAndAlpha() {
    BiasScene scene;
    TraceInputs& inputs = scene.inputs;
    add(inputs, coated({0.7f, 0.7f, 0.7f}, 0.0f, 0.6f), flat({floorOf(2.0f)}));
    // Two columns of two texels: bright and half as bright, both with and without alpha.
    Image picture(2, 2, 4, PixelType::F32, ColorEncoding::Linear);
    const float texels[] = {1,    0.8f, 0.6f, 1, 0.5f, 0.4f, 0.3f, 0,
                            0.5f, 0.4f, 0.3f, 0, 1,    0.8f, 0.6f, 1};
    std::copy(std::begin(texels), std::end(texels), picture.f32().begin());
    const ImagePtr checks = std::make_shared<const Image>(std::move(picture));

    Material cutOut = coated({0.6f, 0.6f, 0.6f}, 0.0f, 0.5f);
    cutOut.doubleSided = true;
    cutOut.alphaMode = AlphaMode::Mask;
    cutOut.baseColorMap.image = cutOut.emissiveMap.image = checks;
    cutOut.emissive = {6.0f, 4.0f, 2.0f};
    add(inputs, cutOut,
        flat({{{{-1.2f, 0.5f, -0.2f},
                {-0.5f, 0.5f, 0.4f},
                {-0.5f, 1.1f, 0.4f},
                {-1.2f, 1.1f, -0.2f}}}}));

    Material veil = coated({0.3f, 0.6f, 0.8f}, 0.0f, 0.7f);
    veil.alphaMode = AlphaMode::Blend;
    veil.opacity = 0.6f;
    veil.emissive = {1.0f, 3.0f, 4.0f};
    add(inputs, veil,
        flat({{{{1.2f, 0.4f, -0.4f},
                {0.6f, 0.4f, -0.9f},
                {0.6f, 0.9f, -0.9f},
                {1.2f, 0.9f, -0.4f}}}}));

    Material glowing = coated(glm::vec3(0.2f), 0.0f, 0.5f);
    glowing.emissive = {3.0f, 3.0f, 5.0f};
    glm::mat4 small(0.3f);
    small[3] = {0.1f, 0.9f, 0.5f, 1.0f};
    add(inputs, glowing, ball(6), small);

    Material sheet = coated({0.9f, 0.3f, 0.2f}, 0.0f, 0.5f);
    sheet.alphaMode = AlphaMode::Blend;
    sheet.opacity = 0.5f;
    sheet.doubleSided = true;
    add(inputs, sheet, flat({floorOf(0.5f, 0.35f)}));
    Light sun = lightOf(LightType::Directional, {}, 30.0f, 60.0f, 1.0f);
    sun.shadowSoftness = 0.0f;
    inputs.lights = {sun};
    scene.view = fromCamera({{0.0f, 0.3f, 0.0f}, 15.0f, 40.0f, 3.4f, 33.0f});
    scene.samples = {24, 24, 64};
    scene.referencePaths = 24;
    return scene;
}

} // namespace patina::test
