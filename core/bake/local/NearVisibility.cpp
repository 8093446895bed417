#include "core/bake/local/NearVisibility.h"

#include "core/job/Parallel.h"
#include "core/light/Light.h"
#include "core/light/Lights.h"
#include "core/math/Sampling.h"
#include "core/math/Shading.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>

namespace patina {
namespace {

using Shape = NearEmitter::Shape;

// Rays end this far before the light, in scene units: a rectangle may lie in the ceiling that it
// lights the room from.
constexpr float kEndOffset = 4.0f * kRayOffset;
// Where rays pass by chance, which the direction decides, those to a point of light end within this
// share of its distance about it.
constexpr float kPointSpread = 1e-4f;

// Owen-scrambled Sobol' points, computed once: an element picks one of the sequences and shifts it
// about the unit square by an offset of its own, which costs a tenth of a sequence for each.
class AreaSamples {
  public:
    AreaSamples() {
        for (std::uint32_t s = 0; s < kSequences; ++s)
            for (std::uint32_t k = 0; k < kMostNearRays; ++k)
                m_points[s][k] = sobolOwen2D(k, seedFor(0, s));
    }
    [[nodiscard]] glm::vec2 at(std::uint32_t elementSeed, std::uint32_t k) const {
        const std::uint32_t shift = hash32(elementSeed);
        const glm::vec2 offset = glm::vec2(shift >> 16, shift & 0xffffu) / 65536.0f;
        const glm::vec2 shifted = m_points[elementSeed % kSequences][k] + offset;
        // Below 1, which rounding may reach.
        return glm::min(shifted - glm::floor(shifted), glm::vec2(0x1.fffffep-1f));
    }

  private:
    static constexpr std::uint32_t kSequences = 16;
    std::array<std::array<glm::vec2, kMostNearRays>, kSequences> m_points{};
};

// The emitter in scene units.
NearEmitter toSceneUnits(NearEmitter emitter, const BakeGeometry& geometry) {
    const auto scale = static_cast<float>(geometry.unitsPerMetre);
    emitter.position =
        glm::vec3((glm::dvec3(emitter.position) - geometry.centre) * geometry.unitsPerMetre);
    emitter.radius *= scale;
    emitter.halfX *= scale;
    emitter.halfY *= scale;
    return emitter;
}

// A direction to the light and what arrives from there, up to a factor that is the same for all
// samples of a point; no weight: nothing arrives at an open surface.
struct LightSample {
    glm::vec3 direction{0.0f};
    float distance = 0.0f, weight = 0.0f;
};

// Even in solid angle; from within the sphere light comes from everywhere.
LightSample sampleSphere(const BakePoint& point, const glm::vec3& toCenter, float radius,
                         const glm::vec2& u) {
    const float distance2 = glm::dot(toCenter, toCenter);
    const float radius2 = radius * radius;
    glm::vec3 x, y;
    if (distance2 <= radius2) {
        shading::orthonormalBasis(point.normal, x, y);
        const glm::vec3 local = shading::cosineHemisphere(u);
        const glm::vec3 d = local.x * x + local.y * y + local.z * point.normal;
        const float along = glm::dot(toCenter, d);
        const float exit = along + std::sqrt(std::max(along * along + radius2 - distance2, 0.0f));
        return {d, exit, 1.0f};
    }
    const float distance = std::sqrt(distance2);
    const glm::vec3 axis = toCenter / distance;
    shading::orthonormalBasis(axis, x, y);
    const float sin2Max = radius2 / distance2;
    // 1 - cos of the cap's half angle, without cancellation for small ones.
    const float whole = sin2Max / (1.0f + std::sqrt(1.0f - sin2Max));
    const float height = u.x * whole; // 1 - cos
    const float sine = std::sqrt(std::max(height * (2.0f - height), 0.0f));
    const float phi = 2.0f * std::numbers::pi_v<float> * u.y;
    const glm::vec3 d = sine * (std::cos(phi) * x + std::sin(phi) * y) + (1.0f - height) * axis;
    // To where the ray enters the sphere.
    const float offAxis2 = distance2 * sine * sine;
    const float enter = distance * (1.0f - height) - std::sqrt(std::max(radius2 - offAxis2, 0.0f));
    return {d, enter, std::max(glm::dot(point.normal, d), 0.0f)};
}

LightSample sampleRectangle(const BakePoint& point, const NearEmitter& light, const glm::vec2& u) {
    const glm::vec3 to = light.position + (2.0f * u.x - 1.0f) * light.halfX +
                         (2.0f * u.y - 1.0f) * light.halfY - point.origin;
    const float distance2 = glm::dot(to, to);
    if (!(distance2 > 0.0f))
        return {};
    const float distance = std::sqrt(distance2);
    const glm::vec3 d = to / distance;
    const float cosLight = -glm::dot(glm::cross(light.halfY, light.halfX), d);
    const float cosSurface = glm::dot(point.normal, d);
    if (cosLight <= 0.0f || cosSurface <= 0.0f)
        return {};
    return {d, distance, cosLight * cosSurface / distance2};
}

LightSample samplePoint(const BakePoint& point, const glm::vec3& to, bool spread,
                        const glm::vec2& u) {
    const float distance = glm::length(to);
    if (!(distance > 0.0f))
        return {};
    glm::vec3 d = to / distance;
    const float weight = std::max(glm::dot(point.normal, d), 0.0f);
    if (spread) {
        glm::vec3 x, y;
        shading::orthonormalBasis(d, x, y);
        const glm::vec2 disc = kPointSpread * shading::concentricDisc(u);
        d = glm::normalize(d + disc.x * x + disc.y * y);
    }
    return {d, distance, weight};
}

// Belongs to one thread.
class Tracer {
  public:
    Tracer(const BakeScene& scene, const NearEmitter& emitter, const AreaSamples& samples,
           std::uint32_t firstElement)
        : m_scene(scene)
        , m_samples(samples)
        , m_light(toSceneUnits(emitter, *scene.geometry))
        , m_firstElement(firstElement)
        , m_spread(emitter.shape == Shape::Point && scene.passesByChance)
        , m_once(emitter.shape == Shape::Point && !m_spread) {}

