// Where the rays of every vertex' hemisphere end: the scene's transport as a list of hits, so that
// bounces can be followed again, with other albedo, without tracing a ray.
#pragma once

#include "core/bake/domain/BakePoints.h"
#include "core/base/Id.h"
#include "core/trace/RayScene.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace patina {

// One ray that met a surface which reflects. 8 bytes; rays that met none leave nothing.
struct CachedHit {
    static constexpr std::uint32_t kLast = 1u << 31;        // of its element
    static constexpr std::uint32_t kBack = 1u << 30;        // of the triangle's back side
    static constexpr std::uint32_t kNoTriangle = kBack - 1; // an element without hits has one such

    std::uint32_t place = 0;             // triangle of the scene, with the flags above
    std::uint16_t second = 0, third = 0; // barycentric weights of those corners, times 65535

    [[nodiscard]] std::uint32_t triangle() const { return place & kNoTriangle; }
    [[nodiscard]] bool back() const { return (place & kBack) != 0; }
    [[nodiscard]] bool last() const { return (place & kLast) != 0; }
};
static_assert(sizeof(CachedHit) == 8);

// What light bounces between: one element per vertex of every mesh, mesh after mesh, for the side
// its normal points to; then one per vertex of the two-sided meshes for their backs.
class BounceElements {
  public:
    struct Triangle {
        std::uint32_t corners[3]; // elements of the front
        std::uint32_t mesh;       // index into meshes()
    };
    struct MeshPart {
        Id id = 0;
        MeshPtr mesh;
        bool doubleSided = false;
        std::uint32_t firstElement = 0, firstTriangle = 0;
        std::uint32_t toBack = 0; // from a front element to that of its back; 0: one-sided
    };

    // Errors: InputBroken for a scene of 2^30 triangles or more.
    static Result<BounceElements> make(const BakeGeometry& geometry);

    [[nodiscard]] std::size_t count() const { return m_fronts + m_backs; }
    [[nodiscard]] std::size_t fronts() const { return m_fronts; }
    [[nodiscard]] const std::vector<Triangle>& triangles() const { return m_triangles; }
    [[nodiscard]] const std::vector<MeshPart>& meshes() const { return m_meshes; }
    [[nodiscard]] std::size_t memoryBytes() const;

    // Where the rays of every element start.
    [[nodiscard]] std::vector<BakePoint> points(const BakeGeometry& geometry,
                                                const JobContext& job) const;

  private:
    std::size_t m_fronts = 0, m_backs = 0;
    std::vector<Triangle> m_triangles;
    std::vector<MeshPart> m_meshes;
};

// Elements whose hits are kept, traced and gathered together.
inline constexpr std::size_t kHitChunk = 64;

struct HitSettings {
    int samples = 64; // rays per element, a power of two
    std::uint32_t seed = 0;
    int order = 1; // bands of backTransfer()
    friend bool operator==(const HitSettings&, const HitSettings&) = default;
};

// Whether a ray has met the back. The front is where the vertex normals point, whichever way the
// triangle is wound: that is the side whose light the elements know.
[[nodiscard]] bool meetsBack(const BakeGeometryMesh& mesh, const ClosestRay& closest);

// Gives the hits of kHitChunk elements at a time. Callable from any thread.
class HitSource {
  public:
    virtual ~HitSource() = default;
    [[nodiscard]] const BounceElements& elements() const { return m_elements; }
    [[nodiscard]] const HitSettings& settings() const { return m_settings; }
    [[nodiscard]] std::size_t chunkCount() const {
        return (m_elements.count() + kHitChunk - 1) / kHitChunk;
    }
    // In the order of the elements; `scratch` may hold them and must live as long as the answer.
    [[nodiscard]] virtual std::span<const CachedHit>
    hits(std::size_t chunk, std::vector<CachedHit>& scratch) const = 0;
    // Whether hits() costs nothing, so that what is derived from it is worth keeping.
    [[nodiscard]] virtual bool kept() const = 0;
    // Direct transfer of the back elements, order² each: fronts have theirs from the bake.
    [[nodiscard]] std::span<const float> backTransfer() const { return m_backTransfer; }
    // Of each element's rays, how many met nothing at all.
    [[nodiscard]] std::span<const std::uint32_t> missed() const { return m_missed; }

  protected:
    HitSource(BounceElements elements, const HitSettings& settings)
        : m_elements(std::move(elements))
        , m_settings(settings) {}

    BounceElements m_elements;
    HitSettings m_settings;
    std::vector<float> m_backTransfer;
    std::vector<std::uint32_t> m_missed;
};

using HitSourcePtr = std::shared_ptr<const HitSource>;

// All hits in memory: 8 bytes per ray that met something. Holds nothing of the scene but its
// topology.
class HitCache : public HitSource {
  public:
    // Traces `settings.samples` rays per element, cosine-weighted about its normal. Errors:
    // Cancelled.
    static Result<std::shared_ptr<const HitCache>>
    trace(const RayScene& scene, const BakeGeometry& geometry, BounceElements elements,
          const HitSettings& settings, const JobContext& job);

    [[nodiscard]] std::span<const CachedHit> hits(std::size_t chunk,
                                                  std::vector<CachedHit>&) const override {
        return m_chunks[chunk];
    }
    [[nodiscard]] bool kept() const override { return true; }
    [[nodiscard]] std::size_t hitBytes() const; // of the hits alone
    // The most the hits of a scene can take.
    [[nodiscard]] static std::uint64_t maxHitBytes(std::size_t elements, int samples) {
        return std::uint64_t{elements} * static_cast<std::uint64_t>(samples) * sizeof(CachedHit);
    }

  private:
    using HitSource::HitSource;
    std::vector<std::vector<CachedHit>> m_chunks;
};

using HitCachePtr = std::shared_ptr<const HitCache>;

// The same hits, traced anew whenever they are asked for: where memory is dearer than time.
// Scene and geometry must outlive it.
class HitRetracer : public HitSource {
  public:
    static Result<HitSourcePtr> make(const RayScene& scene, const BakeGeometry& geometry,
                                     BounceElements elements, const HitSettings& settings,
                                     const JobContext& job);
    ~HitRetracer() override;

    [[nodiscard]] std::span<const CachedHit> hits(std::size_t chunk,
                                                  std::vector<CachedHit>& scratch) const override;
    [[nodiscard]] bool kept() const override { return false; }

  private:
    struct Tracing;
    HitRetracer(BounceElements elements, const HitSettings& settings,
                std::unique_ptr<Tracing> tracing);
    std::unique_ptr<Tracing> m_tracing;
};

} // namespace patina
