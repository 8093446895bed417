#include "tests/core/radiosity/RadiosityScenes.h"

#include "tests/core/trace/TraceBall.h"

#include <gtest/gtest.h>
#include <numbers>
#include <utility>

namespace patina::test {

using namespace radiosity;

namespace {

Material lambert(const glm::vec3& reflectance, float emission) {
    Material material;
    material.baseColor = reflectance;
    material.emissive = glm::vec3(emission / std::numbers::pi_v<float>);
    return material;
}

} // namespace

TraceInputs sceneOf(const std::vector<Wall>& walls) {
    TraceInputs inputs;
    for (const Wall& wall : walls) {
        Mesh mesh;
        const glm::vec3 normal = glm::normalize(
            glm::cross(wall.corners[1] - wall.corners[0], wall.corners[2] - wall.corners[0]));
        for (std::size_t k = 0; k < 4; ++k) {
            mesh.positions.push_back(wall.corners[k]);
            mesh.normals.push_back(normal);
            mesh.tangents.emplace_back(1, 0, 0, 1);
            mesh.uvs.emplace_back(k == 1 || k == 2 ? 1.0f : 0.0f, k >= 2 ? 1.0f : 0.0f);
        }
        mesh.indices = {0, 1, 2, 0, 2, 3};
        inputs.materials.push_back(lambert(wall.reflectance, wall.emission));
        inputs.materials.back().doubleSided = wall.twoSided;
        inputs.meshes.push_back({static_cast<Id>(inputs.meshes.size() + 1),
                                 std::make_shared<const Mesh>(std::move(mesh)), glm::mat4(1.0f),
                                 inputs.materials.size() - 1});
    }
    return inputs;
}

std::vector<Wall> unitCube(float reflectance) {
    const glm::vec3 rho(reflectance);
    return {{{{{0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}}}, rho, 1.0f},
            {{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}}, rho},
            {{{{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}}}, rho},
            {{{{1, 0, 0}, {1, 0, 1}, {1, 1, 1}, {1, 1, 0}}}, rho},
            // The two that remain, in the order that the truth is given in.
            {{{{0, 0, 0}, {0, 0, 1}, {1, 0, 1}, {1, 0, 0}}}, rho},
            {{{{0, 1, 0}, {1, 1, 0}, {1, 1, 1}, {0, 1, 1}}}, rho}};
}

TraceMesh facetedBall(int rings, float radius, bool inside, std::size_t material) {
    Mesh mesh = *ball(rings);
    for (glm::vec3& position : mesh.positions)
        position *= radius;
    if (inside)
        for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
            std::swap(mesh.indices[i + 1], mesh.indices[i + 2]);
    return {static_cast<Id>(material + 1), std::make_shared<const Mesh>(std::move(mesh)),
            glm::mat4(1.0f), material};
}

std::unique_ptr<FormFactors> DividedScene::factors(const FactorSettings& settings) const {
    auto made = makeFormFactors(elements, *scene.rays(), settings);
    EXPECT_TRUE(made) << made.error().text();
    return *std::move(made);
}

std::unique_ptr<DividedScene> divided(const TraceInputs& inputs, const ElementLimits& limits,
                                      const SceneProblemSettings& light) {
    auto scene = TraceScene::build(inputs, {});
    EXPECT_TRUE(scene) << scene.error().text();
    auto elements = ElementMesh::make(*scene->geometry(), limits);
    EXPECT_TRUE(elements) << elements.error().text();
    elements->findBuried(*scene->rays(), {});
    auto lit = SceneProblem::make(*scene, *elements, light, {});
    EXPECT_TRUE(lit) << lit.error().text();
    return std::make_unique<DividedScene>(
        DividedScene{std::move(*scene), std::move(*elements), std::move(*lit)});
}

} // namespace patina::test