    void trace(std::span<const BakePoint> points, std::size_t begin, std::size_t end,
               std::span<float> shares) {
        m_tallies.assign(end - begin, {});
        m_rays.clear();
        m_owners.clear();
        for (std::size_t i = begin; i < end; ++i)
            add(points[i], i, begin, 0, m_once ? 1 : kFirstNearRays);
        cast();
        if (!m_once) {
            for (std::size_t i = begin; i < end; ++i)
                if (m_tallies[i - begin].arrives > 0.0f && m_tallies[i - begin].hidden > 0.0f) {
                    add(points[i], i, begin, kFirstNearRays, kMostNearRays);
                    if (m_rays.size() >= kBatch)
                        cast();
                }
            cast();
        }
        for (std::size_t i = begin; i < end; ++i) {
            const Tally& tally = m_tallies[i - begin];
            shares[i] =
                tally.hidden == 0.0f ? 1.0f : tally.arrives / (tally.arrives + tally.hidden);
        }
    }

  private:
    static constexpr std::size_t kBatch = 1024; // rays

    struct Tally {
        float arrives = 0.0f, hidden = 0.0f; // weights of samples
    };
    struct Owner {
        std::uint32_t tally = 0;
        float weight = 0.0f;
    };

    void add(const BakePoint& point, std::size_t index, std::size_t begin, std::uint32_t first,
             std::uint32_t last) {
        const std::uint32_t seed = seedFor(0, m_firstElement + static_cast<std::uint32_t>(index));
        for (std::uint32_t k = first; k < last; ++k) {
            const LightSample sample =
                sampleLight(point, m_once ? glm::vec2(0.0f) : m_samples.at(seed, k));
            if (!(sample.weight > 0.0f))
                continue;
            OcclusionRay& ray = m_rays.emplace_back();
            ray.origin = point.origin;
            ray.direction = sample.direction;
            ray.maxDistance = std::max(sample.distance - kEndOffset, 0.0f);
            m_owners.push_back({static_cast<std::uint32_t>(index - begin), sample.weight});
        }
    }

    [[nodiscard]] LightSample sampleLight(const BakePoint& point, const glm::vec2& u) const {
        const glm::vec3 to = m_light.position - point.origin;
        switch (m_light.shape) {
        case Shape::Point:
            return samplePoint(point, to, m_spread, u);
        case Shape::Sphere:
            return sampleSphere(point, to, m_light.radius, u);
        case Shape::Rectangle:
            return sampleRectangle(point, m_light, u);
        }
        return {};
    }

    void cast() {
        m_scene.rays.occlude(m_rays);
        for (std::size_t r = 0; r < m_rays.size(); ++r) {
            Tally& tally = m_tallies[m_owners[r].tally];
            (m_rays[r].occluded() ? tally.hidden : tally.arrives) += m_owners[r].weight;
        }
        m_rays.clear();
        m_owners.clear();
    }

    const BakeScene& m_scene;
    const AreaSamples& m_samples;
    NearEmitter m_light; // scene units
    std::uint32_t m_firstElement;
    bool m_spread, m_once;
    std::vector<OcclusionRay> m_rays;
    std::vector<Owner> m_owners; // of each ray
    std::vector<Tally> m_tallies;
};

} // namespace

std::optional<NearEmitter> nearEmitter(const Light& light) {
    NearEmitter emitter;
    emitter.position = light.position;
    switch (light.type) {
    case LightType::Directional:
        return {};
    case LightType::Point:
    case LightType::Spot:
        break;
    case LightType::Sphere:
        emitter.shape = Shape::Sphere;
        emitter.radius = light.radius;
        break;
    case LightType::Rectangle: {
        const RectangleAxes axes = rectangleAxes(light);
        emitter.shape = Shape::Rectangle;
        emitter.halfX = 0.5f * light.width * axes.x;
        emitter.halfY = 0.5f * light.height * axes.y;
        break;
    }
    }
    return emitter;
}

Result<std::vector<float>> nearVisibility(const BakeScene& scene, std::span<const BakePoint> points,
                                          const NearEmitter& emitter, const JobContext& job,
                                          std::uint32_t firstElement) {
    std::vector<float> shares(points.size(), 1.0f);
    static const AreaSamples samples; // the same for every light
    const auto trace = [&](std::size_t begin, std::size_t end) {
        const FlushDenormals flush;
        Tracer tracer(scene, emitter, samples, firstElement);
        tracer.trace(points, begin, end, shares);
    };
    if (points.size() <= kNearGrain)
        trace(0, points.size());
    else
        parallelFor(job, points.size(), kNearGrain, trace);
    if (job.cancelled())
        return Error{ErrorKind::Cancelled, "Tracing shadows was cancelled.", {}, {}};
    return shares;
}

} // namespace patina
