// Adds to a transfer bake per texel what arrives by way of other surfaces: the sum of
// core/bake/bounce/BounceSolver.h, a ray finding the light and the albedo of the texel that it ends
// in. So meshes of a few large triangles, whose vertices know nothing of what lies between them,
// bounce light as fine ones do.
#pragma once

#include "core/bake/domain/BakeRequest.h"
#include "core/bake/domain/TileSink.h"
#include "core/bake/transfer/Passes.h"
#include "core/bake/transfer/TexelTransfer.h"
#include "core/trace/BakeInputs.h"
#include "core/trace/RayScene.h"

#include <optional>

namespace patina {

// The last step of an interreflected bake: `direct` is what the points of `layout` saw; `artifact`
// has its textures and gets `bounced`, `albedo`, `transfer` and `bounces`. Every point of a texel
// casts `bounceSamples` rays; what they meet, 4 bytes each, is kept if it fits `hitBudget`, else
// found anew for each bounce. The result depends on neither that nor on threads. Errors: Usage for
// numbers out of range; Cancelled.
std::optional<Error> addTexelInterreflection(BakeArtifact& artifact, const BakeInputs& inputs,
                                             const BakeGeometry& geometry, const RayScene& scene,
                                             const TexelLayout& layout, const PassState& direct,
                                             const PrtSettings& settings, const JobContext& job);

} // namespace patina
