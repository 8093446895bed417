#include "core/radiosity/SceneProblem.h"

#include "core/job/Parallel.h"
#include "core/math/Sampling.h"
#include "core/trace/BakeInputs.h"

#include <algorithm>
#include <atomic>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

namespace patina::radiosity {
namespace {

constexpr std::uint32_t kTexturePoints = 64;
// Of an element of which not one of the points that were looked at is exposed, but perhaps another.
constexpr float kLeastExposed = 1.0f / 256.0f;
// More glowing faces than this are sent rays to by chance, not each of them.
constexpr std::size_t kMaxGlowingFaces = 64;

class Sampler {
  public:
    Sampler(const TraceScene& scene, const ElementMesh& elements,
            const SceneProblemSettings& settings)
        : m_scene(scene)
        , m_elements(elements)
        , m_settings(settings) {
        if (settings.glowByFactors)
            return;
        for (std::uint32_t f = 0; f < elements.faces().size(); ++f)
            if (materialOf(elements.faces()[f]).emits())
                m_glowing.push_back(f);
        if (m_glowing.size() > kMaxGlowingFaces)
            m_glowing.clear(); // by points of emissive triangles
        else
            m_byFaces = true;
    }

    // Means over an element: diffuse albedo, radiance of its own.
    void surface(std::uint32_t element, glm::dvec3& albedo, glm::dvec3& glow) const {
        const Face& face = m_elements.face(element);
        const TraceMaterial& material = materialOf(face);
        albedo = glow = glm::dvec3(0.0);
        const std::uint32_t seed = seedFor(m_settings.seed ^ 0x51f15eedu, element);
        for (std::uint32_t i = 0; i < kTexturePoints; ++i) {
            const glm::dvec2 at = m_elements.samplePoint(element, sobolOwen2D(i, seed));
            const glm::vec2 uv(uvOn(face, at));
            const shading::SurfaceInputs inputs = material.inputsAt(uv);
            albedo += glm::dvec3(inputs.baseColor) * double{1.0f - inputs.metallic} *
                      double{1.0f - inputs.transmission};
            glow += glm::dvec3(material.emissionAt(uv));
        }
        albedo /= double{kTexturePoints};
        glow /= double{kTexturePoints};
    }

    // Mean irradiance of lights and sky on an element.
    [[nodiscard]] glm::dvec3 direct(std::uint32_t element) const {
        glm::dvec3 sum(0.0);
        const auto count = static_cast<std::uint32_t>(m_settings.lightSamples);
        const auto lights = static_cast<std::uint32_t>(m_scene.lights().size());
        const bool byPoints =
            !m_settings.glowByFactors && !m_byFaces && !m_scene.emissive().empty();
        for (const std::uint32_t face : m_glowing)
            sum += ofGlowingFace(element, face);
        if (lights == 0 && !m_scene.hasEnvironment() && !byPoints)
            return sum;
        glm::dvec3 sampled(0.0);
        std::uint32_t points = 0;
        const Face& face = m_elements.face(element);
        const glm::vec3 normal(face.normal);
        const std::uint32_t seed = seedFor(m_settings.seed ^ 0x11a3b5c7u, element);
        for (std::uint32_t i = 0; i < count; ++i) {
            const glm::vec3 from =
                glm::vec3(m_elements.samplePosition(element, sobolOwen2D(i, seed))) +
                kRayOffset * normal;
            if (isBuried(element, glm::dvec3(from)))
                continue;
            ++points;
            for (std::uint32_t l = 0; l < lights; ++l) {
                const LightSample light = m_scene.lights().sample(
                    l, m_scene.toWorld(from), sobolOwen2D(i, seedFor(seed, l + 1)));
                const float cosine = glm::dot(normal, light.direction);
                if (!(cosine > 0.0f) || light.light == glm::vec3(0.0f))
                    continue;
                if (m_scene.lights().isHidden(l) &&
                    m_scene.occluded(from, light.direction, m_scene.sceneUnits(light.distance)))
                    continue;
                sampled += glm::dvec3(light.light) * double{cosine} /
                           (light.pdf > 0.0f ? double{light.pdf} : 1.0);
            }
            if (m_scene.hasEnvironment()) {
                const EnvironmentSampler::Sample sky =
                    m_scene.sampleEnvironment(sobolOwen2D(i, seedFor(seed, 0)));
                const float cosine = glm::dot(normal, sky.direction);
                if (cosine > 0.0f && sky.pdf > 0.0f &&
                    !m_scene.occluded(from, sky.direction, std::numeric_limits<float>::infinity()))
                    sampled += glm::dvec3(sky.radiance) * double{cosine} / double{sky.pdf};
            }
            if (byPoints)
                sampled += ofEmissivePoint(from, normal, i, seed);
        }
        return points > 0 ? sum + sampled / static_cast<double>(points) : sum;
    }

