// Adds to a transfer bake what arrives by way of other surfaces.
#pragma once

#include "core/bake/bounce/BounceSolver.h"
#include "core/bake/domain/BakeRequest.h"
#include "core/bake/domain/TileSink.h"
#include "core/trace/BakeInputs.h"
#include "core/trace/RayScene.h"

namespace patina {

// What is wrong with the numbers of rays or bounces (Usage).
[[nodiscard]] std::optional<Error> checkBounceSettings(const PrtSettings& settings);

[[nodiscard]] Result<HitSettings> hitSettings(const PrtSettings& settings);

// The hits of `settings.bounceSamples` rays per vertex, in memory if they fit
// `settings.hitBudget`. Errors: as checkBounceSettings(), Cancelled.
Result<HitSourcePtr> traceHits(const RayScene& scene, const BakeGeometry& geometry,
                               const PrtSettings& settings, const JobContext& job);

// The surfaces that a solver over `elements` asks for, from the meshes of the same ids.
[[nodiscard]] std::vector<BakeSurface> surfacesOf(const BounceElements& elements,
                                                  const BakeInputs& inputs);
// The direct coefficients of all front elements; nothing when the bake is of other meshes.
[[nodiscard]] std::optional<std::vector<float>> directTransfer(const BounceElements& elements,
                                                               const BakeArtifact& artifact);
// What of uniform light reaches every front element straight, by such coefficients of `order`²: for
// BounceSolver::setOpen().
[[nodiscard]] std::vector<float> openness(std::span<const float> direct, int order);
// What light of radiance coefficients `light` lends every front element straight: Σ L_i T_i; more
// or fewer coefficients than the bake has make no difference. Nothing, as directTransfer().
[[nodiscard]] std::optional<std::vector<glm::vec3>> directLight(const BounceElements& elements,
                                                                const BakeArtifact& artifact,
                                                                std::span<const glm::vec3> light);
// `bounced` of solve() as the artifact keeps it, mesh by mesh.
void setBounced(BakeArtifact& artifact, const BounceElements& elements,
                std::span<const float> bounced);

// A per-vertex bake as if it had been made for so many bounces off the surfaces of `inputs`: its
// rays are traced again. Errors: Usage where they cannot be (another geometry, texels), as
// traceHits().
[[nodiscard]] Result<BakeArtifactPtr> withBounces(const BakeArtifact& artifact,
                                                  const BakeInputs& inputs, int bounces,
                                                  const JobContext& job);

// The last step of an interreflected bake: `artifact` has its direct coefficients (those of every
// shard, and fitted) and gets `bounced`, `albedo`, `transfer` and `bounces`. Hits that fit the
// budget go to `sink`. The result depends on nothing but `inputs`, the coefficients and
// `settings`. Errors as traceHits().
std::optional<Error> addInterreflection(BakeArtifact& artifact, const BakeInputs& inputs,
                                        const BakeGeometry& geometry, const RayScene& scene,
                                        const PrtSettings& settings, TileSink& sink,
                                        const JobContext& job);

} // namespace patina
