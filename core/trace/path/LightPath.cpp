#include "core/trace/path/LightPath.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace patina {
namespace {

constexpr float kEndOfScene = std::numeric_limits<float>::infinity();

// Surfaces from which on paths end by chance, and how likely the brightest of them goes on: light
// that bounces in a white room for ever would never end.
constexpr int kFirstRoulette = 3;
constexpr float kMostLikely = 0.95f;
// Backs that a camera ray passes: surfaces that have only a front are not there from behind.
constexpr int kMostBacks = 256;

// Of uniform light all around.
glm::vec3 glassAlbedo(const GlassTerms& glass) {
    const float reflects = glassReflectance(glass, glass.NoV);
    return reflects + (1.0f - reflects) * glass.tint;
}

} // namespace

glm::vec3 LightPath::look(const glm::vec3& origin, const glm::vec3& direction,
                          const PathSequence& sequence, const TraceView& view, float& alpha) {
    ClosestRay hit = closest(origin, direction);
    TracePoint point;
    for (int backs = 0;; ++backs) {
        if (hit.mesh == ClosestRay::kNothing || backs == kMostBacks) {
            alpha = view.transparent ? 0.0f : 1.0f;
            if (view.transparent)
                return glm::vec3(0.0f);
            const glm::vec3 behind = backgroundOf(view, direction);
            if (TraceSample* sample = m_split.sample())
                sample->background = behind;
            return behind;
        }
        point = meet(hit, 0, sequence);
        if (point.hasSurface())
            break;
        hit = closest(TraceScene::origin(point, true), direction);
    }
    m_media = Media();
    const glm::vec3 seen =
        leftOnWay(m_media, point, m_scene.metres(glm::length(point.position - origin)));
    const TraceSurface surface = m_scene.surfaceIn(point, -direction, m_media);
    const glm::vec3 emission = seen * point.emission();
    if (TraceSample* sample = m_split.sample()) {
        sample->hit = true;
        sample->albedo = surface.opaque.diffuseAlbedo + surface.opaque.specularAlbedo;
        if (surface.glassShare > 0.0f)
            sample->albedo =
                glm::mix(sample->albedo, glassAlbedo(surface.glass), surface.glassShare);
        sample->normal = point.normal;
        sample->position = m_scene.toWorld(point.position) - view.camera.position();
        sample->emission = emission;
    }
    const Followed rest = follow(point, surface, sequence, &view, seen);
    alpha = rest.alpha;
    return emission + rest.radiance;
}

