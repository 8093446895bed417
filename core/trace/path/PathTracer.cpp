#include "core/trace/path/PathTracer.h"

#include "core/base/Check.h"
#include "core/job/Parallel.h"
#include "core/math/Sampling.h"
#include "core/trace/path/Eye.h"
#include "core/trace/path/TraceOutputs.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <limits>
#include <mutex>
#include <vector>

namespace patina {
namespace {

constexpr float kInfinite = std::numeric_limits<float>::infinity();
constexpr int kTile = kTraceTile;

// Pairs of dimensions of a path's samples: one of the pixel, then so many of each surface.
enum Dimension : std::uint32_t { kPixel = 0, kLobe, kDirection, kSky, kChoice, kLight, kGlow };
constexpr std::uint32_t kPerSurface = kGlow;

// Surfaces from which on paths end by chance, and how likely the brightest of them goes on: light
// that bounces in a white room for ever would never end.
constexpr int kFirstRoulette = 3;
constexpr float kMostLikely = 0.95f;
// Backs that a camera ray passes: surfaces that have only a front are not there from behind.
constexpr int kMostBacks = 256;

// Veach 1997, "Robust Monte Carlo Methods for Light Transport Simulation", section 9.2.4: the power
// heuristic with exponent 2.
float powerWeight(float pdf, float other) {
    if (!(pdf > 0.0f))
        return 0.0f;
    const float ratio = other / pdf;
    return 1.0f / (1.0f + ratio * ratio);
}

// The numbers of one sample of one pixel.
class Sequence {
  public:
    Sequence(std::uint32_t index, std::uint32_t seed)
        : m_index(index)
        , m_seed(seed) {}
    [[nodiscard]] glm::vec2 at(int surface, std::uint32_t dimension) const {
        return sobolOwen2D(
            m_index,
            seedFor(m_seed, static_cast<std::uint32_t>(surface) * kPerSurface + dimension));
    }

  private:
    std::uint32_t m_index, m_seed;
};

class Path {
  public:
    Path(const TraceScene& scene, const PathSettings& settings)
        : m_scene(scene)
        , m_settings(settings) {}

    // The paths from here on fill this; null: none.
    void fill(TraceSample* sample) { m_split = TraceSplit(sample); }

    // From the camera; scene units. `alpha`: how much is seen of that.
    glm::vec3 look(const glm::vec3& origin, const glm::vec3& direction, const Sequence& sequence,
                   const TraceView& view, float& alpha) {
        ClosestRay hit = closest(origin, direction);
        TracePoint point;
        for (int backs = 0;; ++backs) {
            if (hit.mesh == ClosestRay::kNothing || backs == kMostBacks) {
                alpha = view.transparent ? 0.0f : 1.0f;
                if (view.transparent)
                    return glm::vec3(0.0f);
                const glm::vec3 behind = view.background ? view.background(direction)
                                                         : m_scene.environmentRadiance(direction);
                if (TraceSample* sample = m_split.sample())
                    sample->background = behind;
                return behind;
            }
            point = m_scene.pointAt(hit);
            if (!point.isBack || point.material->doubleSided())
                break;
            hit = closest(TraceScene::origin(point, true), direction);
        }
        alpha = 1.0f;
        const shading::SurfaceTerms terms = m_scene.surface(point, -direction);
        const glm::vec3 emission = point.material->emissionAt(point.uv);
        if (TraceSample* sample = m_split.sample()) {
            sample->hit = true;
            sample->albedo = terms.diffuseAlbedo + terms.specularAlbedo;
            sample->normal = point.normal;
            sample->position = m_scene.toWorld(point.position) - view.camera.position();
            sample->emission = emission;
        }
        return emission + follow(point, terms, sequence);
    }

