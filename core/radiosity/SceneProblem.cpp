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

class Sampler {
  public:
    Sampler(const TraceScene& scene, const ElementMesh& elements,
            const SceneProblemSettings& settings)
        : m_scene(scene)
        , m_elements(elements)
        , m_settings(settings) {}

    // Means over an element: diffuse albedo, radiance of its own.
    void surface(std::uint32_t element, glm::dvec3& albedo, glm::dvec3& glow) const {
        const Face& face = m_elements.face(element);
        const TraceMaterial& material =
            *m_scene.pointAt(face.mesh, face.triangles[0], glm::vec2(1.0f / 3.0f)).material;
        albedo = glow = glm::dvec3(0.0);
        const std::uint32_t seed = seedFor(m_settings.seed ^ 0x51f15eedu, element);
        for (std::uint32_t i = 0; i < kTexturePoints; ++i) {
            const glm::dvec2 at = m_elements.samplePoint(element, sobolOwen2D(i, seed));
            const glm::vec2 uv(m_elements.uvAt(element, at));
            const shading::SurfaceInputs inputs = material.inputsAt(uv);
            albedo += glm::dvec3(inputs.baseColor) * double{1.0f - inputs.metallic} *
                      double{1.0f - inputs.transmission};
            glow += glm::dvec3(material.emissionAt(uv));
        }
        albedo /= double{kTexturePoints};
        glow /= double{kTexturePoints};
    }

    // Mean irradiance of lamps and sky on an element.
    [[nodiscard]] glm::dvec3 direct(std::uint32_t element) const {
        glm::dvec3 sum(0.0);
        const auto count = static_cast<std::uint32_t>(m_settings.lightSamples);
        const auto lamps = static_cast<std::uint32_t>(m_scene.lights().size());
        if (lamps == 0 && !m_scene.hasEnvironment())
            return sum;
        const Face& face = m_elements.face(element);
        const glm::vec3 normal(face.normal);
        const std::uint32_t seed = seedFor(m_settings.seed ^ 0x11a3b5c7u, element);
        for (std::uint32_t i = 0; i < count; ++i) {
            const glm::vec3 from =
                glm::vec3(m_elements.samplePosition(element, sobolOwen2D(i, seed))) +
                kRayOffset * normal;
            for (std::uint32_t lamp = 0; lamp < lamps; ++lamp) {
                const LightSample light = m_scene.lights().sample(
                    lamp, m_scene.toWorld(from), sobolOwen2D(i, seedFor(seed, lamp + 1)));
                const float cosine = glm::dot(normal, light.direction);
                if (!(cosine > 0.0f) || light.light == glm::vec3(0.0f))
                    continue;
                if (m_scene.lights().isHidden(lamp) &&
                    m_scene.occluded(from, light.direction, m_scene.sceneUnits(light.distance)))
                    continue;
                sum += glm::dvec3(light.light) * double{cosine} /
                       (light.pdf > 0.0f ? double{light.pdf} : 1.0);
            }
            if (m_scene.hasEnvironment()) {
                const EnvironmentSampler::Sample sky =
                    m_scene.sampleEnvironment(sobolOwen2D(i, seedFor(seed, 0)));
                const float cosine = glm::dot(normal, sky.direction);
                if (cosine > 0.0f && sky.pdf > 0.0f &&
                    !m_scene.occluded(from, sky.direction, std::numeric_limits<float>::infinity()))
                    sum += glm::dvec3(sky.radiance) * double{cosine} / double{sky.pdf};
            }
        }
        return sum / static_cast<double>(count);
    }

  private:
    const TraceScene& m_scene;
    const ElementMesh& m_elements;
    const SceneProblemSettings& m_settings;
};

} // namespace

Result<SceneProblem> SceneProblem::make(const TraceScene& scene, const ElementMesh& elements,
                                        const SceneProblemSettings& settings,
                                        const JobContext& job) {
    SceneProblem result;
    const std::size_t n = elements.size();
    Problem& problem = result.problem;
    problem.areas.assign(elements.areas().begin(), elements.areas().end());
    problem.reflectance.resize(n);
    problem.emission.resize(n);
    result.direct.resize(n);
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
            problem.emission[e] =
                std::numbers::pi * glow + problem.reflectance[e] * result.direct[e];
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
