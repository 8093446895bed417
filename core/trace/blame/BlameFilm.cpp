#include "core/trace/blame/BlameFilm.h"

#include "core/base/Check.h"
#include "core/image/Image.h"
#include "core/job/Parallel.h"
#include "core/light/DfgTable.h"
#include "core/math/Sampling.h"
#include "core/trace/blame/PrefilterLobe.h"
#include "core/trace/path/Eye.h"
#include "core/trace/path/LightPath.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace patina {
namespace {

constexpr float kEndless = std::numeric_limits<float>::infinity();
constexpr int kMostBacksSeen = 256;            // as of paths
constexpr std::uint32_t kSamplesAtATime = 256; // between two looks at the job

// Pairs of dimensions of the path tracer's samples (core/trace/path/PathTracer.cpp), at the surface
// that is seen. Others would be as right, but their noise would not cancel: a convex body's bounces
// (BlameTest) show that they are the same.
enum BlameDimension : std::uint32_t {
    kOfPixel = 0,
    kOfLobe,
    kOfDirection,
    kOfSky,
    kOfChoice,
    kOfLight,
    kOnLens = (1u << 31) - 1
};

// The power heuristic of docs/maths/path-tracing.md.
float weighed(float pdf, float other) {
    if (!(pdf > 0.0f))
        return 0.0f;
    const float ratio = other / pdf;
    return 1.0f / (1.0f + ratio * ratio);
}

// The DFG table as the viewport has it.
class BlameDfg {
  public:
    explicit BlameDfg(const ShadingModel& model)
        : m_table(computeDfgTable(kSize, model.distribution, iblVisibility(model.visibility),
                                  DfgTexels::ToTheEnds)) {}

    // scale, bias, tilt; bilinear between texels at i / (size - 1).
    [[nodiscard]] glm::vec3 at(float NoV, float perceptualRoughness) const {
        const float x = std::clamp(NoV, 0.0f, 1.0f) * (kSize - 1);
        const float y = std::clamp(perceptualRoughness, 0.0f, 1.0f) * (kSize - 1);
        const int i = std::min(static_cast<int>(x), kSize - 2),
                  j = std::min(static_cast<int>(y), kSize - 2);
        const float fx = x - static_cast<float>(i), fy = y - static_cast<float>(j);
        return glm::mix(glm::mix(texel(i, j), texel(i + 1, j), fx),
                        glm::mix(texel(i, j + 1), texel(i + 1, j + 1), fx), fy);
    }

  private:
    static constexpr int kSize = static_cast<int>(shading::kDfgTableSize);
    [[nodiscard]] glm::vec3 texel(int i, int j) const {
        const float* p = m_table.f32().data() + 3 * static_cast<std::ptrdiff_t>(j * kSize + i);
        return {p[0], p[1], p[2]};
    }
    Image m_table;
};

struct BlameSums {
    std::array<glm::dvec3, kBlameTerms> radiance{};
    int surfaces = 0; // samples that met one
};

using BlameSample = std::array<glm::vec3, kBlameTerms>;

glm::vec3& of(BlameSample& sample, BlameTerm term) {
    return sample[static_cast<std::size_t>(term)];
}

// The terms of one pixel after the other; of one thread.
class BlameTracer {
  public:
    BlameTracer(const TraceScene& scene, const TraceView& view, const ShadingModel& model,
                const BlameDfg& dfg, const JobContext& job)
        : m_job(job)
        , m_scene(scene)
        , m_view(view)
        , m_eye(scene, view)
        , m_path(scene, m_settings)
        , m_iblVisibility(static_cast<int>(iblVisibility(model.visibility)))
        , m_dfg(dfg) {}

