#include "tests/core/trace/WhittedScenes.h"

#include "tests/core/trace/TraceBall.h"

#include <gtest/gtest.h>
#include <memory>
#include <string>
#include <utility>

namespace patina::test {

TraceScene whittedScene(const TraceInputs& inputs) {
    Result<TraceScene> scene = TraceScene::build(inputs, {});
    EXPECT_TRUE(scene.ok()) << (scene.ok() ? std::string() : scene.error().text());
    return *std::move(scene);
}

TraceView viewFrom(float distance, int size) {
    TraceView view;
    view.width = view.height = size;
    view.camera.distance = distance;
    return view;
}

Film whitted(const TraceScene& scene, const TraceView& view, const WhittedSettings& settings,
             std::uint32_t samples) {
    Film film(view.width, view.height);
    EXPECT_TRUE(traceWhitted(scene, view, settings, film, 0, samples, {}).ok());
    return film;
}

MeshPtr floorMesh() {
    Mesh mesh;
    mesh.positions = {{-2, 0, 2}, {2, 0, 2}, {2, 0, -2}, {-2, 0, -2}};
    mesh.normals.assign(4, {0, 1, 0});
    mesh.tangents.assign(4, {1, 0, 0, 1});
    mesh.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    mesh.indices = {0, 1, 2, 0, 2, 3};
    return std::make_shared<const Mesh>(std::move(mesh));
}

TraceInputs floorUnderPoint(float roughness) {
    TraceInputs inputs;
    Material material;
    material.baseColor = {0.6f, 0.4f, 0.2f};
    material.metallic = 0.0f;
    material.perceptualRoughness = roughness;
    inputs.materials = {material};
    inputs.meshes = {{1, floorMesh(), glm::mat4(1.0f), 0}};
    inputs.model.fresnel = Fresnel::Dielectric; // of index 1: no gloss above the diffuse lobe
    inputs.model.ior = 1.0f;
    Light light;
    light.id = 9;
    light.type = LightType::Point;
    light.position = {0.5f, 1.5f, -0.25f};
    light.intensity = 7.0f;
    inputs.lights = {light};
    return inputs;
}

TraceView fromAbove() {
    TraceView view = viewFrom(3.0f);
    view.camera.pitchDeg = 60.0f;
    return view;
}

Material mirror(float reflectance) {
    Material material;
    material.baseColor = glm::vec3(reflectance);
    material.metallic = 1.0f;
    material.perceptualRoughness = 0.0f;
    material.doubleSided = true;
    return material;
}

MeshPtr cubeMesh() {
    Mesh mesh;
    for (int axis = 0; axis < 3; ++axis)
        for (const float side : {-1.0f, 1.0f}) {
            glm::vec3 n(0.0f), u(0.0f), v(0.0f);
            n[axis] = side;
            u[(axis + 1) % 3] = 1.0f;
            v[(axis + 2) % 3] = side; // u × v = n
            const auto first = static_cast<std::uint32_t>(mesh.positions.size());
            for (const glm::vec2 at :
                 {glm::vec2(-1, -1), glm::vec2(1, -1), glm::vec2(1, 1), glm::vec2(-1, 1)}) {
                mesh.positions.push_back(n + at.x * u + at.y * v);
                mesh.normals.push_back(n);
                mesh.tangents.emplace_back(u, 1.0f);
                mesh.uvs.emplace_back(0.5f * at + 0.5f);
            }
            for (const std::uint32_t corner : {0u, 1u, 2u, 0u, 2u, 3u})
                mesh.indices.push_back(first + corner);
        }
    return std::make_shared<const Mesh>(std::move(mesh));
}

Material glass(float ior) {
    Material material;
    material.baseColor = glm::vec3(1.0f);
    material.metallic = 0.0f;
    material.perceptualRoughness = 0.0f;
    material.transmission = 1.0f;
    material.ior = ior;
    material.thinWalled = false;
    return material;
}

TraceInputs variedScene() {
    TraceInputs inputs = ballUnderSky(mirror(0.9f), 0.3f);
    Image sky(16, 8, 3, PixelType::F32, ColorEncoding::Linear);
    for (std::size_t i = 0; i < sky.f32().size(); ++i)
        sky.f32()[i] = 0.1f + 0.37f * static_cast<float>(i % 5);
    inputs.environments = {{std::make_shared<const Image>(sky), 30.0f, glm::vec3(1.0f)}};
    Material rough;
    rough.baseColor = {0.8f, 0.5f, 0.2f};
    rough.metallic = 0.0f;
    Material glow;
    glow.emissive = {2.0f, 4.0f, 6.0f};
    Material green = glass();
    green.attenuationColor = {0.2f, 0.9f, 0.3f};
    green.attenuationDistance = 0.5f;
    inputs.materials.push_back(rough);
    inputs.materials.push_back(glow);
    inputs.materials.push_back(green);
    glm::mat4 clear(0.4f);
    clear[3] = {-0.9f, -0.3f, 0.9f, 1.0f};
    inputs.meshes.push_back({4, ball(16), clear, 3});
    glm::mat4 below(1.0f);
    below[3] = {0.0f, -1.0f, 0.0f, 1.0f};
    inputs.meshes.push_back({2, floorMesh(), below, 1});
    glm::mat4 small(0.3f);
    small[3] = {1.3f, 0.4f, 0.6f, 1.0f};
    inputs.meshes.push_back({3, ball(8), small, 2});
    for (const LightType type : {LightType::Point, LightType::Spot, LightType::Directional,
                                 LightType::Sphere, LightType::Rectangle}) {
        Light light;
        light.id = 10 + static_cast<Id>(type);
        light.castsShadow = type != LightType::Spot;
        light.type = type;
        light.intensity = 2.0f;
        inputs.lights.push_back(light);
    }
    return inputs;
}

TraceView ofVariedScene() {
    TraceView view = viewFrom(4.5f, 20);
    view.camera.target = {0.2f, -0.2f, 0.0f};
    view.camera.pitchDeg = 25.0f;
    return view;
}

std::vector<RayNode> ofKind(const RayTree& tree, RayKind kind) {
    std::vector<RayNode> found;
    for (const RayNode& node : tree.nodes())
        if (node.kind == kind)
            found.push_back(node);
    return found;
}

} // namespace patina::test
