#include "core/rank/SweepPixels.h"

#include "core/bake/document/DocumentBakeInputs.h"
#include "core/bake/document/TransferPoint.h"
#include "core/base/Check.h"
#include "core/document/Lighting.h"
#include "core/job/Parallel.h"
#include "core/light/Light.h"
#include "core/math/SphericalHarmonics.h"
#include "core/mix/LightMix.h"
#include "core/mix/TransferLight.h"
#include "core/trace/BakeScene.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>
#include <optional>
#include <utility>

namespace patina {
namespace {

constexpr int kMostLayers = 64; // of single-sided backs in front of what is seen

// What one pixel shows.
struct SeenPoint {
    std::uint32_t place;
    unsigned mesh, triangle;
    float u, v;
    glm::vec3 position; // world
};

Error sweepCancelled() {
    return {ErrorKind::Cancelled, "cancelled", {}, {}};
}

// Casts one ray per pixel. Backs of single-sided surfaces are looked through, as pictures do.
class PixelCaster {
  public:
    PixelCaster(const BakeScene& scene, const Camera& camera, int width, int height)
        : m_scene(scene)
        , m_camera(camera)
        , m_width(width)
        , m_height(height) {
        const BakeGeometry& geometry = *scene.geometry;
        m_origin =
            glm::vec3((glm::dvec3(camera.position()) - geometry.centre) * geometry.unitsPerMetre);
        m_up = std::tan(0.5f * glm::radians(camera.fovDeg)) * camera.up();
        m_right = std::tan(0.5f * glm::radians(camera.fovDeg)) * static_cast<float>(width) /
                  static_cast<float>(height) * camera.right();
    }

    [[nodiscard]] std::vector<SeenPoint> row(int y) const {
        std::vector<ClosestRay> rays(static_cast<std::size_t>(m_width));
        for (int x = 0; x < m_width; ++x) {
            OcclusionRay& ray = rays[static_cast<std::size_t>(x)].ray;
            ray.origin = m_origin;
            ray.direction = direction(x, y);
        }
        std::vector<SeenPoint> seen;
        for (int x = 0; x < m_width; ++x) {
            ClosestRay& ray = rays[static_cast<std::size_t>(x)];
            m_scene.rays.intersect({&ray, 1});
            for (int layer = 0; layer < kMostLayers && isBack(ray); ++layer) {
                ClosestRay next;
                next.ray.origin = m_origin;
                next.ray.direction = ray.ray.direction;
                next.ray.minDistance =
                    ray.ray.maxDistance + std::max(kRayOffset, 1e-6f * ray.ray.maxDistance);
                ray = next;
                m_scene.rays.intersect({&ray, 1});
            }
            if (ray.mesh == ClosestRay::kNothing || isBack(ray))
                continue;
            const glm::vec3 at = m_origin + ray.ray.maxDistance * ray.ray.direction;
            seen.push_back({static_cast<std::uint32_t>(y * m_width + x), ray.mesh, ray.triangle,
                            ray.u, ray.v,
                            glm::vec3(glm::dvec3(at) / m_scene.geometry->unitsPerMetre +
                                      m_scene.geometry->centre)});
        }
        return seen;
    }

  private:
    [[nodiscard]] glm::vec3 direction(int x, int y) const {
        const float right =
            2.0f * (static_cast<float>(x) + 0.5f) / static_cast<float>(m_width) - 1.0f;
        const float up =
            1.0f - 2.0f * (static_cast<float>(y) + 0.5f) / static_cast<float>(m_height);
        return glm::normalize(m_camera.forward() + right * m_right + up * m_up);
    }
    [[nodiscard]] bool isBack(const ClosestRay& ray) const {
        if (ray.mesh == ClosestRay::kNothing)
            return false;
        const BakeGeometryMesh& mesh = m_scene.geometry->meshes[ray.mesh];
        if (mesh.doubleSided)
            return false;
        const std::uint32_t* index = mesh.mesh->indices.data() + 3 * std::size_t{ray.triangle};
        const glm::vec3 &a = mesh.positions[index[0]], &b = mesh.positions[index[1]],
                        &c = mesh.positions[index[2]];
        return mesh.winding * glm::dot(glm::cross(b - a, c - a), ray.ray.direction) > 0.0f;
    }

