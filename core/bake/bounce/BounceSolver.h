// Follows light from surface to surface over the hits of a scene (core/bake/bounce/HitCache.h),
// without tracing a ray.
//
// With transfer T of light that comes straight from the environment, and albedo ρ, light that has
// been on k other surfaces and less adds
//     B_0 = 0,    B_k+1(p) = mean over the rays of p of ρ(q) (T(q) + B_k(q)),
// q being where a ray ends, T and B between vertices interpolated; rays that end nowhere count as
// zero. (docs/maths/baking.md.) Each coefficient of the environment is a problem of its own, and
// so is any mixture of them: the light shown.
#pragma once

#include "core/bake/bounce/HitCache.h"

#include <glm/vec3.hpp>
#include <memory>
#include <span>
#include <vector>

namespace patina {

// A copy costs little, for what is large is shared: whoever has a solver keeps it as it is, and
// gives a copy other surfaces.
class BounceSolver {
  public:
    explicit BounceSolver(HitSourcePtr hits);

    [[nodiscard]] const HitSource& hits() const { return *m_hits; }

    // One for each of hits().elements().meshes(). Numbers alone cost nothing; other maps are
    // prepared anew, as the first ones are. When it is cancelled the solver is good for nothing but
    // another call.
    void setSurfaces(std::span<const BakeSurface> surfaces, const JobContext& job);

    // What of uniform light reaches each front element straight, 0…1 (openness()): from then on its
    // rays bring exactly the rest of the hemisphere. Without, T and the rays' hits are estimates of
    // their own, of which a fitted T may be far from what the vertex itself sees: together more
    // light than there is.
    void setOpen(std::span<const float> open);

    // `direct`: coefficients T of the front elements, order² each; order as the hits were traced
    // with. Answers 3 · order² for each front element, laid out as VertexBake::bounced. Errors:
    // Cancelled.
    [[nodiscard]] Result<std::vector<float>> solve(std::span<const float> direct, int bounces,
                                                   const JobContext& job) const;

    // For one light: `direct` is what it lends each front element, Σ L_i T_i; `environment` L_i
    // are needed for the backs of two-sided surfaces only. Answers Σ L_i B_i. A fraction of the
    // cost of solve(). Errors: Cancelled.
    [[nodiscard]] Result<std::vector<glm::vec3>> solveLight(std::span<const glm::vec3> direct,
                                                            std::span<const glm::vec3> environment,
                                                            int bounces,
                                                            const JobContext& job) const;

    [[nodiscard]] std::size_t memoryBytes() const; // beside the hits

  private:
    // Calls gather(element, its hits) for the first `elements`; false when cancelled.
    template <class Gather>
    [[nodiscard]] bool forEachElement(std::size_t elements, const Gather& gather,
                                      const JobContext& job) const;
    struct Rows;
    // `count` of the coefficients; `rows` is scratch.
    [[nodiscard]] bool solveGroup(std::span<const float> direct, int bounces, std::size_t first,
                                  std::size_t count, Rows& rows, std::vector<float>& result,
                                  const JobContext& job) const;

    HitSourcePtr m_hits;
    std::shared_ptr<const std::vector<float>> m_shares; // per element, of a ray; null: all alike
    [[nodiscard]] float
    shareOf(std::size_t element) const;   // 1 / samples, or what setOpen() made of it
    std::vector<DiffuseAlbedo> m_albedos; // per mesh
    struct MappedSurface;
    std::vector<std::shared_ptr<const MappedSurface>> m_mapped; // per mesh; null: without maps
    bool m_anyMapped = false;
    using Texels = std::vector<std::vector<std::uint32_t>>; // per chunk, of every hit
    std::shared_ptr<const Texels> m_texels; // null: nothing is mapped, or hits are not kept
    [[nodiscard]] std::span<const std::uint32_t> texels(std::size_t chunk,
                                                        std::span<const CachedHit> hits,
                                                        std::vector<std::uint32_t>& scratch) const;
    void lookUp(std::span<const CachedHit> hits, std::vector<std::uint32_t>& texels) const;
};

} // namespace patina