  private:
    [[nodiscard]] bool isBuried(std::uint32_t element, const glm::dvec3& position) const {
        return m_elements.isBuried(element, position, *m_scene.rays());
    }

    [[nodiscard]] const TraceMaterial& materialOf(const Face& face) const {
        return *m_scene.pointAt(face.mesh, face.triangles[0], glm::vec2(1.0f / 3.0f)).material;
    }

    // The face's polygon in closed form, times what pairs of points tell of its radiance and of
    // what is in between (core/radiosity/AnalyticFactors.h).
    [[nodiscard]] glm::dvec3 ofGlowingFace(std::uint32_t element, std::uint32_t faceIndex) const {
        const Face& glowing = m_elements.faces()[faceIndex];
        const Face& face = m_elements.face(element);
        const Polygon polygon = m_elements.polygon(element);
        const double factor =
            exchange(polygon, Polygon({glowing.corners.data(), glowing.cornerCount})) /
            glm::length(areaVector(polygon.points()));
        if (!(factor > 0.0))
            return glm::dvec3(0.0);
        const TraceMaterial& material = materialOf(glowing);
        const std::uint32_t seed = seedFor(m_settings.seed ^ (faceIndex * 0x9e3779b9u), element);
        glm::dvec3 seen(0.0);
        double total = 0.0;
        for (int i = 0; i < m_settings.lightSamples; ++i) {
            const glm::vec4 u = sobolOwen4D(static_cast<std::uint32_t>(i), seed);
            const glm::dvec3 from =
                m_elements.samplePosition(element, {u.x, u.y}) + double{kRayOffset} * face.normal;
            const glm::dvec2 at = glowing.cornerCount == 4
                                      ? glm::dvec2(u.z, u.w)
                                      : glm::dvec2(EmissiveTriangles::point({u.z, u.w}));
            const glm::dvec3 to = positionOn(glowing, at) + double{kRayOffset} * glowing.normal;
            const glm::dvec3 way = to - from;
            const double distance2 = glm::dot(way, way);
            const double cosHere = glm::dot(face.normal, way),
                         cosThere = -glm::dot(glowing.normal, way);
            if (!(cosHere > 0.0 && cosThere > 0.0) || isBuried(element, from))
                continue;
            const double weight =
                cosHere * cosThere / (distance2 * distance2) * stretch(glowing, at);
            total += weight;
            const double distance = std::sqrt(distance2);
            if (m_scene.occluded(glm::vec3(from), glm::vec3(way / distance),
                                 static_cast<float>(distance - 0.5 * double{kRayOffset})))
                continue;
            seen += weight * glm::dvec3(material.emissionAt(glm::vec2(uvOn(glowing, at))));
        }
        if (!(total > 0.0))
            return glm::dvec3(0.0);
        return std::numbers::pi * factor / total * seen;
    }

