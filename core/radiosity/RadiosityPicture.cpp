#include "core/radiosity/RadiosityPicture.h"

#include "core/job/Parallel.h"
#include "core/math/Sampling.h"
#include "core/trace/BakeInputs.h"
#include "core/trace/path/Eye.h"

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>
#include <utility>

namespace patina::radiosity {
namespace {

constexpr auto kInversePi = static_cast<float>(1.0 / std::numbers::pi);

glm::vec3 diffuseAlbedo(const TracePoint& point) {
    const shading::SurfaceInputs inputs = point.material->inputsAt(point.uv);
    return (1.0f - inputs.metallic) * (1.0f - inputs.transmission) * inputs.baseColor;
}

} // namespace

SeenSolution::SeenSolution(const TraceScene& scene, const ElementMesh& elements,
                           const SceneProblem& lit, const Solution& solution)
    : m_scene(scene)
    , m_elements(elements)
    , m_mesh(litMesh(elements, *scene.geometry(), *scene.rays())) {
    std::vector<glm::dvec3> irradiance;
    for (std::uint32_t e = 0; e < elements.size(); ++e) {
        irradiance.push_back(lit.irradiance(solution, e));
        m_radiosity.emplace_back(lit.radiosity(solution, e));
    }
    m_light = vertexLight(m_mesh, elements, irradiance);
    // Triangles come element after element.
    m_firstTriangle.assign(elements.size() + 1, 0);
    for (const LitMesh::Triangle& triangle : m_mesh.triangles)
        ++m_firstTriangle[triangle.element + 1];
    for (std::size_t e = 0; e < elements.size(); ++e)
        m_firstTriangle[e + 1] += m_firstTriangle[e];
}

glm::vec3 SeenSolution::irradiance(std::uint32_t element, const glm::dvec3& position) const {
    const glm::dvec3 point(m_scene.toWorld(glm::vec3(position)));
    double best = -1e300;
    glm::dvec3 result(0.0);
    for (std::uint32_t t = m_firstTriangle[element]; t < m_firstTriangle[element + 1]; ++t) {
        const LitMesh::Triangle& triangle = m_mesh.triangles[t];
        const auto vertex = [&](std::size_t k) -> const LitMesh::Vertex& {
            return m_mesh.vertices[triangle.vertices[k]];
        };
        const glm::dvec3 corner(vertex(0).position), x = glm::dvec3(vertex(1).position) - corner,
                                                     y = glm::dvec3(vertex(2).position) - corner;
        const glm::dvec3 n = glm::cross(x, y), p = point - corner;
        const double square = glm::dot(n, n);
        if (!(square > 0.0))
            continue;
        const double b = glm::dot(glm::cross(p, y), n) / square,
                     c = glm::dot(glm::cross(x, p), n) / square;
        // The triangle that the point is in, or is nearest to being in.
        const double inside = std::min({1.0 - b - c, b, c});
        if (inside <= best)
            continue;
        best = inside;
        result = (1.0 - b - c) * m_light[vertex(0).light] + b * m_light[vertex(1).light] +
                 c * m_light[vertex(2).light];
    }
    return glm::max(glm::vec3(result), glm::vec3(0.0f));
}

glm::vec3 SeenSolution::gathered(const TracePoint& point, const PictureSettings& settings,
                                 std::uint32_t seed) const {
    const auto count = static_cast<std::uint32_t>(settings.gatherRays);
    // Lights, sky and what glows: rays straight to them.
    Film::Pixel straight;
    PathSettings paths;
    paths.maxBounces = 0;
    paths.seed = seed;
    traceIrradiance(m_scene, glm::dvec3(m_scene.toWorld(point.position)), point.face, paths, count,
                    straight);
    // What surfaces reflect, in the solution.
    thread_local std::vector<ClosestRay> rays;
    rays.assign(count, {});
    glm::vec3 tangent, bitangent;
    orthonormalBasis(point.face, tangent, bitangent);
    const glm::mat3 frame(tangent, bitangent, point.face);
    for (std::uint32_t i = 0; i < count; ++i) {
        rays[i].ray.origin = TraceScene::origin(point);
        rays[i].ray.direction = frame * cosineHemisphere(sobolOwen2D(i, seed));
    }
    m_scene.rays()->intersect(rays);
    glm::vec3 sum(0.0f);
    for (const ClosestRay& ray : rays) {
        const std::uint32_t element = m_elements.met(ray);
        if (element == kNone)
            continue;
        const TracePoint there = m_scene.pointAt(ray);
        sum += diffuseAlbedo(there) * irradiance(element, glm::dvec3(there.position));
    }
    return glm::vec3(straight.sum / static_cast<double>(straight.samples)) +
           sum / static_cast<float>(count);
}

glm::vec3 SeenSolution::radiance(const ClosestRay& ray, const PictureSettings& settings,
                                 std::uint32_t seed) const {
    const std::uint32_t element = m_elements.met(ray);
    if (element == kNone)
        return glm::vec3(0.0f); // a back that only absorbs
    if (settings.look == Look::Elements)
        return kInversePi * m_radiosity[element];
    const TracePoint point = m_scene.pointAt(ray);
    const glm::vec3 light = settings.look == Look::Gathered
                                ? gathered(point, settings, seed)
                                : irradiance(element, glm::dvec3(point.position));
    return point.emission() + kInversePi * diffuseAlbedo(point) * light;
}

ClosestRay SeenSolution::rayTo(const SidePlace& place) const {
    const TracePoint point = m_scene.pointAt(place.mesh, place.triangle, place.weights);
    ClosestRay ray;
    ray.mesh = place.mesh;
    ray.triangle = place.triangle;
    ray.u = place.weights.x;
    ray.v = place.weights.y;
    ray.ray.direction = place.back ? point.face : -point.face;
    return ray;
}

glm::vec3 SeenSolution::radianceAt(const SidePlace& place, const PictureSettings& settings,
                                   std::uint32_t seed) const {
    return radiance(rayTo(place), settings, seed);
}

bool SeenSolution::isBuried(const SidePlace& place) const {
    const ClosestRay ray = rayTo(place);
    const std::uint32_t element = m_elements.met(ray);
    return element != kNone &&
           m_elements.isBuried(element, glm::dvec3(m_scene.pointAt(ray).position), *m_scene.rays());
}

Result<Image> SeenSolution::picture(const TraceView& view, const PictureSettings& settings,
                                    const JobContext& job) const {
    Image image(view.width, view.height, 4, PixelType::F32, ColorEncoding::Linear);
    const Eye eye(m_scene, view);
    const auto samples = static_cast<std::uint32_t>(settings.samples);
    parallelFor(job, static_cast<std::size_t>(view.height), 1, [&](std::size_t row, std::size_t) {
        const FlushDenormals flush;
        const int y = static_cast<int>(row);
        for (int x = 0; x < view.width; ++x) {
            if (job.cancelled())
                return;
            glm::vec4 sum(0.0f);
            const std::uint32_t pixel =
                seedFor(settings.seed, static_cast<std::uint32_t>(y * view.width + x));
            for (std::uint32_t s = 0; s < samples; ++s) {
                const glm::vec3 direction = eye.direction(x, y, sobolOwen2D(s, pixel));
                ClosestRay ray = m_scene.closest(eye.origin(), direction);
                // Backs that only absorb are not there for a camera, as in all other pictures.
                while (ray.mesh != ClosestRay::kNothing && m_elements.met(ray) == kNone) {
                    const TracePoint back = m_scene.pointAt(ray);
                    if (back.hasSurface())
                        break;
                    ray = m_scene.closest(TraceScene::origin(back, true), direction);
                }
                if (ray.mesh != ClosestRay::kNothing)
                    sum += glm::vec4(radiance(ray, settings, seedFor(pixel, s)), 1.0f);
                else if (view.background)
                    sum += glm::vec4(view.background(direction), 0.0f);
                else if (!view.transparent)
                    sum += glm::vec4(m_scene.environmentRadiance(direction), 0.0f);
            }
            float* out = image.f32().data() + 4 * (row * static_cast<std::size_t>(view.width) +
                                                   static_cast<std::size_t>(x));
            for (int c = 0; c < 4; ++c)
                out[c] = sum[c] / static_cast<float>(samples);
        }
        job.setProgress(static_cast<double>(row) / view.height);
    });
    if (job.cancelled())
        return bakeCancelled();
    return image;
}

} // namespace patina::radiosity