    [[nodiscard]] BlameFilm::Pixel pixel(int x, int y, std::uint32_t seed, std::uint32_t samples) {
        BlameSums sums;
        BlameFilm::Pixel pixel;
        const std::uint32_t first = std::bit_floor(samples - 1);
        const auto atPixel = static_cast<std::uint32_t>(y * m_view.width + x);
        m_seed = seedFor(seed, atPixel);
        for (m_index = 0; m_index < samples; ++m_index) {
            if (m_index % kSamplesAtATime == 0 && m_job.stopping())
                return pixel;
            if (m_index == first)
                for (std::size_t t = 0; t < kBlameTerms; ++t)
                    pixel.firstMean[t] = shading::luminance(
                        glm::vec3(sums.radiance[t] / static_cast<double>(first)));
            const BlameSample sample = look(x, y, sums);
            // The film counts such a sample as black, and so do all terms of it.
            if (std::ranges::all_of(sample, [](const glm::vec3& value) {
                    return std::isfinite(value.x) && std::isfinite(value.y) &&
                           std::isfinite(value.z);
                }))
                for (std::size_t t = 0; t < kBlameTerms; ++t)
                    sums.radiance[t] += glm::dvec3(sample[t]);
        }
        for (std::size_t t = 0; t < kBlameTerms; ++t)
            pixel.mean[t] = glm::vec3(sums.radiance[t] / static_cast<double>(samples));
        pixel.coverage = static_cast<float>(sums.surfaces) / static_cast<float>(samples);
        return pixel;
    }

    [[nodiscard]] std::uint64_t rays() const { return m_rays + m_path.rays(); } // so far

  private:
    [[nodiscard]] glm::vec2 at(BlameDimension dimension) const {
        return sobolOwen2D(m_index, seedFor(m_seed, dimension));
    }

    BlameSample look(int x, int y, BlameSums& sums) {
        BlameSample sample{};
        const auto [origin, direction] =
            m_eye.hasLens() ? m_eye.throughLens(x, y, at(kOfPixel), at(kOnLens))
                            : Eye::Ray{m_eye.origin(), m_eye.direction(x, y, at(kOfPixel))};
        ClosestRay hit = closest(origin, direction);
        TracePoint point;
        for (int backs = 0;; ++backs) {
            if (hit.mesh == ClosestRay::kNothing || backs == kMostBacksSeen) {
                if (!m_view.transparent)
                    of(sample, BlameTerm::Rest) = m_view.background
                                                      ? m_view.background(direction)
                                                      : m_scene.environmentRadiance(direction);
                return sample;
            }
            point = m_scene.pointAt(hit);
            if (!point.isBack || point.material->doubleSided())
                break;
            hit = closest(TraceScene::origin(point, true), direction);
        }
        ++sums.surfaces;
        if (point.material->transmits())
            of(sample, BlameTerm::Through) = through(origin, direction);
        of(sample, BlameTerm::Rest) = point.material->emissionAt(point.uv);
        const shading::SurfaceTerms terms = m_scene.surface(point, -direction);
        const glm::vec3 world = m_scene.toWorld(point.position);
        m_scene.lights().choices(world, m_choices);
        addSky(point, terms, sample);
        of(sample, BlameTerm::Lights) = fromLight(point, terms, world);
        addReflection(point, terms, world, sample);
        return sample;
    }

    // Of the path that the film has at this sample.
    glm::vec3 through(const glm::vec3& origin, const glm::vec3& direction) {
        TraceSample ways;
        m_path.fill(&ways);
        float alpha = 0.0f;
        static_cast<void>(
            m_path.look(origin, direction, PathSequence(m_index, m_seed), m_view, alpha));
        return ways.through;
    }

    ClosestRay closest(const glm::vec3& origin, const glm::vec3& direction) {
        ++m_rays;
        return m_scene.closest(origin, direction);
    }
    [[nodiscard]] bool isOpen(const TracePoint& point, const glm::vec3& l, float metres) {
        if (glm::dot(point.face, l) <= 0.0f)
            return false;
        ++m_rays;
        return !m_scene.occluded(TraceScene::origin(point), l,
                                 std::isinf(metres) ? kEndless : m_scene.sceneUnits(metres));
    }

    // The lobe that the environment is filtered with: about the direction in which the viewport
    // looks it up.
    [[nodiscard]] PrefilterLobe filter(const shading::SurfaceTerms& terms,
                                       const glm::vec3& dfg) const {
        return {glm::normalize(shading::lobeDirection(terms, dfg.z)), terms.alpha};
    }
    // The specular lobe without its Fresnel term, D V N·L, from this view; integrates to 1.
    [[nodiscard]] float lobeWeight(const shading::SurfaceTerms& terms, const glm::vec3& dfg,
                                   const glm::vec3& l) const {
        const float NoL = glm::dot(terms.n, l);
        const glm::vec3 sum = terms.v + l;
        const float length2 = glm::dot(sum, sum);
        if (NoL <= 0.0f || length2 < 1e-12f)
            return 0.0f;
        const glm::vec3 h = sum / std::sqrt(length2), across = glm::cross(terms.n, h);
        shading::BrdfModel model = terms.model;
        model.visibility = m_iblVisibility; // which the table, and so the albedo, is made of
        const float D =
            shading::distribution(model, std::clamp(glm::dot(terms.n, h), 0.0f, 1.0f),
                                  std::min(glm::dot(across, across), 1.0f), terms.alpha);
        const float V =
            shading::visibility(model, terms.NoV, std::min(NoL, 1.0f),
                                std::clamp(glm::dot(terms.v, h), 0.0f, 1.0f), terms.alpha);
        return D * V * NoL / std::max(dfg.x + dfg.y, 1e-3f); // of an empty table, as in brdf.glsl
    }