    // What a place reflects to the viewer.
    glm::vec3 follow(TracePoint point, shading::SurfaceTerms terms, const Sequence& sequence) {
        glm::vec3 radiance(0.0f), throughput(1.0f);
        for (int surface = 0;; ++surface) {
            const glm::vec3 from = TraceScene::origin(point);
            const glm::vec3 world = m_scene.toWorld(point.position);
            m_scene.lights().choices(world, m_choices);
            const glm::vec3 lit = throughput * direct(point, terms, from, world, surface, sequence);
            radiance += surface == 0 ? lit : m_split.came(surface, lit);

            // On to what the surface would reflect.
            const glm::vec2 lobe = sequence.at(surface, kLobe);
            float pdf = 0.0f;
            const glm::vec3 l = shading::sampleBrdf(
                terms, glm::vec3(sequence.at(surface, kDirection), lobe.x), pdf);
            // Below the face there is the surface itself: see docs/maths/path-tracing.md.
            if (!(pdf > 0.0f) || glm::dot(point.face, l) <= 0.0f)
                return radiance;
            throughput *= reflected(terms, l) / pdf;
            if (surface == 0)
                m_split.leaves();
            if (surface >= kFirstRoulette) {
                const float goesOn =
                    std::min({std::max({throughput.x, throughput.y, throughput.z}), kMostLikely});
                if (!(lobe.y < goesOn))
                    return radiance;
                throughput /= goesOn;
            }
            if (throughput == glm::vec3(0.0f))
                return radiance;

            const ClosestRay hit = closest(from, l);
            const bool open = hit.mesh == ClosestRay::kNothing;
            const float distance = open ? kInfinite : m_scene.metres(hit.ray.maxDistance);
            radiance += m_split.came(surface, throughput * lightsAlong(world, l, distance, pdf));
            if (open)
                return radiance +
                       m_split.came(surface, throughput * m_scene.environmentRadiance(l) *
                                                 found(pdf, m_scene.environmentPdf(l)));
            point = m_scene.pointAt(hit);
            if (point.isBack && !point.material->doubleSided())
                return radiance; // absorbed
            if (const glm::vec3 glow = point.material->emissionAt(point.uv); glow != glm::vec3(0))
                radiance += m_split.came(
                    surface, throughput * glow *
                                 found(pdf, glowPdf(point, distance, glm::dot(point.face, -l))));
            if (m_settings.maxBounces && surface >= *m_settings.maxBounces)
                return radiance;
            terms = m_scene.surface(point, -l);
        }
    }

    [[nodiscard]] std::uint64_t rays() const { return m_rays; } // so far

  private:
    ClosestRay closest(const glm::vec3& origin, const glm::vec3& direction) {
        ++m_rays;
        return m_scene.closest(origin, direction);
    }
    glm::vec3 reflected(const shading::SurfaceTerms& terms, const glm::vec3& l) {
        const shading::ShadedLight light = shading::shadeDirect(terms, l, glm::vec3(1.0f));
        m_split.reflects(light.diffuse, light.specular);
        return light.diffuse + light.specular;
    }

    // How much light counts that a ray of the reflection has found, which a ray to the light could
    // have found, too.
    [[nodiscard]] float found(float pdf, float lightPdf) const {
        switch (m_settings.search) {
        case LightSearch::Both:
            return powerWeight(pdf, lightPdf);
        case LightSearch::Lights:
            return lightPdf > 0.0f ? 0.0f : 1.0f;
        case LightSearch::Surfaces:
            break;
        }
        return 1.0f;
    }
    // The reverse.
    [[nodiscard]] float sent(float lightPdf, float pdf) const {
        switch (m_settings.search) {
        case LightSearch::Both:
            return powerWeight(lightPdf, pdf);
        case LightSearch::Lights:
            return 1.0f;
        case LightSearch::Surfaces:
            break;
        }
        return 0.0f;
    }

    [[nodiscard]] bool isOpen(const TracePoint& point, const glm::vec3& from, const glm::vec3& l,
                              float metres) {
        if (glm::dot(point.face, l) <= 0.0f)
            return false;
        ++m_rays;
        return !m_scene.occluded(from, l,
                                 std::isinf(metres) ? kInfinite : m_scene.sceneUnits(metres));
    }

