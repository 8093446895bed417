#include "core/radiosity/SceneProblem.h"

#include "core/base/Check.h"
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

// Stream of the rays to the sky that go as the surface reflects; no id of a light.
constexpr std::uint32_t kOwnRays = ~0u - 2;

constexpr std::uint32_t kTexturePoints = 64;
// Of an element of which not one of the points that were looked at is exposed, but perhaps another.
constexpr float kLeastExposed = 1.0f / 256.0f;
// More glowing faces than this are sent rays to by chance, not each of them.
constexpr std::size_t kMaxGlowingFaces = 64;

class Sampler {
  public:
    // Without shadows: as if nothing were in between.
    Sampler(const TraceScene& scene, const ElementMesh& elements,
            const SceneProblemSettings& settings, bool shadows = true)
        : m_scene(scene)
        , m_elements(elements)
        , m_settings(settings)
        , m_shadows(shadows) {
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

    // Mean irradiance on an element, of each source alone: as many as there are `sources`.
    void direct(std::uint32_t element, const DirectSources& sources,
                std::span<glm::dvec3> out) const {
        std::ranges::fill(out, glm::dvec3(0.0));
        const std::size_t sky = sources.glow ? 1 : 0, firstLight = sky + (sources.sky ? 1 : 0);
        if (sources.glow)
            for (const std::uint32_t face : m_glowing)
                out[0] += ofGlowingFace(element, face);
        const bool byPoints = sources.glow && !m_byFaces;
        if (sources.lights.empty() && !sources.sky && !byPoints)
            return;
        std::vector<glm::dvec3> sampled(out.size(), glm::dvec3(0.0));
        std::vector<LightSums> lights(sources.lights.size());
        std::uint32_t points = 0;
        const Face& face = m_elements.face(element);
        const glm::vec3 normal(face.normal);
        const std::uint32_t seed = seedFor(m_settings.seed ^ 0x11a3b5c7u, element);
        for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(m_settings.lightSamples); ++i) {
            const glm::vec3 from =
                glm::vec3(m_elements.samplePosition(element, sobolOwen2D(i, seed))) +
                kRayOffset * normal;
            if (isBuried(element, glm::dvec3(from)))
                continue;
            ++points;
            for (std::size_t k = 0; k < sources.lights.size(); ++k)
                lights[k].add(ofLight(sources.lights[k], from, normal, i, seed));
            if (sources.sky)
                sampled[sky] += ofSky(from, normal, i, seed);
            if (byPoints)
                sampled[0] += ofEmissivePoint(from, normal, i, seed);
        }
        for (std::size_t k = 0; k < lights.size(); ++k)
            sampled[firstLight + k] += lights[k].arriving();
        if (points > 0)
            for (std::size_t k = 0; k < out.size(); ++k)
                out[k] += sampled[k] / static_cast<double>(points);
    }

  private:
    [[nodiscard]] bool isBuried(std::uint32_t element, const glm::dvec3& position) const {
        return m_elements.isBuried(element, position, *m_scene.rays());
    }