    // Directions as likely as the environment is bright there, and as the filter's lobe has them.
    void addSky(const TracePoint& point, const shading::SurfaceTerms& terms, BlameSample& sample) {
        if (!m_scene.hasEnvironment())
            return;
        const EnvironmentSampler::Sample sky = m_scene.sampleEnvironment(at(kOfSky));
        const glm::vec3 dfg = m_dfg.at(terms.NoV, terms.perceptualRoughness);
        const PrefilterLobe lobe = filter(terms, dfg);
        const glm::vec3 chosen = lobe.sample(at(kOfDirection));
        const float pdf = lobe.pdf(chosen);
        glm::vec3 filtered(0.0f);
        if (pdf > 0.0f)
            filtered = m_scene.environmentRadiance(chosen) *
                       (lobe.weight(chosen) * weighed(pdf, m_scene.environmentPdf(chosen)) / pdf);
        if (sky.pdf > 0.0f) {
            filtered += sky.radiance * (lobe.weight(sky.direction) *
                                        weighed(sky.pdf, lobe.pdf(sky.direction)) / sky.pdf);
            addEnvironment(
                terms, dfg, sky.direction, sky.radiance,
                weighed(sky.pdf, shading::brdfPdf(terms, sky.direction)) / sky.pdf,
                [&] { return isOpen(point, sky.direction, kEndless); }, sample);
        }
        of(sample, BlameTerm::Filtered) = shading::shadePrefiltered(terms, filtered);
    }

    // A direction of the surface's own choice.
    void addReflection(const TracePoint& point, const shading::SurfaceTerms& terms,
                       const glm::vec3& world, BlameSample& sample) {
        float pdf = 0.0f;
        const glm::vec3 l =
            shading::sampleBrdf(terms, glm::vec3(at(kOfDirection), at(kOfLobe).x), pdf);
        if (!(pdf > 0.0f))
            return;
        bool open = false;
        if (glm::dot(point.face, l) > 0.0f) {
            const ClosestRay hit = closest(TraceScene::origin(point), l);
            open = hit.mesh == ClosestRay::kNothing;
            const float distance = open ? kEndless : m_scene.metres(hit.ray.maxDistance);
            const shading::ShadedLight light = shading::shadeDirect(terms, l, glm::vec3(1.0f));
            of(sample, BlameTerm::Lights) +=
                (light.diffuse + light.specular) / pdf * lightsAlong(world, l, distance, pdf);
        }
        if (m_scene.hasEnvironment())
            addEnvironment(
                terms, m_dfg.at(terms.NoV, terms.perceptualRoughness), l,
                m_scene.environmentRadiance(l), weighed(pdf, m_scene.environmentPdf(l)) / pdf,
                [&] { return open; }, sample);
    }

    // Radiance of the environment from `l`, which counts `weight` times.
    template <class IsOpen>
    void addEnvironment(const shading::SurfaceTerms& terms, const glm::vec3& dfg,
                        const glm::vec3& l, const glm::vec3& radiance, float weight,
                        const IsOpen& isOpen, BlameSample& sample) const {
        if (weight == 0.0f || radiance == glm::vec3(0.0f))
            return;
        const shading::ShadedLight light = shading::shadeDirect(terms, l, radiance);
        of(sample, BlameTerm::Diffuse) += weight * light.diffuse;
        of(sample, BlameTerm::Specular) += weight * light.specular;
        of(sample, BlameTerm::Lobe) +=
            shading::shadePrefiltered(terms, weight * lobeWeight(terms, dfg, l) * radiance);
        if (const glm::vec3 both = light.diffuse + light.specular;
            both != glm::vec3(0.0f) && isOpen())
            of(sample, BlameTerm::Occluded) += weight * both;
    }

