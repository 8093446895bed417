// One path at a time through a scene, from the camera from surface to surface: what the path tracer
// does for each sample of a pixel. Of one thread.
#pragma once

#include "core/math/Sampling.h"
#include "core/trace/path/PathTracer.h"
#include "core/trace/path/TraceOutputs.h"
#include "core/trace/path/TraceScene.h"

#include <cstdint>
#include <glm/geometric.hpp>
#include <vector>

namespace patina {

// The numbers of one sample of one pixel.
class PathSequence {
  public:
    // Pairs of dimensions: one of the pixel, then so many of each surface.
    enum Dimension : std::uint32_t { kPixel = 0, kLobe, kDirection, kSky, kChoice, kLight, kGlow };

    PathSequence(std::uint32_t index, std::uint32_t seed)
        : m_index(index)
        , m_seed(seed) {}
    [[nodiscard]] glm::vec2 at(int surface, Dimension dimension) const {
        return sobolOwen2D(
            m_index,
            seedFor(m_seed, static_cast<std::uint32_t>(surface) * kPerSurface + dimension));
    }
    // Which part of a mixed surface a path meets, and whether glass reflects.
    [[nodiscard]] glm::vec2 ofGlass(int surface) const {
        return sobolOwen2D(m_index, seedFor(m_seed, kGlass + static_cast<std::uint32_t>(surface)));
    }
    // Where a path leaves the lens.
    [[nodiscard]] glm::vec2 onLens() const { return sobolOwen2D(m_index, seedFor(m_seed, kLens)); }

  private:
    static constexpr std::uint32_t kPerSurface = kGlow;
    // Beyond those of any surface, so that pictures without glass keep their samples.
    static constexpr std::uint32_t kGlass = 1u << 31;
    static constexpr std::uint32_t kLens = kGlass - 1; // likewise

    std::uint32_t m_index, m_seed;
};

class LightPath {
  public:
    LightPath(const TraceScene& scene, const PathSettings& settings)
        : m_scene(scene)
        , m_settings(settings) {}

    // The paths from here on fill this; null: none.
    void fill(TraceSample* sample) { m_split = TraceSplit(sample); }

    // From here on the surface where a path begins gets no light of the scene's lights straight
    // from them: that of the environment, of glowing surfaces and by way of others alone.
    void leaveOutFirstLights() { m_firstLights = false; }

    // From the camera; scene units. `alpha`: how much is seen of that.
    glm::vec3 look(const glm::vec3& origin, const glm::vec3& direction,
                   const PathSequence& sequence, const TraceView& view, float& alpha);

    struct Followed {
        glm::vec3 radiance{0.0f};
        float alpha = 1.0f; // less where the background is left out and seen through straight glass
    };
    // What a place reflects to the viewer. `view`: that looks at it; `seen`: share that arrives.
    Followed follow(TracePoint point, TraceSurface terms, const PathSequence& sequence,
                    const TraceView* view = nullptr, const glm::vec3& seen = glm::vec3(1.0f));

    [[nodiscard]] std::uint64_t rays() const { return m_rays; } // so far

  private:
    // From where a path's light could have been found by a ray to the light, too: the last surface
    // but straight glass, which both kinds of rays pass alike.
    struct Search {
        glm::vec3 world{0.0f};
        float pdf = 0.0f;       // of the path's direction there, per steradian
        float travelled = 0.0f; // metres since
        bool fromCamera = true; // no surface yet
        bool smooth = false;    // no ray to a light finds what a smooth surface mirrors or refracts
    };

    // The part of a mixed surface that a path has met.
    struct Part {
        const TracePoint& point;
        const TraceSurface& surface;
        bool isGlass;

        [[nodiscard]] float pdf(const glm::vec3& l) const {
            return isGlass ? glassPdf(surface.glass, l) : shading::brdfPdf(surface.opaque, l);
        }
        // The direction is on one side of the shading normal and of the triangle, and light counts
        // there.
        [[nodiscard]] bool isOpenTo(const glm::vec3& l) const {
            const bool above = glm::dot(point.face, l) > 0.0f;
            return isGlass ? above == (glm::dot(surface.glass.n, l) > 0.0f)
                           : above && glm::dot(surface.opaque.n, l) > 0.0f;
        }
    };

    ClosestRay closest(const glm::vec3& origin, const glm::vec3& direction) {
        ++m_rays;
        return m_scene.closest(origin, direction);
    }
    [[nodiscard]] glm::vec3 backgroundOf(const TraceView& view, const glm::vec3& direction) const {
        return view.background ? view.background(direction)
                               : m_scene.environmentRadiance(direction);
    }
    // Share of the light that is left on the way to a point through the media. Its back shows what
    // a ray is in that began inside a body, or came in by a hole.
    glm::vec3 leftOnWay(Media& media, const TracePoint& point, float metres) const;
    [[nodiscard]] GlassSample next(const Part& part, const PathSequence& sequence, int surface,
                                   float choice);

    // BSDF times cosine, split by lobe.
    glm::vec3 reflected(const shading::SurfaceTerms& terms, const glm::vec3& l);
    glm::vec3 reflected(const Part& part, const glm::vec3& l);

    // How much light counts that a ray of the reflection has found, which a ray to the light could
    // have found, too.
    [[nodiscard]] float found(const Search& search, float lightPdf) const;
    // The reverse.
    [[nodiscard]] float sent(float lightPdf, float pdf) const;

    // Share of the light that arrives from so far, of a part that is open to it; a body that
    // refracts lets no straight ray through.
    [[nodiscard]] glm::vec3 arriving(const Part& part, const glm::vec3& l, float metres);
    [[nodiscard]] glm::vec3 throughStraightGlass(glm::vec3 from, const glm::vec3& l, float metres,
                                                 Media& media);

    [[nodiscard]] bool searchesSky() const {
        return m_scene.hasEnvironment() && m_settings.search != LightSearch::Surfaces;
    }
    // The place that a ray has met; m_sky becomes the search of that surface.
    TracePoint meet(const ClosestRay& hit, int surface, const PathSequence& sequence);

    // Light by rays to lights.
    glm::vec3 direct(const Part& part, const glm::vec3& world, int surface,
                     const PathSequence& sequence);
    glm::vec3 fromLight(const Part& part, const glm::vec3& world, float u, const glm::vec2& u2);
    glm::vec3 fromGlow(const Part& part, float u, const glm::vec2& u2);
    // Per steradian, of a ray to a glowing place that is seen from so far under that cosine.
    [[nodiscard]] float glowPdf(const TracePoint& place, float metres, float cosine) const;
    // Lights with extent that hang in the air before the next surface, so many metres on. The
    // camera does not see them, not even through straight glass.
    [[nodiscard]] glm::vec3 lightsAlong(const Search& search, const glm::vec3& l,
                                        float metres) const;

    const TraceScene& m_scene;
    const PathSettings& m_settings;
    std::vector<float> m_choices;     // among the lights, where light was last searched for
    Media m_media;                    // that the path is in
    EnvironmentSampler::Search m_sky; // of the surface where light is searched for
    TraceSplit m_split{nullptr};
    std::uint64_t m_rays = 0;
    bool m_firstLights = true;
};

} // namespace patina
