// Finer meshes where radiance transfer changes faster than the triangles can show: bake, split
// where the fit misses what the surface saw, and again.
#pragma once

#include "core/bake/domain/BakeArtifact.h"
#include "core/bake/domain/BakeRequest.h"
#include "core/base/Result.h"
#include "core/job/JobContext.h"
#include "core/trace/BakeInputs.h"

#include <cstddef>
#include <span>
#include <vector>

namespace patina {

inline constexpr float kCoarseTolerance = 0.01f;

struct RefinementSettings {
    PrtSettings bake;                     // of the rounds; always fitted
    float tolerance = kCoarseTolerance;   // RMS error of a coefficient (VertexBake::error), > 0
    int rounds = 6;                       // at most; each halves the edges, 1…12
    std::size_t maxTriangles = 1'000'000; // of all meshes: what the last round may not pass
};

struct RefinedMeshes {
    std::vector<MeshPtr> meshes; // as those of the inputs; the same pointer where nothing changed
    std::size_t triangles = 0;   // of all
    int rounds = 0;              // of splitting
    double errorBefore = 0.0, errorAfter = 0.0; // RMS over the surface
    std::size_t tooCoarse = 0;                  // triangles that are still above the tolerance
};

// Triangles whose corners' mean error passes the tolerance are split, down to edges of a 2000th of
// the scene. Errors: Usage; those of bakePrtVertex; Cancelled.
Result<RefinedMeshes> refineForTransfer(BakeInputs inputs, const RefinementSettings& settings,
                                        const JobContext& job);

// The share, 0…1, of the surface of `bakes` whose triangles are too coarse: that refineForTransfer
// would split. Of fitted values of `inputs` in its order, with 128 rays per point and more: below
// that their noise passes the tolerance, too.
[[nodiscard]] double coarseShare(const BakeInputs& inputs, std::span<const VertexBake> bakes,
                                 float tolerance = kCoarseTolerance);

} // namespace patina