    glm::vec3 direct(const TracePoint& point, const shading::SurfaceTerms& terms,
                     const glm::vec3& from, const glm::vec3& world, int surface,
                     const Sequence& sequence) {
        glm::vec3 sum(0.0f);
        const glm::vec2 choice = sequence.at(surface, kChoice);
        if (m_scene.hasEnvironment() && m_settings.search != LightSearch::Surfaces) {
            const EnvironmentSampler::Sample sky =
                m_scene.sampleEnvironment(sequence.at(surface, kSky));
            const glm::vec3 light = reflected(terms, sky.direction) * sky.radiance;
            if (sky.pdf > 0.0f && light != glm::vec3(0.0f) &&
                isOpen(point, from, sky.direction, kInfinite))
                sum += m_split.sent(
                    surface,
                    light * (sent(sky.pdf, shading::brdfPdf(terms, sky.direction)) / sky.pdf));
        }
        if (!m_scene.lights().empty())
            sum += m_split.sent(surface, fromLight(point, terms, from, world, choice.x,
                                                   sequence.at(surface, kLight)));
        if (!m_scene.emissive().empty() && m_settings.search != LightSearch::Surfaces)
            sum += m_split.sent(
                surface, fromGlow(point, terms, from, choice.y, sequence.at(surface, kGlow)));
        return sum;
    }

    glm::vec3 fromLight(const TracePoint& point, const shading::SurfaceTerms& terms,
                        const glm::vec3& from, const glm::vec3& world, float u,
                        const glm::vec2& u2) {
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
        const LightSample light = m_scene.lights().sample(chosen, world, u2);
        const glm::vec3 value = reflected(terms, light.direction) * light.light;
        if (value == glm::vec3(0.0f))
            return value;
        float weight = 1.0f / m_choices[chosen];
        if (light.pdf > 0.0f)
            weight *=
                sent(light.pdf * m_choices[chosen], shading::brdfPdf(terms, light.direction)) /
                light.pdf;
        if (weight == 0.0f || glm::dot(point.face, light.direction) <= 0.0f)
            return glm::vec3(0.0f);
        if (m_scene.lights().isHidden(chosen) &&
            !isOpen(point, from, light.direction, light.distance))
            return glm::vec3(0.0f);
        return value * weight;
    }

    glm::vec3 fromGlow(const TracePoint& point, const shading::SurfaceTerms& terms,
                       const glm::vec3& from, float u, const glm::vec2& u2) {
        const TracePoint source =
            m_scene.pointAt(m_scene.emissive().sample(u), EmissiveTriangles::point(u2));
        const glm::vec3 to = source.position - from;
        const float distance2 = glm::dot(to, to);
        if (!(distance2 > 0.0f))
            return glm::vec3(0.0f);
        const float distance = std::sqrt(distance2);
        const glm::vec3 l = to / distance;
        float cosine = -glm::dot(source.face, l);
        if (source.material->doubleSided())
            cosine = std::abs(cosine);
        if (cosine <= 0.0f)
            return glm::vec3(0.0f);
        const glm::vec3 value = reflected(terms, l) * source.material->emissionAt(source.uv);
        const float pdf = glowPdf(source, m_scene.metres(distance), cosine);
        // Short of the source itself.
        if (value == glm::vec3(0.0f) || !(pdf > 0.0f) ||
            !isOpen(point, from, l, m_scene.metres(distance - 2.0f * kRayOffset / cosine)))
            return glm::vec3(0.0f);
        return value * (sent(pdf, shading::brdfPdf(terms, l)) / pdf);
    }

    // Per steradian, of a ray to a glowing place that is seen from so far under that cosine.
    [[nodiscard]] float glowPdf(const TracePoint& place, float metres, float cosine) const {
        const auto luminance = static_cast<double>(shading::luminance(place.material->emissive()));
        return m_scene.emissive().density(luminance) * metres * metres / std::max(cosine, 1e-6f);
    }

    // Lights with extent that hang in the air between two surfaces.
    [[nodiscard]] glm::vec3 lightsAlong(const glm::vec3& world, const glm::vec3& l, float metres,
                                        float pdf) const {
        glm::vec3 sum(0.0f);
        for (std::size_t i = 0; i < m_scene.lights().size(); ++i) {
            const LightSample light = m_scene.lights().along(i, world, l, metres);
            if (light.pdf > 0.0f)
                sum += light.light * found(pdf, light.pdf * m_choices[i]);
        }
        return sum;
    }