    // By a ray to one of the lights, as the path tracer's.
    glm::vec3 fromLight(const TracePoint& point, const shading::SurfaceTerms& terms,
                        const glm::vec3& world) {
        const float u = at(kOfChoice).x;
        float before = 0.0f;
        std::size_t chosen = m_choices.size();
        for (std::size_t i = 0; i < m_choices.size(); ++i) {
            if (!(m_choices[i] > 0.0f))
                continue;
            chosen = i; // rounding: the last one that is likely at all
            before += m_choices[i];
            if (u < before)
                break;
        }
        if (chosen == m_choices.size())
            return glm::vec3(0.0f);
        const LightSample light = m_scene.lights().sample(chosen, world, at(kOfLight));
        const shading::ShadedLight shaded =
            shading::shadeDirect(terms, light.direction, light.light);
        const glm::vec3 value = shaded.diffuse + shaded.specular;
        float weight = 1.0f / m_choices[chosen];
        if (light.pdf > 0.0f)
            weight *=
                weighed(light.pdf * m_choices[chosen], shading::brdfPdf(terms, light.direction)) /
                light.pdf;
        if (value == glm::vec3(0.0f) || weight == 0.0f ||
            glm::dot(point.face, light.direction) <= 0.0f)
            return glm::vec3(0.0f);
        if (m_scene.lights().isHidden(chosen) && !isOpen(point, light.direction, light.distance))
            return glm::vec3(0.0f);
        return value * weight;
    }

    // Lights with extent that a ray of the reflection meets before anything else.
    [[nodiscard]] glm::vec3 lightsAlong(const glm::vec3& world, const glm::vec3& l, float metres,
                                        float pdf) const {
        glm::vec3 sum(0.0f);
        for (std::size_t i = 0; i < m_scene.lights().size(); ++i) {
            const LightSample light = m_scene.lights().along(i, world, l, metres);
            if (light.pdf > 0.0f)
                sum += light.light * weighed(pdf, light.pdf * m_choices[i]);
        }
        return sum;
    }

    const JobContext& m_job;
    const TraceScene& m_scene;
    const TraceView& m_view;
    Eye m_eye;
    PathSettings m_settings; // of the film
    LightPath m_path;
    int m_iblVisibility;
    const BlameDfg& m_dfg;
    std::uint32_t m_index = 0, m_seed = 0; // of the present sample
    std::vector<float> m_choices;          // among the lights, at the surface that is seen
    std::uint64_t m_rays = 0;
};

} // namespace

BlameFilm::BlameFilm(int width, int height, std::uint32_t samples)
    : m_width(width)
    , m_height(height)
    , m_samples(samples)
    , m_pixels(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {
    CHECK(width > 0 && height > 0 && samples >= 2);
}

Result<BlameFilm> traceBlame(const TraceScene& scene, const TraceView& view,
                             const ShadingModel& model, std::uint32_t seed, std::uint32_t samples,
                             const JobContext& job) {
    BlameFilm film(view.width, view.height, samples);
    const BlameDfg dfg(model);
    const int columns = (view.width + kTraceTile - 1) / kTraceTile,
              rows = (view.height + kTraceTile - 1) / kTraceTile;
    std::atomic<int> done = 0;
    parallelFor(
        job, static_cast<std::size_t>(columns * rows), 1, [&](std::size_t begin, std::size_t end) {
            const FlushDenormals flush;
            for (std::size_t tile = begin; tile < end; ++tile) {
                BlameTracer tracer(scene, view, model, dfg, job);
                const int x0 = static_cast<int>(tile) % columns * kTraceTile,
                          y0 = static_cast<int>(tile) / columns * kTraceTile;
                for (int y = y0; y < std::min(y0 + kTraceTile, view.height) && !job.stopping(); ++y)
                    for (int x = x0; x < std::min(x0 + kTraceTile, view.width); ++x) {
                        film.pixels()[static_cast<std::size_t>(y * view.width + x)] =
                            tracer.pixel(x, y, seed, samples);
                    }
                job.addWork(static_cast<double>(tracer.rays()), "rays");
                job.setProgress(static_cast<double>(++done) / (columns * rows));
            }
        });
    if (job.stopping())
        return Error{ErrorKind::Cancelled, "cancelled", {}, {}};
    return film;
}

} // namespace patina