    const BakeScene& m_scene;
    const Camera& m_camera;
    int m_width, m_height;
    glm::vec3 m_origin, m_right, m_up;
};

// Diffuse albedo of a mesh at a point of it.
class MeshAlbedo {
  public:
    explicit MeshAlbedo(const BakeGeometryMesh& mesh)
        : m_mesh(*mesh.mesh)
        , m_albedo(mesh.surface) {
        if (hasAlbedoMap(mesh.surface) && m_mesh.uvs.size() == m_mesh.positions.size())
            m_texels.emplace(mesh.surface);
    }
    [[nodiscard]] glm::vec3 at(const SeenPoint& point, const glm::vec3& weights) const {
        if (!m_texels)
            return m_albedo.uniform();
        const std::uint32_t* index = m_mesh.indices.data() + 3 * std::size_t{point.triangle};
        return m_albedo.of(m_texels->at(weights.x * m_mesh.uvs[index[0]] +
                                        weights.y * m_mesh.uvs[index[1]] +
                                        weights.z * m_mesh.uvs[index[2]]));
    }

  private:
    const Mesh& m_mesh;
    DiffuseAlbedo m_albedo;
    std::optional<AlbedoTexels> m_texels;
};

// T_i of an open surface: A_l / π Y_i(n).
PointTransfer unshadowedTransfer(const BakeGeometryMesh& mesh, const SeenPoint& point,
                                 const glm::vec3& weights) {
    const std::uint32_t* index = mesh.mesh->indices.data() + 3 * std::size_t{point.triangle};
    const glm::vec3 normal =
        glm::normalize(weights.x * mesh.normals[index[0]] + weights.y * mesh.normals[index[1]] +
                       weights.z * mesh.normals[index[2]]);
    PointTransfer transfer{kUnshadowedOrder,
                           std::vector<float>(static_cast<std::size_t>(shCount(kUnshadowedOrder))),
                           {}};
    evaluateSh(kUnshadowedOrder, normal, std::span(transfer.direct));
    for (int l = 0; l < kUnshadowedOrder; ++l)
        for (int m = -l; m <= l; ++m)
            transfer.direct[static_cast<std::size_t>(shIndex(l, m))] *=
                static_cast<float>(cosineConvolution(l) / std::numbers::pi);
    return transfer;
}

// The parts of a pixel's light, interleaved until all pixels are known.
struct PixelLight {
    bool reflects = false;
    std::vector<glm::vec3> transfer;
    glm::vec3 still{0.0f};
};

void addLights(const Document& document, std::span<const glm::vec3> distant, bool hasNear,
               const SeenPoint& point, int order, PixelLight& pixel) {
    std::vector<glm::vec3> light(distant.begin(), distant.end());
    if (hasNear)
        addNearLights(document, point.position, order, light);
    for (std::size_t i = 0; i < light.size(); ++i)
        pixel.still += light[i] * pixel.transfer[i];
}

SweepPixels toPlanes(const std::vector<SeenPoint>& points, const std::vector<PixelLight>& lights,
                     int width, int height, int order) {
    SweepPixels pixels;
    pixels.width = width;
    pixels.height = height;
    pixels.order = order;
    pixels.covered = points.size();
    std::vector<const PixelLight*> kept;
    for (std::size_t p = 0; p < points.size(); ++p)
        if (lights[p].reflects) {
            pixels.places.push_back(points[p].place);
            kept.push_back(&lights[p]);
        }
    const std::size_t count = kept.size(), coefficients = static_cast<std::size_t>(shCount(order));
    pixels.transfer.resize(3 * coefficients * count);
    pixels.still.resize(3 * count);
    for (std::size_t p = 0; p < count; ++p)
        for (glm::length_t c = 0; c < 3; ++c) {
            const auto plane = static_cast<std::size_t>(c);
            pixels.still[plane * count + p] = kept[p]->still[c];
            for (std::size_t i = 0; i < coefficients; ++i)
                pixels.transfer[(3 * i + plane) * count + p] = kept[p]->transfer[i][c];
        }
    return pixels;
}

} // namespace

Result<SweepPixels> traceSweepPixels(const Document& document, const BakeArtifact* bake,
                                     const Camera& camera, int width, int height,
                                     const JobContext& job) {
    CHECK(width > 0 && height > 0);
    const Result<BakeScene> scene = BakeScene::build(bakeInputs(document), job);
    if (!scene)
        return scene.error();

    // What is seen.
    job.setActivity("casting a ray per pixel");
    std::vector<std::vector<SeenPoint>> rows(static_cast<std::size_t>(height));
    const PixelCaster caster(*scene, camera, width, height);
    parallelFor(job, rows.size(), 4, [&](std::size_t begin, std::size_t end) {
        for (std::size_t y = begin; y < end; ++y)
            rows[y] = caster.row(static_cast<int>(y));
    });
    std::vector<SeenPoint> points;
    for (const std::vector<SeenPoint>& row : rows)
        points.insert(points.end(), row.begin(), row.end());

    // Its transfer, and the light that stays.
    const int order = bake != nullptr ? bake->order : kUnshadowedOrder;
    std::vector<glm::vec3> distant(static_cast<std::size_t>(shCount(order)), glm::vec3(0.0f));
    addDistantLights(document, order, distant);
    const std::vector<const Light*> lights = activeLights(document);
    const bool hasNear = std::ranges::any_of(
        lights, [](const Light* light) { return light->type != LightType::Directional; });
    const float weightOfDiffuse = mixWeights(document.view.reflectionMix).x;
    std::vector<MeshAlbedo> albedos;
    albedos.reserve(scene->geometry->meshes.size());
    for (const BakeGeometryMesh& mesh : scene->geometry->meshes)
        albedos.emplace_back(mesh);
    std::vector<PixelLight> seen(points.size());
    std::atomic<unsigned> unknownMesh{ClosestRay::kNothing};
    parallelFor(job, points.size(), 256, [&](std::size_t begin, std::size_t end) {
        for (std::size_t p = begin; p < end; ++p) {
            const SeenPoint& point = points[p];
            const BakeGeometryMesh& mesh = scene->geometry->meshes[point.mesh];
            const glm::vec3 weights(1.0f - point.u - point.v, point.u, point.v);
            const std::optional<PointTransfer> transfer =
                bake != nullptr ? pointTransfer(document, *bake, {mesh.id, point.triangle, weights})
                                : unshadowedTransfer(mesh, point, weights);
            if (!transfer) {
                unknownMesh = point.mesh;
                continue;
            }
            const glm::vec3 albedo = weightOfDiffuse * albedos[point.mesh].at(point, weights);
            PixelLight& pixel = seen[p];
            pixel.reflects = albedo.x > 0.0f || albedo.y > 0.0f || albedo.z > 0.0f;
            for (std::size_t i = 0; i < transfer->direct.size(); ++i)
                pixel.transfer.push_back(albedo * transfer->coefficient(i));
            addLights(document, distant, hasNear, point, order, pixel);
        }
    });
    if (job.cancelled())
        return sweepCancelled();
    if (unknownMesh != ClosestRay::kNothing)
        return Error{ErrorKind::InputBroken,
                     fmt::format("The bake has no radiance transfer of the mesh \"{}\" as it is "
                                 "now; bake the scene anew.",
                                 scene->geometry->meshes[unknownMesh].mesh->name),
                     {},
                     {}};
    SweepPixels pixels = toPlanes(points, seen, width, height, order);
    if (pixels.places.empty())
        return Error{ErrorKind::InputBroken,
                     points.empty()
                         ? "The camera sees no surface; there is nothing to rank lights by. Frame "
                           "the scene."
                         : "All that the camera sees is metal or black, which radiance transfer "
                           "does not light; there is nothing to rank lights by.",
                     {},
                     {}};
    return pixels;
}

void sweepRadiance(const SweepPixels& pixels, std::span<const glm::vec3> light, std::size_t begin,
                   std::size_t end, std::span<float> out) {
    const std::size_t count = pixels.count(), length = end - begin;
    CHECK(light.size() >= static_cast<std::size_t>(shCount(pixels.order)));
    CHECK(begin <= end && end <= count && out.size() >= 3 * length);
    // In pieces whose sums stay in registers and the first-level cache.
    constexpr std::size_t kPiece = 512;
    const auto coefficients = static_cast<std::size_t>(shCount(pixels.order));
    for (std::size_t first = begin; first < end; first += kPiece) {
        const std::size_t piece = std::min(kPiece, end - first);
        for (std::size_t c = 0; c < 3; ++c) {
            float* sum = out.data() + c * length + (first - begin);
            std::copy_n(pixels.still.data() + c * count + first, piece, sum);
            for (std::size_t i = 0; i < coefficients; ++i) {
                const float weight = light[i][static_cast<glm::length_t>(c)];
                const float* transfer = pixels.transfer.data() + (3 * i + c) * count + first;
                for (std::size_t p = 0; p < piece; ++p)
                    sum[p] += weight * transfer[p];
            }
            for (std::size_t p = 0; p < piece; ++p)
                sum[p] = std::max(sum[p], 0.0f);
        }
    }
}

} // namespace patina
