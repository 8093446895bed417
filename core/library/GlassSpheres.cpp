// Spheres that light goes through and that mirror it, on a checkered floor under a lamp: the scene
// that ray tracing has been shown with since Whitted 1980.
#include "core/library/Meshes.h"
#include "core/material/Material.h"

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <utility>

namespace patina::library {
namespace {

constexpr int kSegments = 192, kRings = 96; // smooth enough that refraction shows no facets

Mesh ballAt(float radius, const glm::vec3& centre, int segments = kSegments, int rings = kRings) {
    Mesh mesh = makeSphere(segments, rings); // radius 0.5 m, standing on y = 0
    for (glm::vec3& position : mesh.positions)
        position = 2.0f * radius * (position - glm::vec3(0.0f, 0.5f, 0.0f)) + centre;
    return mesh;
}

// The wall of a hollow: its front faces the hollow, its back the glass.
Mesh insideOut(Mesh mesh) {
    for (glm::vec3& normal : mesh.normals)
        normal = -normal;
    for (glm::vec2& uv : mesh.uvs)
        uv.x = 1.0f - uv.x; // seen from the hollow no letter is mirrored
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
        std::swap(mesh.indices[i + 1], mesh.indices[i + 2]);
    return mesh;
}

// Parts of one material share its unit square: a half each.
Mesh inHalf(Mesh mesh, float left) {
    for (glm::vec2& uv : mesh.uvs)
        uv.x = left + 0.01f + 0.48f * uv.x;
    return mesh;
}

// Every second field of a board of 10 × 10, each 0.2 m wide.
Mesh boardFields(int odd) {
    constexpr int kFields = 10;
    constexpr float kWidth = 0.2f, kMargin = 0.005f;
    Mesh mesh;
    for (int row = 0; row < kFields; ++row)
        for (int column = (row + odd) % 2; column < kFields; column += 2) {
            const auto start = static_cast<std::uint32_t>(mesh.positions.size());
            for (const glm::vec2 corner : {glm::vec2(0.0f, 1.0f), glm::vec2(1.0f, 1.0f),
                                           glm::vec2(1.0f, 0.0f), glm::vec2(0.0f, 0.0f)}) {
                const glm::vec2 field(column, row);
                const glm::vec2 at = kWidth * (field + corner - 0.5f * kFields);
                mesh.positions.emplace_back(at.x, 0.0f, at.y);
                mesh.normals.emplace_back(0.0f, 1.0f, 0.0f);
                mesh.uvs.push_back((field + kMargin + (1.0f - 2.0f * kMargin) * corner) /
                                   static_cast<float>(kFields));
            }
            mesh.indices.insert(mesh.indices.end(),
                                {start, start + 1, start + 2, start, start + 2, start + 3});
        }
    return mesh;
}

Material named(const char* name, const glm::vec3& color, float perceptualRoughness) {
    Material m;
    m.name = name;
    m.baseColor = color;
    m.perceptualRoughness = perceptualRoughness;
    return m;
}

Material glassNamed(const char* name, const glm::vec3& color) {
    Material m = named(name, color, 0.0f);
    m.transmission = 1.0f;
    m.thinWalled = false;
    return m;
}

} // namespace

std::vector<ModelPart> glassSpheres() {
    Material mirror = named("Mirror", glm::vec3(0.95f), 0.0f);
    mirror.metallic = 1.0f;
    const Material clear = glassNamed("Clear Glass", glm::vec3(1.0f));
    Material colored = glassNamed("Coloured Glass", {0.72f, 0.95f, 0.88f});
    colored.attenuationColor = {0.25f, 0.75f, 0.6f};
    colored.attenuationDistance = 0.4f;
    Material lamp = named("Lamp", glm::vec3(0.8f), 1.0f);
    lamp.emissive = {1.0f, 0.93f, 0.82f};
    lamp.emissiveStrength = 25.0f;

    // A millimetre above the floor, so that no two surfaces lie in one place.
    constexpr float kGap = 0.001f;
    const glm::vec3 hollow(0.3f, 0.42f + kGap, -0.2f);
    return {
        makePart("Light Fields", boardFields(0), named("Light Fields", glm::vec3(0.75f), 0.6f)),
        makePart("Dark Fields", boardFields(1), named("Dark Fields", {0.12f, 0.05f, 0.04f}, 0.6f)),
        makePart("Mirror Sphere", ballAt(0.36f, {-0.5f, 0.36f + kGap, -0.25f}), mirror),
        makePart("Hollow Sphere, Outside", inHalf(ballAt(0.42f, hollow), 0.0f), clear),
        makePart("Hollow Sphere, Inside", inHalf(insideOut(ballAt(0.36f, hollow)), 0.5f), clear),
        makePart("Coloured Sphere", ballAt(0.24f, {0.1f, 0.24f + kGap, 0.55f}), colored),
        makePart("Lamp", ballAt(0.14f, {-0.3f, 1.0f, -0.75f}, 48, 24), lamp)};
}

} // namespace patina::library
