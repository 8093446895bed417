#include "tests/reference/ReferenceScene.h"

#include "core/bake/document/DocumentBakeInputs.h"
#include "core/material/MapUv.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace patina::reference {
namespace {

// Far above the rounding of positions (6e-8), far below what can be seen.
constexpr double kClear = 1e-5;

double factor(const MapSlot& map, const glm::vec2& uv, int channel) {
    if (map.image == nullptr)
        return 1.0;
    const glm::vec2 at = mapUv(map, uv);
    return sampleBilinear(*map.image, at.x, at.y)[channel];
}

int channelOf(const MapSlot& map) {
    return map.channel == MapChannel::Rgb ? 0 : static_cast<int>(map.channel) - 1;
}

glm::dvec3 albedoAt(const BakeSurface& surface, const glm::vec2& uv) {
    const double metallic =
        surface.metallic * factor(surface.metallicMap, uv, channelOf(surface.metallicMap));
    glm::dvec3 albedo;
    for (int c = 0; c < 3; ++c)
        albedo[c] =
            std::clamp(surface.baseColor[c] * factor(surface.baseColorMap, uv, c), 0.0, 1.0);
    return albedo * (1.0 - std::clamp(metallic, 0.0, 1.0));
}

} // namespace

ReferenceScene::ReferenceScene(BakeInputs inputs, std::unique_ptr<BakeGeometry> geometry,
                               RayScene rays)
    : m_inputs(std::move(inputs))
    , m_geometry(std::move(geometry))
    , m_rays(std::move(rays)) {}

Result<ReferenceScene> ReferenceScene::create(const Document& document) {
    BakeInputs inputs = bakeInputs(document);
    Result<BakeGeometry> geometry = makeBakeGeometry(inputs, {});
    if (!geometry)
        return geometry.error();
    auto kept = std::make_unique<BakeGeometry>(*std::move(geometry));
    Result<RayScene> rays = RayScene::build(*kept, {});
    if (!rays)
        return rays.error();
    return ReferenceScene(std::move(inputs), std::move(kept), *std::move(rays));
}

std::vector<std::optional<Place>> ReferenceScene::look(const Camera& camera, int width,
                                                       int height) const {
    const double tangent = std::tan(0.5 * glm::radians(double(camera.fovDeg)));
    const glm::dvec3 eye =
        (glm::dvec3(camera.position()) - m_geometry->centre) * m_geometry->unitsPerMetre;
    std::vector<std::optional<Place>> places;
    for (int y = 0; y < height; ++y) {
        std::vector<ClosestRay> rays;
        for (int x = 0; x < width; ++x) {
            const double right = tangent * (2 * (x + 0.5) - width) / height;
            const double up = tangent * (1 - 2 * (y + 0.5) / height);
            ClosestRay& ray = rays.emplace_back();
            ray.ray.origin = glm::vec3(eye);
            ray.ray.direction = glm::vec3(glm::normalize(glm::dvec3(camera.forward()) +
                                                         right * glm::dvec3(camera.right()) +
                                                         up * glm::dvec3(camera.up())));
        }
        intersect(rays);
        for (const ClosestRay& ray : rays)
            places.push_back(place(ray));
    }
    return places;
}

void ReferenceScene::intersect(std::span<ClosestRay> rays) const {
    (void)m_rays.intersect(rays);
}

std::optional<Place> ReferenceScene::place(const ClosestRay& ray) const {
    if (ray.mesh == ClosestRay::kNothing)
        return std::nullopt;
    const BakeGeometryMesh& mesh = m_geometry->meshes[ray.mesh];
    const std::uint32_t* corner = mesh.mesh->indices.data() + std::size_t{3} * ray.triangle;
    const double weight[3] = {1.0 - double(ray.u) - double(ray.v), ray.u, ray.v};
    Place place;
    place.mesh = ray.mesh;
    place.triangle = ray.triangle;
    place.b1 = ray.u;
    place.b2 = ray.v;
    glm::vec2 uv(0.0f);
    for (int i = 0; i < 3; ++i) {
        place.position += weight[i] * glm::dvec3(mesh.positions[corner[i]]);
        place.normal += weight[i] * glm::dvec3(mesh.normals[corner[i]]);
        if (!mesh.mesh->uvs.empty())
            uv += float(weight[i]) * mesh.mesh->uvs[corner[i]];
    }
    place.normal = glm::normalize(place.normal);
    const glm::dvec3 a(mesh.positions[corner[0]]), b(mesh.positions[corner[1]]),
        c(mesh.positions[corner[2]]);
    place.face = glm::normalize(glm::cross(b - a, c - a));
    if (glm::dot(place.face, place.normal) < 0.0)
        place.face = -place.face;
    if (glm::dot(place.face, glm::dvec3(ray.ray.direction)) > 0.0) { // from behind
        if (!mesh.doubleSided)
            return std::nullopt;
        place.face = -place.face;
        place.normal = -place.normal;
    }
    place.albedo = albedoAt(mesh.surface, uv);
    return place;
}

ClosestRay ReferenceScene::rayFrom(const Place& from, const glm::dvec3& direction) {
    ClosestRay ray;
    ray.ray.origin = glm::vec3(from.position + kClear * from.face);
    ray.ray.direction = glm::vec3(direction);
    return ray;
}

} // namespace patina::reference
