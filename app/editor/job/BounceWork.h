// What BounceUpdater has done in the background: functions of values, on any thread.
#pragma once

#include "core/bake/Bake.h"
#include "core/bake/bounce/BounceSolver.h"
#include "core/bake/domain/SameTransport.h"

#include <glm/vec3.hpp>
#include <map>
#include <memory>
#include <span>
#include <vector>

namespace patina::editor {

using BounceSolverPtr = std::shared_ptr<const BounceSolver>;

// Radiance per vertex of each mesh that surfaces of albedo 1 send out by way of others.
using BouncedLight = std::map<Id, std::vector<glm::vec3>>;
using BouncedLightPtr = std::shared_ptr<const BouncedLight>;

[[nodiscard]] std::vector<BakeSurface> surfacesOf(const BakeInputs& inputs); // mesh by mesh

// The hits of an interreflected bake's rays: `ofBake` if it is they, else traced. Null when there
// are none to be had (the bake is of other geometry, or they are too many to be kept); an error is
// one of tracing.
[[nodiscard]] Result<HitSourcePtr> hitsFor(const BakeArtifact& artifact, const BakeInputs& inputs,
                                           const HitSourcePtr& ofBake, const JobContext& job);

// The solver with the surfaces of `inputs`.
[[nodiscard]] BounceSolverPtr resurfaced(const BounceSolver& solver, const BakeInputs& inputs,
                                         const JobContext& job);
// The bake with the bounces off the solver's surfaces, those of `inputs`; null when it has them
// already, or is of other meshes.
[[nodiscard]] Result<BakeArtifactPtr> withBounces(const BounceSolver& solver,
                                                  const BakeArtifact& artifact,
                                                  const BakeInputs& inputs, const JobContext& job);
// The same for one light (radiance coefficients), bounced so many times; null for other meshes.
[[nodiscard]] Result<BouncedLightPtr> bouncedLight(const BounceSolver& solver,
                                                   const BakeArtifact& artifact,
                                                   std::span<const glm::vec3> light, int bounces,
                                                   const JobContext& job);

} // namespace patina::editor
