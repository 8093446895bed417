#include "tests/core/trace/GlassScenes.h"

#include "core/math/Sampling.h"
#include "core/trace/path/PathTracer.h"
#include "tests/core/trace/TraceBall.h"

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <memory>
#include <numbers>
#include <optional>
#include <utility>

namespace patina::test {

using std::numbers::pi;

namespace {

// Two triangles; corners counter-clockwise from the front.
void addQuad(Mesh& mesh, const std::array<glm::vec3, 4>& corners) {
    const auto start = static_cast<std::uint32_t>(mesh.positions.size());
    const glm::vec3 normal =
        glm::normalize(glm::cross(corners[1] - corners[0], corners[2] - corners[0]));
    for (const glm::vec3& corner : corners) {
        mesh.positions.push_back(corner);
        mesh.normals.push_back(normal);
        mesh.uvs.emplace_back(0.0f);
        mesh.tangents.emplace_back(glm::normalize(corners[1] - corners[0]), 1.0f);
    }
    for (const std::uint32_t i : {0u, 1u, 2u, 0u, 2u, 3u})
        mesh.indices.push_back(start + i);
}

TraceInputs of(Mesh mesh, const Material& material, const TraceEnvironment& environment) {
    TraceInputs inputs;
    inputs.materials = {material};
    inputs.meshes = {{1, std::make_shared<const Mesh>(std::move(mesh)), glm::mat4(1.0f), 0}};
    inputs.environments = {environment};
    return inputs;
}

MeshPtr insideOut(const MeshPtr& mesh) {
    Mesh turned = *mesh;
    for (glm::vec3& normal : turned.normals)
        normal = -normal;
    for (std::size_t i = 0; i < turned.indices.size(); i += 3)
        std::swap(turned.indices[i], turned.indices[i + 1]);
    return std::make_shared<const Mesh>(std::move(turned));
}

glm::mat4 placed(float size, float height) {
    glm::mat4 transform(size);
    transform[3] = {0.0f, height, 0.0f, 1.0f};
    return transform;
}

} // namespace

double fresnel(double cosine, double eta) {
    const double sine = std::sqrt(1.0 - cosine * cosine) / eta;
    if (sine >= 1.0)
        return 1.0;
    if (cosine > 1.0 - 1e-9)
        return (eta - 1.0) * (eta - 1.0) / ((eta + 1.0) * (eta + 1.0));
    const double i = std::acos(cosine), t = std::asin(sine);
    const double s = std::sin(i - t) / std::sin(i + t), p = std::tan(i - t) / std::tan(i + t);
    return 0.5 * (s * s + p * p);
}

Material glass(float ior, bool thinWalled) {
    Material material;
    material.baseColor = glm::vec3(1.0f);
    material.perceptualRoughness = 0.0f;
    material.transmission = 1.0f;
    material.ior = ior;
    material.thinWalled = thinWalled;
    return material;
}

TraceEnvironment lowerSky(float radiance) {
    Image image(8, 64, 3, PixelType::F32, ColorEncoding::Linear);
    for (std::size_t i = image.f32().size() / 2; i < image.f32().size(); ++i)
        image.f32()[i] = radiance;
    return {std::make_shared<const Image>(std::move(image)), 0.0f, glm::vec3(1.0f)};
}

TraceEnvironment checkeredSky() {
    Image image(16, 8, 3, PixelType::F32, ColorEncoding::Linear);
    for (std::size_t i = 0; i < image.f32().size(); ++i)
        image.f32()[i] = i % 5 == 0 ? 2.0f : 0.25f;
    return {std::make_shared<const Image>(std::move(image)), 20.0f, glm::vec3(1.0f)};
}

TraceInputs slab(const Material& material, const TraceEnvironment& environment) {
    const float w = 40.0f, h = static_cast<float>(kSlabThickness / 2);
    Mesh mesh;
    addQuad(mesh, {{{-w, h, w}, {w, h, w}, {w, h, -w}, {-w, h, -w}}});
    addQuad(mesh, {{{-w, -h, -w}, {w, -h, -w}, {w, -h, w}, {-w, -h, w}}});
    return of(std::move(mesh), material, environment);
}

TraceInputs sheet(const Material& material, const TraceEnvironment& environment) {
    const float w = 20.0f;
    Mesh mesh;
    addQuad(mesh, {{{-w, 0, w}, {w, 0, w}, {w, 0, -w}, {-w, 0, -w}}});
    return of(std::move(mesh), material, environment);
}

TraceInputs hollowSphere(const Material& material, float inner, int rings) {
    TraceInputs inputs;
    inputs.materials = {material};
    inputs.meshes = {{1, ball(rings), glm::mat4(1.0f), 0}};
    if (inner > 0.0f)
        inputs.meshes.push_back({2, insideOut(ball(rings)), placed(inner, 0.0f), 0});
    inputs.environments = {{uniformSky(1.0f), 0.0f, glm::vec3(1.0f)}};
    return inputs;
}

TraceScene built(const TraceInputs& inputs) {
    // The model's tables are the same for all.
    static const Result<TraceScene> kTables = TraceScene::build({}, {});
    Result<TraceScene> scene = TraceScene::build(inputs, {}, &*kTables);
    EXPECT_TRUE(scene.ok());
    return *std::move(scene);
}

double lookedAt(const TraceScene& scene, float pitchDeg, std::uint32_t samples,
                Film::Pixel* pixel) {
    TraceView view;
    view.width = view.height = 1;
    view.camera.yawDeg = 17.0f;
    view.camera.pitchDeg = pitchDeg;
    view.camera.distance = 2.0f;
    view.camera.fovDeg = 0.2f;
    Film film(1, 1);
    EXPECT_TRUE(tracePaths(scene, view, {}, film, 0, samples, {}).ok());
    EXPECT_EQ(film.invalid(), 0u);
    if (pixel != nullptr)
        *pixel = film.at(0, 0);
    return film.at(0, 0).luminance();
}

TraceInputs CausticScene::inputs() const {
    TraceInputs inputs;
    Material lamp;
    lamp.baseColor = glm::vec3(0.0f);
    lamp.metallic = 1.0f; // black: it reflects nothing
    lamp.emissive = glm::vec3(static_cast<float>(radiance));
    inputs.materials = {glass(static_cast<float>(ior), false), lamp};
    inputs.meshes = {
        {1, ball(96), placed(static_cast<float>(glassRadius), static_cast<float>(glassHeight)), 0},
        {2, ball(48), placed(static_cast<float>(lampRadius), static_cast<float>(lampHeight)), 1}};
    return inputs;
}

// Follows each photon through the ball until it leaves; nothing of it is shared with the tracer.
double CausticScene::photonFlux(std::uint32_t photons) const {
    std::uint32_t state = 1;
    const auto random = [&state] { return (hash32(state++) >> 8) * 0x1p-24; };
    const glm::dvec3 centre(0.0, glassHeight, 0.0);
    // Distance to the glass along a unit vector, the nearer of both beyond `least`.
    const auto meets = [&](const glm::dvec3& from, const glm::dvec3& d,
                           double least) -> std::optional<double> {
        const double b = glm::dot(centre - from, d);
        const double c = glm::dot(centre - from, centre - from) - glassRadius * glassRadius;
        if (b * b < c)
            return std::nullopt;
        const double root = std::sqrt(b * b - c);
        if (b - root > least)
            return b - root;
        return b + root > least ? std::optional(b + root) : std::nullopt;
    };
    std::uint32_t arrived = 0;
    for (std::uint32_t i = 0; i < photons; ++i) {
        // From the part of the lamp that sees some of the glass, by the cosine.
        const double y = 0.2 - 1.2 * random(), phi = 2.0 * pi * random();
        const double r = std::sqrt(1.0 - y * y);
        const glm::dvec3 normal(r * std::cos(phi), y, r * std::sin(phi));
        glm::dvec3 at = glm::dvec3(0.0, lampHeight, 0.0) + lampRadius * normal;
        const double z = 1.0 - 2.0 * random(), turn = 2.0 * pi * random();
        const double s = std::sqrt(1.0 - z * z);
        // A point of the unit sphere around the normal's tip is distributed by the cosine.
        glm::dvec3 d = glm::normalize(
            normal + glm::dvec3(s * std::cos(turn), z, s * std::sin(turn)) * (1.0 - 1e-9));
        std::optional<double> distance = meets(at, d, 0.0);
        if (!distance)
            continue;
        bool inside = false;
        for (int surfaces = 0; surfaces < 64 && distance; ++surfaces) {
            at += *distance * d;
            const glm::dvec3 outward = (at - centre) / glassRadius;
            const glm::dvec3 facing = inside ? -outward : outward;
            const double cosine = -glm::dot(d, facing), eta = inside ? 1.0 / ior : ior;
            if (random() < fresnel(cosine, eta)) {
                d = glm::normalize(d + 2.0 * cosine * facing);
            } else {
                // Along the surface the vector shrinks by the index (Snell), the rest makes it 1.
                const glm::dvec3 along = (d + cosine * facing) / eta;
                d = along - std::sqrt(1.0 - glm::dot(along, along)) * facing;
                inside = !inside;
            }
            distance = inside ? meets(at, d, 1e-9) : std::nullopt;
        }
        if (inside || d.y >= 0.0)
            continue;
        const glm::dvec3 floor = at - at.y / d.y * d;
        if (floor.x * floor.x + floor.z * floor.z < discRadius * discRadius)
            ++arrived;
    }
    const double area = 1.2 * 2.0 * pi * lampRadius * lampRadius;
    return pi * radiance * area * arrived / photons;
}

} // namespace patina::test