LightPath::Followed LightPath::follow(TracePoint point, TraceSurface terms,
                                      const PathSequence& sequence, const TraceView* view,
                                      const glm::vec3& seen) {
    if (view == nullptr) {
        m_media = Media();
        if (searchesSky())
            m_sky = m_scene.searchEnvironment(sequence.at(0, PathSequence::kSky));
    }
    Followed result;
    glm::vec3& radiance = result.radiance;
    glm::vec3 throughput(seen);
    // Radiance is lower outside of a dense body than in it: a path inside weighs less than what
    // leaves it again will.
    float gathered = 1.0f;
    int bounces = -1; // light that goes straight on has not bounced
    Search search;
    for (int surface = 0;; ++surface) {
        const glm::vec2 mixture =
            terms.glassShare > 0.0f ? sequence.ofGlass(surface) : glm::vec2(1.0f);
        const Part part{point, terms, mixture.x < terms.glassShare};
        const bool smooth = part.isGlass && terms.glass.isSmooth();
        const glm::vec3 world = m_scene.toWorld(point.position);
        if (!smooth) {
            m_sky = EnvironmentSampler::find(m_sky);
            m_scene.lights().choices(world, m_choices);
            const glm::vec3 lit = throughput * direct(part, world, surface, sequence);
            radiance += surface == 0 ? lit : m_split.came(surface, lit);
        }

        // On to what the surface would reflect.
        const GlassSample on = next(part, sequence, surface, mixture.y);
        if (on.weight == glm::vec3(0.0f))
            return result;
        const glm::vec3 l = on.direction;
        // Below the face there is the surface itself: see docs/maths/path-tracing.md.
        if ((glm::dot(point.face, l) > 0.0f) == on.through)
            return result;
        throughput *= on.weight;
        if (on.through && !terms.glass.thinWalled) {
            gathered *= terms.glass.eta * terms.glass.eta;
            m_media.cross(point, terms.ior);
        }
        if (surface == 0)
            m_split.leaves();
        if (surface >= kFirstRoulette) {
            const float goesOn = std::min(
                {gathered * std::max({throughput.x, throughput.y, throughput.z}), kMostLikely});
            if (!(sequence.at(surface, PathSequence::kLobe).y < goesOn))
                return result;
            throughput /= goesOn;
        }
        if (throughput == glm::vec3(0.0f))
            return result;
        if (!(smooth && on.through && terms.glass.isStraight())) {
            search = {world, on.pdf, 0.0f, false, smooth};
            ++bounces;
        }

        const ClosestRay hit = closest(TraceScene::origin(point, on.through), l);
        const bool open = hit.mesh == ClosestRay::kNothing;
        const float distance = open ? kEndOfScene : m_scene.metres(hit.ray.maxDistance);
        if (m_firstLights || surface > 0)
            radiance += m_split.came(surface, throughput * lightsAlong(search, l, distance));
        if (open) {
            throughput *= m_media.transmittance(kEndOfScene);
            if (view != nullptr && search.fromCamera) {
                if (view->transparent)
                    result.alpha = 1.0f - std::min(shading::luminance(throughput), 1.0f);
                else
                    radiance += m_split.came(surface, throughput * backgroundOf(*view, l));
                return result;
            }
            const EnvironmentSampler::Lookup sky = m_scene.lookUpEnvironment(l);
            radiance += m_split.came(surface, throughput * sky.radiance * found(search, sky.pdf));
            return result;
        }
        point = meet(hit, surface + 1, sequence);
        throughput *= leftOnWay(m_media, point, distance);
        search.travelled += distance;
        if (!point.hasSurface())
            return result; // absorbed
        if (const glm::vec3 glow = point.emission(); glow != glm::vec3(0))
            radiance += m_split.came(surface, throughput * glow *
                                                  found(search, glowPdf(point, search.travelled,
                                                                        glm::dot(point.face, -l))));
        if (m_settings.maxBounces && bounces >= *m_settings.maxBounces)
            return result;
        terms = m_scene.surfaceIn(point, -l, m_media);
    }
}

TracePoint LightPath::meet(const ClosestRay& hit, int surface, const PathSequence& sequence) {
    if (!searchesSky())
        return m_scene.pointAt(hit);
    m_sky = m_scene.searchEnvironment(sequence.at(surface, PathSequence::kSky));
    const TracePoint point = m_scene.pointAt(hit);
    EnvironmentSampler::fetch(m_sky);
    return point;
}

glm::vec3 LightPath::leftOnWay(Media& media, const TracePoint& point, float metres) const {
    if (point.isBack && point.material->transmits() && !point.material->glass().thinWalled &&
        !media.contains(point.material))
        media.enter({point.material, m_scene.indexOf(*point.material)});
    return media.transmittance(metres);
}

// Where the path goes on, with the weight of what comes from there; without a weight it ends.
// `choice`: whether glass reflects.
GlassSample LightPath::next(const Part& part, const PathSequence& sequence, int surface,
                            float choice) {
    const glm::vec2 direction = sequence.at(surface, PathSequence::kDirection);
    GlassSample sample;
    if (part.isGlass) {
        sample = sampleGlass(part.surface.glass, glm::vec3(direction, choice));
        m_split.reflects(glm::vec3(0.0f), sample.weight, sample.through);
        return sample;
    }
    const shading::SurfaceTerms& terms = part.surface.opaque;
    sample.direction = shading::sampleBrdf(
        terms, glm::vec3(direction, sequence.at(surface, PathSequence::kLobe).x), sample.pdf);
    if (sample.pdf > 0.0f)
        sample.weight = reflected(terms, sample.direction) / sample.pdf;
    return sample;
}

} // namespace patina