    const TraceScene& m_scene;
    const PathSettings& m_settings;
    std::vector<float> m_choices; // among the lights, at the present surface
    TraceSplit m_split{nullptr};
    std::uint64_t m_rays = 0;
};

} // namespace

Result<void> tracePaths(const TraceScene& scene, const TraceView& view,
                        const PathSettings& settings, Film& film, std::uint32_t first,
                        std::uint32_t count, const JobContext& job, TraceRays* rays,
                        const TraceTiles& tiles) {
    CHECK(film.width() == view.width && film.height() == view.height);
    const int columns = (view.width + kTile - 1) / kTile, rows = (view.height + kTile - 1) / kTile;
    const Eye eye(scene, view);
    const auto traceTile = [&](int tile) {
        Path path(scene, settings);
        const int x0 = tile % columns * kTile, y0 = tile / columns * kTile;
        for (int y = y0; y < std::min(y0 + kTile, view.height) && !job.stopping(); ++y)
            for (int x = x0; x < std::min(x0 + kTile, view.width); ++x) {
                const auto pixel = static_cast<std::uint32_t>(y * view.width + x);
                Film::Pixel sum = film.at(x, y);
                TraceOutputSum outputs;
                for (std::uint32_t i = std::max(first, sum.samples); i < first + count; ++i) {
                    const Sequence sequence(i, seedFor(settings.seed, pixel));
                    float alpha = 0.0f;
                    TraceSample sample;
                    path.fill(tiles.outputs != nullptr ? &sample : nullptr);
                    const glm::vec3 radiance =
                        path.look(eye.origin(), eye.direction(x, y, sequence.at(0, kPixel)),
                                  sequence, view, alpha);
                    sum.add(radiance, alpha);
                    if (tiles.outputs != nullptr)
                        outputs.add(sample, radiance);
                }
                const auto held = tiles.film != nullptr ? std::unique_lock(*tiles.film)
                                                        : std::unique_lock<std::mutex>();
                film.at(x, y) = sum;
                if (tiles.outputs != nullptr)
                    outputs.addTo(tiles.outputs->pixels()[pixel]);
            }
        job.addWork(static_cast<double>(path.rays()), "rays");
        if (rays != nullptr)
            rays->count += path.rays();
        if (tiles.tileDone)
            tiles.tileDone();
    };
    parallelFor(job, static_cast<std::size_t>(columns * rows), 1,
                [&](std::size_t begin, std::size_t end) {
                    const FlushDenormals flush;
                    for (std::size_t tile = begin; tile < end; ++tile)
                        if (tiles.shard.holds(tile))
                            traceTile(static_cast<int>(tile));
                });
    if (job.cancelled())
        return Error{ErrorKind::Cancelled, "cancelled", {}, {}};
    return {};
}

void traceIrradiance(const TraceScene& scene, const glm::dvec3& position, const glm::vec3& normal,
                     const PathSettings& settings, std::uint32_t count, Film::Pixel& pixel) {
    // A white surface returns its irradiance over pi; one of index 1 has no gloss above it.
    shading::BrdfModel model = shading::defaultBrdfModel();
    model.fresnel = shading::kFresnelDielectric;
    model.ior = 1.0f;
    const shading::SurfaceInputs white{glm::vec3(1.0f), 0.0f, 1.0f, 0.0f};
    const shading::SurfaceTerms terms =
        shading::makeSurface(model, white, normal, normal, glm::vec2(0.0f));
    TracePoint point;
    point.position = scene.toScene(position);
    point.face = point.normal = normal;
    const FlushDenormals flush;
    Path path(scene, settings);
    for (std::uint32_t i = 0; i < count; ++i)
        pixel.add(shading::kPi * path.follow(point, terms, Sequence(i, settings.seed)), 1.0f);
}

} // namespace patina