    [[nodiscard]] bool hides(const glm::vec3& from, const glm::vec3& direction,
                             float distance) const {
        return m_shadows && m_scene.occluded(from, direction, distance);
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
            if (hides(glm::vec3(from), glm::vec3(way / distance),
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

    // Of a light at one point of an element: all of it in closed form, and what a ray tells of the
    // share that nothing hides.
    struct LightAt {
        glm::dvec3 open{0.0};
        double weight = 0.0, seen = 0.0;
    };
    // Heitz, Hill & McGuire 2018, "Combining Analytic Direct Illumination and Stochastic Shadows":
    // where nothing is hidden there is no noise of directions, and none of shadows elsewhere but
    // in penumbras.
    class LightSums {
      public:
        void add(const LightAt& at) {
            m_sum.open += at.open;
            m_sum.weight += at.weight;
            m_sum.seen += at.seen;
        }
        [[nodiscard]] glm::dvec3 arriving() const { // over all points
            return m_sum.weight > 0.0 ? m_sum.open * (m_sum.seen / m_sum.weight) : glm::dvec3(0.0);
        }

      private:
        LightAt m_sum;
    };

    [[nodiscard]] LightAt ofLight(std::uint32_t number, const glm::vec3& from,
                                  const glm::vec3& normal, std::uint32_t i,
                                  std::uint32_t seed) const {
        const LightSampler& lights = m_scene.lights();
        const glm::vec3 world = m_scene.toWorld(from);
        LightAt result;
        result.open = glm::dvec3(lights.irradiance(number, world, normal));
        // By its id: what a light is found to do is the same whichever others there are.
        const LightSample light =
            lights.sample(number, world, sobolOwen2D(i, seedFor(seed, lights.id(number) + 1)));
        const float cosine = glm::dot(normal, light.direction);
        if (!(cosine > 0.0f) || light.light == glm::vec3(0.0f))
            return result;
        // Relative to the other points: by what the ray brings, in any unit.
        result.weight = double{shading::luminance(light.light)} * double{cosine} /
                        (light.pdf > 0.0f ? double{light.pdf} : 1.0);
        if (!lights.isHidden(number) ||
            !hides(from, light.direction, m_scene.sceneUnits(light.distance)))
            result.seen = result.weight;
        return result;
    }

    // Two rays: one to where the sky is bright, one as the surface reflects, weighted by the power
    // heuristic (docs/maths/path-tracing.md).
    [[nodiscard]] glm::dvec3 ofSky(const glm::vec3& from, const glm::vec3& normal, std::uint32_t i,
                                   std::uint32_t seed) const {
        const auto weighed = [](float pdf, float other) {
            return pdf * pdf / (pdf * pdf + other * other);
        };
        const auto open = [&](const glm::vec3& direction) {
            return !hides(from, direction, std::numeric_limits<float>::infinity());
        };
        glm::dvec3 light(0.0);
        const EnvironmentSampler::Sample sky =
            m_scene.sampleEnvironment(sobolOwen2D(i, seedFor(seed, 0)));
        if (const float cosine = glm::dot(normal, sky.direction);
            cosine > 0.0f && sky.pdf > 0.0f && open(sky.direction))
            light += glm::dvec3(sky.radiance *
                                (cosine / sky.pdf * weighed(sky.pdf, cosineHemispherePdf(cosine))));
        glm::vec3 tangent, bitangent;
        orthonormalBasis(normal, tangent, bitangent);
        const glm::vec3 own = cosineHemisphere(sobolOwen2D(i, seedFor(seed, kOwnRays)));
        if (const float pdf = cosineHemispherePdf(own.z); pdf > 0.0f) {
            const glm::vec3 direction =
                glm::normalize(own.x * tangent + own.y * bitangent + own.z * normal);
            const EnvironmentSampler::Lookup met = m_scene.lookUpEnvironment(direction);
            if (const glm::vec3 value = met.radiance * (own.z / pdf * weighed(pdf, met.pdf));
                value != glm::vec3(0.0f) && open(direction))
                light += glm::dvec3(value);
        }
        return light;
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
        if (light == glm::dvec3(0.0) || hides(from, direction, distance - 2.0f * kRayOffset))
            return glm::dvec3(0.0);
        const double metres2 = double{m_scene.metres(distance)} * double{m_scene.metres(distance)};
        return light * (double{cosHere} * double{cosThere} / (metres2 * double{density}));
    }

    const TraceScene& m_scene;
    const ElementMesh& m_elements;
    const SceneProblemSettings& m_settings;
    const bool m_shadows;
    std::vector<std::uint32_t> m_glowing; // faces
    bool m_byFaces = false;
};

// Of every element, on all cores. False: cancelled.
template <class Function>
bool forElements(const ElementMesh& elements, const JobContext& job, const Function& function) {
    std::atomic<std::size_t> done{0};
    parallelFor(job, elements.size(), 64, [&](std::size_t begin, std::size_t end) {
        for (std::size_t e = begin; e < end; ++e) {
            if (job.cancelled())
                return;
            function(static_cast<std::uint32_t>(e));
        }
        done += end - begin;
        job.setProgress(static_cast<double>(done) / static_cast<double>(elements.size()));
    });
    return !job.cancelled();
}

} // namespace

DirectSources directSources(const TraceScene& scene, const SceneProblemSettings& settings) {
    DirectSources sources;
    sources.glow = !settings.glowByFactors && !scene.emissive().empty();
    sources.sky = scene.hasEnvironment();
    for (std::uint32_t l = 0; l < scene.lights().size(); ++l)
        sources.lights.push_back(l);
    return sources;
}

Result<std::vector<std::vector<glm::dvec3>>>
directLight(const TraceScene& scene, const ElementMesh& elements, const DirectSources& sources,
            const SceneProblemSettings& settings, const JobContext& job) {
    std::vector<std::vector<glm::dvec3>> result(sources.size(),
                                                std::vector<glm::dvec3>(elements.size()));
    const Sampler sampler(scene, elements, settings);
    const bool done = forElements(elements, job, [&](std::uint32_t element) {
        std::vector<glm::dvec3> light(sources.size());
        sampler.direct(element, sources, light);
        for (std::size_t k = 0; k < light.size(); ++k)
            result[k][element] = light[k];
    });
    if (!done)
        return bakeCancelled();
    return result;
}

Result<std::vector<double>> partlyHidden(const TraceScene& scene, const ElementMesh& elements,
                                         const SceneProblemSettings& settings,
                                         const JobContext& job) {
    DirectSources sources = directSources(scene, settings);
    sources.sky = false;
    const Sampler shown(scene, elements, settings), all(scene, elements, settings, false);
    std::vector<double> result(elements.size(), 0.0);
    const bool done = forElements(elements, job, [&](std::uint32_t element) {
        std::vector<glm::dvec3> seen(sources.size()), open(sources.size());
        shown.direct(element, sources, seen);
        all.direct(element, sources, open);
        for (std::size_t k = 0; k < seen.size(); ++k)
            result[element] += std::min(magnitude(seen[k]), magnitude(open[k] - seen[k]));
    });
    if (!done)
        return bakeCancelled();
    return result;
}

Result<void> DirectLight::complete(const TraceScene& scene, const ElementMesh& elements,
                                   const SceneProblemSettings& settings, const ElementShard& shard,
                                   const JobContext& job, const std::function<void()>& between) {
    const Sampler sampler(scene, elements, settings);
    const DirectSources sources = directSources(scene, settings);
    const bool done = forElements(elements, job, [&](std::uint32_t element) {
        if (!shard.holds(element) || has(element))
            return;
        std::vector<glm::dvec3> light(sources.size());
        sampler.direct(element, sources, light);
        glm::dvec3 sum(0.0);
        for (const glm::dvec3& one : light)
            sum += one;
        set(element, sum);
        if (between)
            between();
    });
    if (!done)
        return bakeCancelled();
    return {};
}

Result<ElementSurfaces> elementSurfaces(const TraceScene& scene, const ElementMesh& elements,
                                        const SceneProblemSettings& settings,
                                        const JobContext& job) {
    ElementSurfaces result;
    result.reflectance.resize(elements.size());
    result.glow.resize(elements.size());
    std::atomic<std::size_t> clamped{0};
    const Sampler sampler(scene, elements, settings);
    const bool done = forElements(elements, job, [&](std::uint32_t element) {
        glm::dvec3 albedo, glow;
        sampler.surface(element, albedo, glow);
        result.reflectance[element] =
            glm::min(albedo, glm::dvec3(ElementSurfaces::kMaxReflectance));
        if (albedo != result.reflectance[element])
            ++clamped;
        result.glow[element] = std::numbers::pi * glow;
    });
    if (!done)
        return bakeCancelled();
    result.clamped = clamped;
    return result;
}

std::vector<double> exposedAreas(const ElementMesh& elements) {
    std::vector<double> areas;
    for (std::uint32_t e = 0; e < elements.size(); ++e)
        areas.push_back(elements.area(e) * double{std::max(elements.exposed(e), kLeastExposed)});
    return areas;
}

Result<SceneProblem> SceneProblem::make(const TraceScene& scene, const ElementMesh& elements,
                                        const SceneProblemSettings& settings,
                                        const JobContext& job) {
    DirectLight light(elements.size());
    return make(scene, elements, settings, light, job);
}

Result<SceneProblem> SceneProblem::make(const TraceScene& scene, const ElementMesh& elements,
                                        const SceneProblemSettings& settings, DirectLight& light,
                                        const JobContext& job,
                                        const std::function<void()>& between) {
    CHECK_EQ(light.size(), elements.size());
    SceneProblem result;
    Problem& problem = result.problem;
    auto surfaces = elementSurfaces(scene, elements, settings, job.part(0.0, 0.1));
    if (!surfaces)
        return surfaces.error();
    if (Result<void> found =
            light.complete(scene, elements, settings, {}, job.part(0.1, 1.0), between);
        !found)
        return found.error();
    problem.areas = exposedAreas(elements);
    problem.patches = elements.patches();
    problem.reflectance = std::move(surfaces->reflectance);
    result.glow = std::move(surfaces->glow);
    result.clamped = surfaces->clamped;
    for (std::uint32_t e = 0; e < elements.size(); ++e) {
        result.direct.push_back(light.irradiance(e));
        problem.emission.push_back(problem.reflectance[e] * result.direct[e]);
        if (settings.glowByFactors)
            problem.emission[e] += result.glow[e];
    }
    return result;
}

bool SceneProblem::hasLight() const {
    const auto any = [](const std::vector<glm::dvec3>& light) {
        return std::ranges::any_of(light, [](const glm::dvec3& v) { return magnitude(v) > 0.0; });
    };
    return any(direct) || any(glow);
}

} // namespace patina::radiosity