    // How much area of a quad a piece of its coordinates covers there, relative to others.
    static double stretch(const Face& face, const glm::dvec2& at) {
        if (face.cornerCount == 3)
            return 1.0;
        const std::array<glm::dvec3, 4>& c = face.corners;
        return glm::length(glm::cross(glm::mix(c[1] - c[0], c[2] - c[3], at.y),
                                      glm::mix(c[3] - c[0], c[2] - c[1], at.x)));
    }

    [[nodiscard]] glm::dvec3 ofEmissivePoint(const glm::vec3& from, const glm::vec3& normal,
                                             std::uint32_t i, std::uint32_t seed) const {
        const EmissiveTriangles& emissive = m_scene.emissive();
        const EmissiveTriangles::Triangle& triangle =
            emissive.sample(sobolOwen2D(i, seedFor(seed, ~0u)).x);
        const glm::vec2 weights = EmissiveTriangles::point(sobolOwen2D(i, seedFor(seed, ~0u - 1)));
        TracePoint point = m_scene.pointAt(triangle, weights);
        const glm::vec3 way = point.position - from;
        const float distance2 = glm::dot(way, way);
        if (!(distance2 > 0.0f))
            return glm::dvec3(0.0);
        const float distance = std::sqrt(distance2);
        const glm::vec3 direction = way / distance;
        float cosThere = -glm::dot(point.face, direction);
        if (cosThere < 0.0f) {
            point.isBack = true;
            cosThere = -cosThere;
        }
        const float cosHere = glm::dot(normal, direction);
        const float density = emissive.density(shading::luminance(point.material->emissive()));
        if (!(cosHere > 0.0f && cosThere > 0.0f && density > 0.0f))
            return glm::dvec3(0.0);
        const glm::dvec3 light = glm::dvec3(point.emission() * m_scene.solidShare(point));
        if (light == glm::dvec3(0.0) ||
            m_scene.occluded(from, direction, distance - 2.0f * kRayOffset))
            return glm::dvec3(0.0);
        const double metres2 = double{m_scene.metres(distance)} * double{m_scene.metres(distance)};
        return light * (double{cosHere} * double{cosThere} / (metres2 * double{density}));
    }

    const TraceScene& m_scene;
    const ElementMesh& m_elements;
    const SceneProblemSettings& m_settings;
    std::vector<std::uint32_t> m_glowing; // faces
    bool m_byFaces = false;
};

} // namespace

Result<SceneProblem> SceneProblem::make(const TraceScene& scene, const ElementMesh& elements,
                                        const SceneProblemSettings& settings,
                                        const JobContext& job) {
    SceneProblem result;
    const std::size_t n = elements.size();
    Problem& problem = result.problem;
    for (std::uint32_t e = 0; e < n; ++e)
        problem.areas.push_back(elements.area(e) *
                                double{std::max(elements.exposed(e), kLeastExposed)});
    problem.reflectance.resize(n);
    problem.emission.resize(n);
    result.direct.resize(n);
    result.glow.resize(n);
    std::atomic<std::size_t> clamped{0}, done{0};
    const Sampler sampler(scene, elements, settings);
    parallelFor(job, n, 64, [&](std::size_t begin, std::size_t end) {
        for (std::size_t e = begin; e < end; ++e) {
            if (job.cancelled())
                return;
            const auto element = static_cast<std::uint32_t>(e);
            glm::dvec3 albedo, glow;
            sampler.surface(element, albedo, glow);
            problem.reflectance[e] = glm::min(albedo, glm::dvec3(kMaxReflectance));
            if (albedo != problem.reflectance[e])
                ++clamped;
            result.direct[e] = sampler.direct(element);
            result.glow[e] = std::numbers::pi * glow;
            problem.emission[e] = problem.reflectance[e] * result.direct[e];
            if (settings.glowByFactors)
                problem.emission[e] += result.glow[e];
        }
        done += end - begin;
        job.setProgress(static_cast<double>(done) / static_cast<double>(n));
    });
    if (job.cancelled())
        return bakeCancelled();
    result.clamped = clamped;
    return result;
}

} // namespace patina::radiosity
